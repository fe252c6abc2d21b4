#include "engine/scene/cell_grid.h"

#include <algorithm>
#include <span>
#include <utility>

#include "engine/numeric/interruption.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

constexpr std::size_t kMostParts = 256, kBodiesAPart = 2048;

}  // namespace

void CellGrid::build(const SceneBodies& bodies, double reach, bool by_boxes, bool with_poses, int n_threads) {
  const Aabb bounds = bodies.box() ? Aabb{} : bounds_of_centres(bodies, n_threads);
  extents_.reset();
  if (by_boxes) extents_ = bodies.bounds(0).extents;
  const Vec3d reaches = by_boxes ? (1.0 + 0x1p-18) * *extents_ : Vec3d{reach, reach, reach};
  layout_ = CellLayout::make(bodies.box(), bounds, bodies.largest_offset(), reaches, bodies.size());
  shifts_.assign(layout_.box, layout_.n_images);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int m = layout_.stencil[axis];
    moved_[axis].clear();
    for (int at = -m; at < layout_.n_cells[axis] + m; ++at) moved_[axis].push_back(layout_.moved(axis, 0, at));
  }
  sort(bodies, n_threads);
  sorted_.fill(bodies, order_, 3.0 * shifts_.largest_shift(), by_boxes, with_poses, n_threads);
  cut_into_parts();
}

// Counting sort; bodies of a cell in the order of their numbers. First into buckets of neighbouring cells, then within
// each: what is counted and written at once stays in a core's own cache, however many cells there are.
void CellGrid::sort(const SceneBodies& bodies, int n_threads) {
  const std::size_t n_cells = layout_.size(), n = bodies.end();
  const std::size_t n_buckets = (n_cells - 1) / kCellsABucket + 1;
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  cell_of_.resize(n);
  counts_.assign(n_buckets * static_cast<std::size_t>(n_threads), 0);
  on_threads(n_threads, [&](int thread) {
    std::uint32_t* const counts = counts_.data() + n_buckets * static_cast<std::size_t>(thread);
    const CellLayout layout = layout_;
    const Part part = part_of(n, thread, n_threads);
    for (std::size_t k = part.first; k < part.end; ++k) {
      if (k % kBodiesAPart == 0) end_if_interrupted();
      const BodyId body = static_cast<BodyId>(k);
      const bool is_there = bodies.has(body);
      const std::uint32_t cell = is_there ? layout.number(layout.coordinates(bodies.centre(body))) : kNone;
      cell_of_[k] = cell;
      if (is_there) ++counts[cell / kCellsABucket];
    }
  });
  bucket_ends_.resize(n_buckets);
  std::uint32_t sum = 0;
  for (std::size_t bucket = 0; bucket < n_buckets; ++bucket) {
    for (int thread = 0; thread < n_threads; ++thread) {
      std::uint32_t& count = counts_[n_buckets * static_cast<std::size_t>(thread) + bucket];
      const std::uint32_t here = count;
      count = sum;  // from now on the next place of this thread's bodies
      sum += here;
    }
    bucket_ends_[bucket] = sum;
  }
  in_buckets_.resize(sum);
  on_threads(n_threads, [&](int thread) {
    std::uint32_t* const next = counts_.data() + n_buckets * static_cast<std::size_t>(thread);
    const Part part = part_of(n, thread, n_threads);
    for (std::size_t k = part.first; k < part.end; ++k) {
      if (k % kBodiesAPart == 0) end_if_interrupted();
      const std::uint32_t cell = cell_of_[k];
      if (cell != kNone) in_buckets_[next[cell / kCellsABucket]++] = {cell, static_cast<BodyId>(k)};
    }
  });
  starts_.resize(n_cells + 1);
  starts_[n_cells] = sum;
  order_.resize(sum);
  share_parts(n_threads, n_buckets, [&](std::size_t bucket) { sort_bucket(bucket); });
}

