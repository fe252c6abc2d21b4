// Do two polytopes, rounded or not, share a point? Decided in whole numbers, always.
//
// The distance from the origin to the convex hull of the differences of their points, by the descent of Gilbert,
// Johnson and Keerthi (1988) with Johnson's subalgorithm. In exact arithmetic the distance falls in every step and the
// simplices are finitely many: the descent ends, and with the truth (E15).
#pragma once

#include <array>
#include <cstddef>

#include "engine/numeric/whole.h"
#include "engine/query/exact/placed_forms.h"

namespace vex {

struct ExactOverlap {
  bool overlap = false;
  /// Indices of points of A and of B, n_carriers of each. The nearest point to the origin of the hull of these
  /// differences is what proves the answer.
  std::array<std::size_t, 4> carriers_a{}, carriers_b{};
  int n_carriers = 0;
  int n_support_calls = 0;
};

/// `forms.are_rounded_polytopes()`.
ExactOverlap exact_overlap(const PlacedForms& forms);

/// The same without the balls, and down to the nearest point: `dir` receives the direction from the origin's side,
/// along which the polytopes are as far apart as they are; 0 where they share a point.
ExactOverlap exact_nearest(const PlacedForms& forms, whole::Vector& dir);

}  // namespace vex
