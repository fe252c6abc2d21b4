#include "engine/support/direction_map.h"

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "engine/numeric/expect.h"
#include "engine/numeric/rounding.h"
#include "engine/support/cell_contest.h"
#include "engine/support/vertex_columns.h"

namespace vex {
namespace {

// Sizes of directions, times the body's, between which no product with a vertex overflows, and what underflow takes
// away is far below the margin; and the least reach of a body of which that holds (E17).
constexpr double kLeastDirection = 0x1p-900, kLargestDirection = 0x1p900;
constexpr double kLeastReach = 0x1p-30;
// A facet of more vertices takes longer to scan for all the trials of a packet, finished ones too, than one at a time.
constexpr std::size_t kLongestForKernels = 4096;
// The kernels' directions have sizes between 2^-200 and 2^200 (E18).
constexpr double kLeastTableScale = 0x1p-300, kLargestTableScale = 0x1p300;

// By how much a vertex must be beaten, relative to the reach (E17).
constexpr double kMargin = 32.0 * kUnitRoundoff;

// Dividing further saves nothing where so few vertices are scanned.
constexpr std::size_t kShortList = 4;
// A cell that keeps more than this is divided in 16, others in 4.
constexpr std::size_t kLongList = 128;
// A cell is divided if what the mean scan then loses, in vertices, is worth the vertices that are stored in addition:
// more than this for as many as are given. Lower values store more for the same time (docs/performance.md).
constexpr double kPriceOfStorage = 0.5;
// Of many vertices memory is what takes time, and the table's making.
constexpr double kPriceOfMuchStorage = 4.0;
constexpr std::size_t kManyVertices = std::size_t{1} << 16;
// Nothing is gained where a cell adds less than this to the mean scan. (A facet with many vertices stays whole in the
// cells around its normal, however small they are.)
constexpr double kLeastScan = 0x1p-10;
// For each vertex given, and each face, so many are kept until nothing is divided any more.
constexpr std::size_t kMostKept = 4;
constexpr int kDeepest = 40;  // far beyond this all places in a cell are exact
constexpr int kWidestBlock = 12;

constexpr std::size_t kFaces = 6;

/// A copy without spare room, in large pages where the system has them: a call that finds neither the list nor the way
/// to its page in a cache takes 10 to 30 % less time (a million vertices).
template <class T>
std::vector<T> in_large_pages(const std::vector<T>& from) {
  std::vector<T> to;
  to.reserve(from.size());
#ifdef __linux__
  // Advice only, and only for whole pages: to fail changes nothing.
  const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE)), bytes = sizeof(T) * to.capacity();
  const std::size_t before = (page - std::bit_cast<std::uintptr_t>(to.data()) % page) % page;
  if (bytes > before + page) {
    madvise(reinterpret_cast<char*>(to.data()) + before, (bytes - before) / page * page, MADV_HUGEPAGE);
  }
#endif
  to.assign(from.begin(), from.end());
  return to;
}

struct TreeNode {
  std::int64_t children = -1;  // the first of four; or none
  std::size_t list = 0;        // of a leaf: its place in the table of lists
};

/// The lists of one depth, made once for it.
struct Level {
  VertexList list;
  std::array<VertexList, kCellParts> children;
  std::vector<std::uint32_t> parts_of_each;
};

/// How the vertices of a cell would be shared among its quarters, or theirs.
struct Division {
  Division(std::size_t n_vertices, const std::vector<std::uint32_t>& parts_of_each)
      : levels(n_vertices > kLongList ? 2 : 1), width(std::size_t{1} << levels) {
    const std::size_t parts_across = kCellGrid / width;
    for (std::size_t part = 0; part < kCellParts; ++part) {
      const std::size_t row = part / kCellGrid / parts_across, column = part % kCellGrid / parts_across;
      parts_of_child[row * width + column] |= 1U << part;
    }
    for (std::size_t i = 0; i < n_vertices; ++i) {
      for (std::size_t k = 0; k < n_children(); ++k) n_in_child[k] += is_in(parts_of_each[i], k) ? 1U : 0U;
    }
    for (const std::size_t n : n_in_child) n_in_all += n;
  }
  std::size_t n_children() const { return width * width; }
  bool is_in(std::uint32_t parts, std::size_t child) const { return (parts & parts_of_child[child]) != 0; }

  int levels;
  std::size_t width;
  std::array<std::uint32_t, kCellParts> parts_of_child{};
  std::array<std::size_t, kCellParts> n_in_child{};
  std::size_t n_in_all = 0;
};

}  // namespace

