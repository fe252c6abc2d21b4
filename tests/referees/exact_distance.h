// How far apart are two bodies, or how deep in each other? Exactly, or between proven bounds.
//
// The signed distance is the distance where it is positive and minus the penetration depth, the length of the shortest
// translation to contact, where it is negative: minus the least of h_K(n) over all unit n, with K = A - B. So every n
// gives a lower bound, and whatever lies in A and in B gives an upper one.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <vector>

#include "apps/referees/exact_overlap.h"
#include "engine/numeric/transform.h"
#include "engine/support/convex_body.h"

namespace vex {

/// The true value is within `error` of `value`; where the exact value is known that is the rounding to a double.
struct SignedDistance {
  double value = 0.0;
  double error = 0.0;
};

/// For bodies of few vertices that have an exact form (std::bad_optional_access otherwise): exact between polytopes,
/// rounded or not (sphere, capsule); between proven bounds where a disc is part of one (disc, cylinder, cone, frustum),
/// as narrow as 1e-20 of the bodies' reach unless two curved edges or sides meet; valid but wide, and slow, for
/// ellipsoids and hemispheres. About the input as docs/derivations.md defines it. Milliseconds for boxes, tenths of a
/// second for discs.
SignedDistance exact_signed_distance(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b);

/// For ellipsoids and spheres, from a direction in A's frame close to the normal at contact, pointing from A to B; it
/// may have any length. Near contact the bounds are as narrow as the square of what the direction is off. Infinite
/// error where the bodies are as deep in each other as their sharpest tips are blunt.
SignedDistance ellipsoid_signed_distance(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                         const Vec3d& normal);

namespace exact {

using Float = boost::multiprecision::cpp_bin_float_100;

/// Minus the least h_K(n), and the n where it is taken (any length), for K = conv(a) - conv(b).
struct Deepest {
  Float signed_distance;  // to a hundred digits
  Point direction;        // from A to B
};

/// By the normals of all faces of K (exact_axes.h) where the hulls share a point, compared as squares, in whole
/// numbers; by `nearest_to_origin` where they do not. Of a K without volume that holds the origin the depth is 0.
Deepest deepest(const std::vector<Point>& a, const std::vector<Point>& b);

}  // namespace exact
}  // namespace vex
