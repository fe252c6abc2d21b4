// The penetration depth of two placed bodies' cores between bounds: a polytope within their difference K = A - B that
// grows where it is nearest to the origin, in twice the precision of a double.
//
// The distance of the polytope's nearest face is a lower bound of the depth, K's height along any direction an upper
// one; each step adds the point of K that is farthest beyond the nearest face (S. Cameron 1997; G. van den Bergen
// 2001). Independent of the engine: nothing of its queries or of the bodies' support mappings is used.
#pragma once

#include "apps/referees/difference_body.h"

namespace vex::exact {

/// The true value lies between them, in the units of DifferenceBody::scale, but for roundings of some 2^-90.
struct Bounds {
  DoubleDouble lower = -HUGE_VAL, upper = HUGE_VAL;
  Vec3dd direction;  // a unit vector, along which the bound from K's height was found
};

/// Once bounds are as near to each other as this, in the units of DifferenceBody::scale, a search has ended.
inline constexpr double kNearEnough = 0x1p-62;

/// How deep the origin is in the difference of the cores; where it is outside, a negative number that says no more than
/// this. 0 for a difference without volume. Wide where the shortest way out has ever so many directions.
Bounds depth_of_cores(const DifferenceBody& difference);

}  // namespace vex::exact