void CellGrid::sort_bucket(std::size_t bucket) {
  const std::size_t first_cell = bucket * kCellsABucket, n = std::min(kCellsABucket, layout_.size() - first_cell);
  const std::uint32_t first = bucket == 0 ? 0 : bucket_ends_[bucket - 1];
  const std::span<const BodyInCell> here(in_buckets_.data() + first, bucket_ends_[bucket] - first);
  std::uint32_t next[kCellsABucket] = {};
  for (const BodyInCell& one : here) ++next[one.cell - first_cell];
  std::uint32_t sum = first;
  for (std::size_t k = 0; k < n; ++k) {
    starts_[first_cell + k] = sum;
    sum += std::exchange(next[k], sum);
  }
  for (const BodyInCell& one : here) order_[next[one.cell - first_cell]++] = one.body;
}

void CellGrid::cut_into_parts() {
  part_ends_.clear();
  const std::size_t n_x = static_cast<std::size_t>(layout_.n_cells[0]);
  const std::size_t n_rows = layout_.size() / n_x;
  const std::size_t bodies_a_part = std::max(kBodiesAPart, sorted_.size() / kMostParts);
  std::size_t first = 0;
  for (std::size_t row = 1; row <= n_rows; ++row) {
    if (starts_[row * n_x] - first < bodies_a_part && row < n_rows) continue;
    part_ends_.push_back(row);
    first = starts_[row * n_x];
  }
}

// Of the rows around, the half that comes after the own one.
void CellGrid::rows_of(int y, int z, std::vector<Row>& rows) const {
  rows.clear();
  for (int dz = 0; dz <= layout_.stencil[2]; ++dz) {
    const CellLayout::Moved to_z = moved(2, z + dz);
    if (!to_z.is_any) continue;
    for (int dy = dz == 0 ? 0 : -layout_.stencil[1]; dy <= layout_.stencil[1]; ++dy) {
      const CellLayout::Moved to_y = moved(1, y + dy);
      if (!to_y.is_any) continue;
      Row row{layout_.number({0, to_y.cell, to_z.cell}), {0, to_y.image, to_z.image}, 0, {}, dz == 0 && dy == 0};
      row.shift = shifts_.number(row.image);
      row.by = shifts_.shift(row.shift);
      rows.push_back(row);
    }
  }
}

// The row's own cell and those behind it are one range: each body looks behind itself.
void CellGrid::begin_inner_ranges(const std::vector<Row>& rows, std::vector<NearRange>& ranges) {
  ranges.clear();
  for (const Row& row : rows) ranges.push_back({0, 0, row.shift, row.by, row.is_own});
}

void CellGrid::ranges_of(int x, const std::vector<Row>& rows, std::vector<NearRange>& ranges) const {
  ranges.clear();
  for (const Row& row : rows) {
    const std::size_t cell = row.start + static_cast<std::size_t>(x);
    if (row.is_own) ranges.push_back({starts_[cell], starts_[cell + 1], row.shift, {}, true});
    add_copies(x, row, ranges);
  }
}

// Cells of the row and of its copies, cut where a copy ends.
void CellGrid::add_copies(int x, const Row& row, std::vector<NearRange>& ranges) const {
  const int n_x = layout_.n_cells[0], m_x = layout_.stencil[0];
  int first = row.is_own ? x + 1 : x - m_x, last = x + m_x;
  if (!layout_.box) {
    first = std::max(first, 0);
    last = std::min(last, n_x - 1);
  }
  while (first <= last) {
    const CellLayout::Moved copy = moved(0, first);
    const int n = std::min(last - first + 1, n_x - copy.cell);
    const std::uint32_t number = shifts_.number({copy.image, row.image[1], row.image[2]});
    const std::size_t from = row.start + static_cast<std::size_t>(copy.cell);
    add_cells(from, from + static_cast<std::size_t>(n), number, shifts_.shift(number), ranges);
    first += n;
  }
}

}  // namespace vex
