// A grid of cells over all bodies of a scene: the broad phase for bodies of like size (internal).
//
// Bodies are sorted by cell (counting sort), so that the cells of a row stand side by side in the columns, and a body's
// neighbours in a row are one range.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/scene/cell_layout.h"
#include "engine/scene/shift_table.h"
#include "engine/scene/sorted_bodies.h"

namespace vex {

class CellGrid {
 public:
  /// For bodies whose centres are no farther apart than `reach`; `by_boxes`: for those whose boxes meet, where
  /// SceneBodies::are_told_by_boxes. The same for any number of threads.
  void build(const SceneBodies& bodies, double reach, bool by_boxes, bool with_poses, int n_threads);

  const CellLayout& layout() const { return layout_; }
  const SortedBodies& bodies() const { return sorted_; }
  SortedBodies& bodies() { return sorted_; }
  const ShiftTable& shifts() const { return shifts_; }

  /// Parts of the search of about the same work, to be done in any order.
  std::size_t n_parts() const { return part_ends_.size(); }
  /// The pairs whose balls, or boxes, may meet, each once: near.n grows until take() is called, which empties it. Ends
  /// early where take() returns false.
  template <class Take>
  bool find_near(std::size_t part, const SceneKernel& kernel, NearPairs& near, Take&& take) const;

 private:
  // A row of cells that the cells of another one are compared with: the row itself, or one behind it.
  struct Row {
    std::size_t start;
    ImageOffset image;
    std::uint32_t shift;
    Vec3d by;
    bool is_own;
  };

  struct BodyInCell {
    std::uint32_t cell;
    BodyId body;
  };
  static constexpr std::size_t kCellsABucket = 4096;

  // CellLayout::moved of the cells about those of the grid.
  const CellLayout::Moved& moved(std::size_t axis, int at) const {
    return moved_[axis][static_cast<std::size_t>(at + layout_.stencil[axis])];
  }
  void sort(const SceneBodies& bodies, int n_threads);
  void sort_bucket(std::size_t bucket);
  void cut_into_parts();
  void rows_of(int y, int z, std::vector<Row>& rows) const;
  // Ranges of bodies that the ones of a cell are to be compared with: of any cell; and of one
  // whose neighbours in the row are no copies, begun once a row.
  void ranges_of(int x, const std::vector<Row>& rows, std::vector<NearRange>& ranges) const;
  static void begin_inner_ranges(const std::vector<Row>& rows, std::vector<NearRange>& ranges);
  void move_inner_ranges(std::size_t x, const std::vector<Row>& rows, std::vector<NearRange>& ranges) const {
    const std::size_t reach = static_cast<std::size_t>(layout_.stencil[0]);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const std::size_t cell = rows[k].start + x;
      ranges[k].first = starts_[rows[k].is_own ? cell : cell - reach];
      ranges[k].end = starts_[cell + reach + 1];
    }
  }
  void add_copies(int x, const Row& row, std::vector<NearRange>& ranges) const;
  void add_cells(std::size_t first_cell, std::size_t end_cell, std::uint32_t shift, const Vec3d& by,
                 std::vector<NearRange>& ranges) const {
    if (starts_[first_cell] != starts_[end_cell]) {
      ranges.push_back({starts_[first_cell], starts_[end_cell], shift, by, false});
    }
  }

  CellLayout layout_;
  std::optional<Vec3d> extents_;  // of boxes
  std::array<std::vector<CellLayout::Moved>, 3> moved_;
  SortedBodies sorted_;
  ShiftTable shifts_;
  LargeVector<std::uint32_t> starts_;  // of each cell, and the end
  LargeVector<std::uint32_t> cell_of_;
  std::vector<std::uint32_t> counts_, bucket_ends_;
  LargeVector<BodyInCell> in_buckets_;
  LargeVector<BodyId> order_;
  std::vector<std::size_t> part_ends_;  // rows of cells
};

template <class Take>
bool CellGrid::find_near(std::size_t part, const SceneKernel& kernel, NearPairs& near, Take&& take) const {
  const std::size_t first_row = part == 0 ? 0 : part_ends_[part - 1];
  const std::size_t n_x = static_cast<std::size_t>(layout_.n_cells[0]),
                    n_y = static_cast<std::size_t>(layout_.n_cells[1]),
                    reach = static_cast<std::size_t>(layout_.stencil[0]);
  thread_local std::vector<Row> rows;  // memory that a thread keeps
  thread_local std::vector<NearRange> inner_ranges, outer_ranges;
  NearQuery query{sorted_.x.data(),
                  sorted_.y.data(),
                  sorted_.z.data(),
                  sorted_.radius.data(),
                  0,
                  0,
                  nullptr,
                  0,
                  extents_ ? &*extents_ : nullptr};
  for (std::size_t row = first_row; row < part_ends_[part]; ++row) {
    if (starts_[row * n_x] == starts_[(row + 1) * n_x]) continue;
    rows_of(static_cast<int>(row % n_y), static_cast<int>(row / n_y), rows);
    begin_inner_ranges(rows, inner_ranges);
    for (std::size_t cx = 0; cx < n_x; ++cx) {
      const std::uint64_t first = starts_[row * n_x + cx], end = starts_[row * n_x + cx + 1];
      if (first == end) continue;
      const bool is_inner = cx >= reach && cx + reach < n_x;
      const std::vector<NearRange>& ranges = is_inner ? inner_ranges : outer_ranges;
      if (is_inner) {
        move_inner_ranges(cx, rows, inner_ranges);
      } else {
        ranges_of(static_cast<int>(cx), rows, outer_ranges);
      }
      std::uint64_t n_against = 0;
      for (const NearRange& range : ranges) n_against += range.end - range.first;
      if ((end - first) * n_against <= NearPairs::kMost) {
        query.first = first;
        query.end = end;
        query.ranges = ranges.data();
        query.n_ranges = ranges.size();
        kernel.find_near(query, near);
        if (near.n >= NearPairs::kMost && !take()) return false;
        continue;
      }
      // A crowded cell: one body at a time, against so many that what is found has room.
      query.n_ranges = 1;
      for (query.first = first; query.first < end; ++query.first) {
        query.end = query.first + 1;
        for (NearRange range : ranges) {
          if (range.is_own) range.first = query.first + 1;
          range.is_own = false;
          query.ranges = &range;
          const std::uint64_t last = range.end;
          for (; range.first < last; range.first = range.end) {
            range.end = range.first + NearPairs::kMost < last ? range.first + NearPairs::kMost : last;
            kernel.find_near(query, near);
            if (near.n >= NearPairs::kMost && !take()) return false;
          }
        }
      }
    }
  }
  return near.n == 0 || take();
}

}  // namespace vex
