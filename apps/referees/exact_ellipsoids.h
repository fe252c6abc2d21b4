// Do two ellipsoids share a point? In whole numbers, by an algebraic condition and Sturm's theorem.
#pragma once

#include "engine/numeric/transform.h"

namespace vex::exact {

/// W. Wang, J. Wang, M.-S. Kim, "An algebraic condition for the separation of two ellipsoids", Comput. Aided Geom. Des.
/// 18, 531 (2001): with X^T A X < 0 inside of one and X^T B X < 0 inside of the other (homogeneous coordinates),
/// det(l A + B) has always two negative roots; the closed ellipsoids are apart exactly where it has two distinct
/// positive ones, and touch from outside where it has a double positive one. R of the pose may be any invertible
/// matrix.
bool ellipsoids_overlap(const Vec3d& semi_axes_a, const Vec3d& semi_axes_b, const Transformd& a_from_b);

}  // namespace vex::exact