/// Divides each face into smaller and smaller cells, four at a time, and then draws these together into wide blocks.
class DirectionMapBuilder {
 public:
  DirectionMapBuilder(const VertexColumns& coordinates, const std::array<double, 3>& scale, double margin,
                      DirectionMap* map)
      : coordinates_(coordinates),
        scale_(scale),
        n_given_(coordinates[0].size()),
        margin_(margin),
        map_(map),
        tree_(kFaces),
        levels_(std::size_t{kDeepest} + 1) {
    for (face_ = 0; face_ < kFaces; ++face_) divide_face();
    map_->lists_.insert(map_->lists_.end(), map_->longest_list_ + 1, map_->lists_.back());
    map_->cells_.resize(kFaces);
    for (std::size_t face = 0; face < kFaces; ++face) draw_together(face, face);
  }

 private:
  // Of the axes of a face the first is `axis`, and the others follow in turn; it is turned about on the negative side.
  std::size_t axis() const { return face_ / 2; }
  double sign() const { return face_ % 2 == 0 ? 1.0 : -1.0; }

  void divide_face() {
    VertexList all;
    all.w = coordinates_[axis()];
    all.y = coordinates_[(axis() + 1) % 3];
    all.z = coordinates_[(axis() + 2) % 3];
    for (double& w : all.w) w *= sign();
    divide(all, {}, 0, face_);
  }

  void keep(const VertexList& list, std::size_t node) {
    tree_[node].list = map_->lists_.size();
    n_kept_ += list.size();
    map_->longest_list_ = std::max(map_->longest_list_, list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      std::array<double, 3> vertex{};
      vertex[axis()] = sign() * list.w[i];
      vertex[(axis() + 1) % 3] = list.y[i];
      vertex[(axis() + 2) % 3] = list.z[i];
      map_->lists_.push_back({vertex[0], vertex[1], vertex[2], static_cast<double>(list.size() - i)});
    }
  }

  bool pays(const Division& division, std::size_t n_before, int depth) const {
    const double share = std::ldexp(1.0 / static_cast<double>(kFaces), -2 * depth);  // of all directions
    const auto before = static_cast<double>(n_before), after = static_cast<double>(division.n_in_all);
    const double saved = share * (before - after / static_cast<double>(division.n_children()));
    const double price = n_given_ > kManyVertices ? kPriceOfMuchStorage : kPriceOfStorage;
    return share * before > kLeastScan && saved * static_cast<double>(n_given_) > price * (after - before);
  }

