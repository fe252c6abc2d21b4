// The convex hull of points, by Qhull (Barber, Dobkin, Huhdanpaa 1996).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/numeric/vec3.h"

namespace vex {

/// The hull's triangles, counter-clockwise seen from outside, as indices into `points`. Qhull works in double, so a
/// point that is outside a facet by rounding alone may be left out, and triangles of one facet need not be coplanar to
/// the last bit. Throws InputError where the points are too flat, or too close together, for that.
std::vector<std::array<std::uint32_t, 3>> convex_hull_triangles(std::span<const Vec3d> points);

}  // namespace vex
