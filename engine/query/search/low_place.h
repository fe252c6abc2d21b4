// Where a difference K = A - B reaches least far near a direction in which it nearly does: a local minimum of h over
// unit vectors, from what was known of the last one.
//
// Where K's surface is smooth that is a zero of the gradient, for a method of Newton's kind. Along an edge of K, or on
// a face of it, the gradient jumps at the minimum: the normal is across the edge, whose ends are the farthest points on
// either side of it, and only along the edge is a gradient's zero looked for; or it is the face's.
#pragma once

#include <array>
#include <cstddef>

#include "engine/query/search/core_difference.h"

namespace vex {

/// Of the height along `point.dir`: how the minimum turns with a gradient along the axes x and y, which are unit
/// vectors across it. Both turns are above 0 where K is smooth, and x and y are at right angles then; at an edge y is
/// along it, and does not turn; on a face neither does, and each of the axes is across one of two edges.
struct LowPlace {
  CoreDifference::Point point;
  Vec3d x, y;
  double turn_x = 0.0, turn_y = 0.0;
};

class LowPlaceSearch {
 public:
  /// `size`: R_A + R_B.
  LowPlaceSearch(const CoreDifference& difference, double size) : difference_(difference), size_(size) {}

  CoreDifference::Point ask(const Vec3d& unit_dir) {
    last_[static_cast<std::size_t>(n_support_calls_++) % last_.size()] = difference_.support(unit_dir);
    return last_[static_cast<std::size_t>(n_support_calls_ - 1) % last_.size()];
  }
  /// `visit(point)` of the last ones that were asked for, the latest first.
  template <class Visit>
  void visit_last(const Visit& visit) const {
    for (int k = n_support_calls_ - 1; k >= 0 && k >= n_support_calls_ - static_cast<int>(last_.size()); --k) {
      visit(last_[static_cast<std::size_t>(k) % last_.size()]);
    }
  }
  /// From a place nearby, of this pose or another; its point is one of this pose. The place itself where none is lower.
  LowPlace lower(const LowPlace& start);
  /// The place of three points that span it, near each other: what a search from there begins with. `found` is the
  /// farthest along its direction, and the height there above the minimum is known to be below `gap`.
  LowPlace of_triangle(const CoreDifference::Point& found, const std::array<CoreDifference::Point, 3>& corners,
                       double gap);
  /// The place where `dir` is about the lowest, by the points of two directions beside it.
  LowPlace around(const Vec3d& unit_dir);
  int n_support_calls() const { return n_support_calls_; }
  /// What it has taken, in quarters of a support call of a descent: there is more to a step where K is smooth.
  int quarters() const { return 5 * n_support_calls_ + 3 * n_smooth_steps_; }

 private:
  LowPlace lower_smooth(const LowPlace& start);
  LowPlace lower_flat(const LowPlace& start);
  // Without their points.
  LowPlace on_face(const LowPlace& start);
  LowPlace at_edge(const LowPlace& start);
  bool is_flat(double turn) const { return !(turn * size_ > 0x1p-7 && turn * size_ < 0x1p40); }

  const CoreDifference& difference_;
  double size_;
  int n_support_calls_ = 0, n_smooth_steps_ = 0;
  std::array<CoreDifference::Point, 5> last_;  // in turn
};

}  // namespace vex