  void divide(const VertexList& given, const DirectionCell& cell, int depth, std::size_t node) {
    Level& level = levels_[static_cast<std::size_t>(depth)];
    const std::array<double, 3> scale = {scale_[axis()], scale_[(axis() + 1) % 3], scale_[(axis() + 2) % 3]};
    find_contenders(given, cell, scale, margin_, &level.parts_of_each);
    // The cell needs what any of its parts needs.
    VertexList& list = level.list;
    list.resize(given.size());
    std::size_t n = 0;
    for (std::size_t i = 0; i < given.size(); ++i) {
      const std::uint32_t parts = level.parts_of_each[i];
      given.copy_to(n, i, &list);
      level.parts_of_each[n] = parts;
      n += parts != 0 ? 1U : 0U;
    }
    list.resize(n);
    if (n <= kShortList || n_kept_ > (face_ + 1) * kMostKept * n_given_) return keep(list, node);
    const Division division(n, level.parts_of_each);
    if (depth + division.levels > kDeepest || !pays(division, n, depth)) return keep(list, node);

    std::array<std::size_t, kCellParts> end{};
    for (std::size_t k = 0; k < division.n_children(); ++k) level.children[k].resize(division.n_in_child[k]);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < division.n_children(); ++k) {
        if (division.is_in(level.parts_of_each[i], k)) list.copy_to(end[k]++, i, &level.children[k]);
      }
    }
    const std::size_t children = add_children(node);
    if (division.levels == 2) {
      for (std::size_t k = 0; k < 4; ++k) add_children(children + k);
    }
    const double width = cell.width / static_cast<double>(division.width);
    for (std::size_t k = 0; k < division.n_children(); ++k) {
      const std::size_t column = k % division.width, row = k / division.width;
      const DirectionCell child{cell.s0 + static_cast<double>(column) * width,
                                cell.t0 + static_cast<double>(row) * width, width};
      divide(level.children[k], child, depth + division.levels, descend(node, division.levels, column, row));
    }
  }

  std::size_t add_children(std::size_t node) {
    const std::size_t children = tree_.size();
    tree_[node].children = static_cast<std::int64_t>(children);
    tree_.resize(children + 4);
    return children;
  }
  std::size_t child(std::size_t node, std::size_t k) const {
    return static_cast<std::size_t>(tree_[node].children) + k;
  }

  /// The node at a place of the grid of 2^levels by 2^levels cells below `node`, or the leaf above it.
  std::size_t descend(std::size_t node, int levels, std::size_t column, std::size_t row) const {
    for (int level = levels - 1; level >= 0 && tree_[node].children >= 0; --level) {
      node = child(node, ((row >> level) & 1U) * 2 + ((column >> level) & 1U));
    }
    return node;
  }

  /// How many of the 4^levels cells below a node are divided in turn.
  std::size_t n_divided(std::size_t node, int levels) const {
    if (tree_[node].children < 0) return 0;
    if (levels == 0) return 1;
    std::size_t n = 0;
    for (std::size_t k = 0; k < 4; ++k) n += n_divided(child(node, k), levels - 1);
    return n;
  }

  /// Writes at `place` what the table has of a node. A block is as wide as at least a sixteenth of the cells twice as
  /// wide are divided: few steps lead to a list, and the table stays small where the lists are unlike each other.
  void draw_together(std::size_t node, std::size_t place) {
    std::vector<std::uint64_t>& cells = map_->cells_;
    if (tree_[node].children < 0) {
      cells[place] = tree_[node].list;
      return;
    }
    int levels = 1;
    while (levels < kWidestBlock && 16 * n_divided(node, levels) >= (std::size_t{1} << (2 * levels))) ++levels;
    const std::size_t width = std::size_t{1} << levels, block = cells.size();
    cells[place] = DirectionMap::cell_of_block(static_cast<double>(width), block);
    cells.resize(block + width * width);
    for (std::size_t row = 0; row < width; ++row) {
      for (std::size_t column = 0; column < width; ++column) {
        draw_together(descend(node, levels, column, row), block + row * width + column);
      }
    }
  }

  const VertexColumns& coordinates_;
  std::array<double, 3> scale_;
  std::size_t n_given_;
  double margin_;
  DirectionMap* map_;
  std::size_t face_ = 0;
  std::size_t n_kept_ = 0;
  std::vector<TreeNode> tree_;  // the faces first
  std::vector<Level> levels_;
};

DirectionMap::DirectionMap(std::span<const double> x, std::span<const double> y, std::span<const double> z) {
  VEX_EXPECT(!x.empty() && x.size() == y.size() && x.size() == z.size());
  const VertexColumns coordinates = without_repetitions(x, y, z);
  const std::optional<std::array<int, 3>> lengths = lengths_along(coordinates);
  if (!lengths) return;  // takes no direction
  std::array<double, 3> scale{};
  for (std::size_t axis = 0; axis < 3; ++axis) scale[axis] = std::ldexp(1.0, -(*lengths)[axis]);
  double reach = 0.0;
  for (std::size_t i = 0; i < coordinates[0].size(); ++i) {
    reach = std::max(
        reach, norm_1(Vec3d{scale[0] * coordinates[0][i], scale[1] * coordinates[1][i], scale[2] * coordinates[2][i]}));
  }
  if (!(reach >= kLeastReach)) return;
  scale_ = {1.0 / scale[0], 1.0 / scale[1], 1.0 / scale[2]};
  least_size_ = kLeastDirection;
  largest_size_ = kLargestDirection;
  DirectionMapBuilder(coordinates, scale, kMargin * reach, this);
  if (cells_.size() > DirectionTable::kPlaceBits || lists_.size() > DirectionTable::kPlaceBits) {
    largest_size_ = -1.0;  // places have 32 bits
    cells_.clear();
    lists_.clear();
  }
  cells_ = in_large_pages(cells_);
  lists_ = in_large_pages(lists_);
}

std::optional<DirectionTable> DirectionMap::table() const {
  if (largest_size_ < 0.0 || longest_list_ > kLongestForKernels) return std::nullopt;
  for (const double s : {scale_.x, scale_.y, scale_.z}) {
    if (s < kLeastTableScale || s > kLargestTableScale) return std::nullopt;
  }
  return DirectionTable{cells_.data(), lists_.data(), scale_};
}

}  // namespace vex
