#include "meshes/near_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "meshes/formats/coordinate_text.h"
#include "meshes/hash_key.h"

namespace vex {
namespace {

constexpr std::size_t kMostTests = 4'000'000'000;
constexpr std::uint32_t kNoPoint = std::numeric_limits<std::uint32_t>::max();

using Cell = std::array<double, 3>;  // whole numbers

std::uint64_t hash_of(const Cell& cell, std::uint64_t key) {
  std::uint64_t hash = key;
  for (const double x : cell) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0)) * key;
    hash ^= hash >> 29U;
  }
  return hash;
}

/// The points in cubes whose diagonal is below the distance, so that all points of one belong together, and whose edge
/// is so far above half of it that points within the distance are two cubes apart at most, whatever rounding does to
/// the quotients.
class Grid {
 public:
  Grid(std::span<const Vec3d> points, double distance) : points_(points), edge_(0.55 * distance) {
    mask_ = std::bit_ceil(2 * points.size() + 1) - 1;
    cell_at_.assign(mask_ + 1, kNoPoint);
    next_.assign(points.size(), kNoPoint);
    std::vector<std::uint32_t> last;
    for (std::uint32_t p = 0; p < points.size(); ++p) {
      const Cell cell = cell_of(points[p]);
      const std::size_t slot = slot_of(cell);
      if (cell_at_[slot] == kNoPoint) {
        cell_at_[slot] = static_cast<std::uint32_t>(first_.size());
        cells_.push_back(cell);
        first_.push_back(p);
        last.push_back(p);
      } else {
        next_[last[cell_at_[slot]]] = p;
        last[cell_at_[slot]] = p;
      }
    }
  }

  std::size_t n_cells() const { return first_.size(); }
  std::uint32_t first(std::uint32_t cell) const { return first_[cell]; }
  std::uint32_t next(std::uint32_t point) const { return next_[point]; }

  /// Calls for each cell that holds points and may hold some within the distance, of each pair of cells once.
  template <class Visit>
  void for_each_neighbour(std::uint32_t cell, const Visit& visit) const {
    for (int i = 0; i <= 2; ++i) {
      for (int j = i == 0 ? 0 : -2; j <= 2; ++j) {
        for (int k = i == 0 && j == 0 ? 1 : -2; k <= 2; ++k) {
          const Cell& from = cells_[cell];
          const std::uint32_t other = cell_at_[slot_of({from[0] + i, from[1] + j, from[2] + k})];
          if (other != kNoPoint) {
            visit(other);
          }
        }
      }
    }
  }

 private:
  Cell cell_of(const Vec3d& p) const {
    return {std::floor(p.x / edge_), std::floor(p.y / edge_), std::floor(p.z / edge_)};
  }
  std::size_t slot_of(const Cell& cell) const {
    std::size_t slot = static_cast<std::size_t>(hash_of(cell, key_)) & mask_;
    while (cell_at_[slot] != kNoPoint && cells_[cell_at_[slot]] != cell) {
      slot = (slot + 1) & mask_;
    }
    return slot;
  }

  std::span<const Vec3d> points_;
  double edge_;
  std::size_t mask_ = 0;
  std::uint64_t key_ = hash_key();
  std::vector<std::uint32_t> cell_at_;  // of each slot of the hash table
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> first_, next_;  // the points of a cell
};

/// Union by least, with path halving.
class Clusters {
 public:
  explicit Clusters(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t root(std::uint32_t v) {
    while (parent_[v] != v) {
      parent_[v] = parent_[parent_[v]];
      v = parent_[v];
    }
    return v;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

struct Box {
  Vec3d low, high;
};

void measure_clusters(std::span<const Vec3d> points, NearPoints* near) {
  std::vector<std::uint32_t> box_of(points.size(), kNoPoint);
  std::vector<Box> boxes;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    const std::uint32_t first = near->joined_to[v];
    if (first == v) {
      continue;
    }
    ++near->n_joined;
    near->largest_move = std::max(near->largest_move, norm(points[v] - points[first]));
    if (box_of[first] == kNoPoint) {
      box_of[first] = static_cast<std::uint32_t>(boxes.size());
      boxes.push_back({points[first], points[first]});
    }
    Box& box = boxes[box_of[first]];
    const Vec3d& p = points[v];
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    const double width = box_of[v] == kNoPoint ? 0.0 : norm(boxes[box_of[v]].high - boxes[box_of[v]].low);
    if (width > near->widest) {
      near->widest = width;
      near->in_widest = points[v];
    }
  }
}

}  // namespace

double least_weld_distance(std::span<const Vec3d> points) {
  double largest = 0.0;
  for (const Vec3d& p : points) {
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
  return 8.0 * double_digits(largest).last_place;
}

std::optional<NearPoints> near_points(std::span<const Vec3d> points, double distance) {
  const Grid grid(points, distance);
  Clusters clusters(points.size());
  std::size_t n_tests = 0;
  const auto join_cells = [&](std::uint32_t cell, std::uint32_t other) {
    if (clusters.root(grid.first(cell)) == clusters.root(grid.first(other))) {
      return;
    }
    for (std::uint32_t p = grid.first(cell); p != kNoPoint; p = grid.next(p)) {
      for (std::uint32_t q = grid.first(other); q != kNoPoint && n_tests < kMostTests; q = grid.next(q)) {
        ++n_tests;
        if (norm(points[p] - points[q]) <= distance) {
          clusters.join(p, q);
          return;
        }
      }
    }
  };
  for (std::uint32_t cell = 0; cell < grid.n_cells(); ++cell) {
    for (std::uint32_t p = grid.next(grid.first(cell)); p != kNoPoint; p = grid.next(p)) {
      clusters.join(grid.first(cell), p);
    }
  }
  for (std::uint32_t cell = 0; cell < grid.n_cells(); ++cell) {
    grid.for_each_neighbour(cell, [&](std::uint32_t other) { join_cells(cell, other); });
  }
  if (n_tests >= kMostTests) {
    return std::nullopt;
  }
  NearPoints near;
  near.joined_to.resize(points.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    near.joined_to[v] = clusters.root(v);
  }
  measure_clusters(points, &near);
  return near;
}

NearWeld joined_within(const WeldedSurface& exact, double distance, UnusedPoints unused) {
  NearWeld result;
  const std::vector<Vec3d>& vertices = exact.surface.vertices;
  const std::optional<NearPoints> near = near_points(vertices, distance);
  if (!near || near->widest > kMostWeldDistances * distance) {
    result.chain = near ? near->in_widest : vertices.front();
    return result;
  }
  WeldedSurface joined = exact;
  joined.n_collapsed_faces += join_vertices(near->joined_to, unused, &joined.surface);
  joined.n_welded_vertices += near->n_joined;
  joined.distance = distance;
  joined.largest_move = near->largest_move;
  result.n_joined = near->n_joined;
  result.welded = std::move(joined);
  return result;
}

}  // namespace vex
