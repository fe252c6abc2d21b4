// Witnesses of a body that have a given point near their hull: what proves of an answer's points that they are of their
// bodies. Found in twice the precision; the checker judges them.
#pragma once

#include <vector>

#include "engine/query/certificate.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Of A; the point, in A's frame, is about A's farthest one along `normal`, or that is zero.
std::vector<Witness> nearest_of_a(const ConvexBody& a, const Vec3d& point, const Vec3d& normal);
/// Of B as it is placed, in whose frame of placement point and normal are; about its farthest one against `normal`.
std::vector<Witness> nearest_of_b(const ConvexBody& b, const Transformd& a_from_b, const Vec3d& point,
                                  const Vec3d& normal);

}  // namespace vex
