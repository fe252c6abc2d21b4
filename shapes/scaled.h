// Bodies that are others, stretched along their axes, mirrored, or mapped by a matrix.
#pragma once

#include <array>

#include "engine/numeric/vec3.h"
#include "shapes/body.h"

namespace vex {

/// Factors of bodies that are scaled have magnitudes in this range.
inline constexpr double kLeastFactor = 1e-100, kLargestFactor = 1e100;

/// The points (x f_x, y f_y, z f_z) of the body, about the origin of its frame; a negative factor mirrors. Where a body
/// has an exact form the scaled one has one, which it is exactly: its points, semi-axes and radii times the factors,
/// each product rounded once. Polytopes stay polytopes, boxes boxes; ellipsoids, and balls about the origin, are
/// ellipsoids; a rounded polytope stretched unevenly is the hull of ellipsoids. Without an exact form are, of bodies
/// that have one: a body of curved parts with a ball, stretched unevenly, and one with a dome (hemisphere), mirrored
/// along z.
///
/// V, S and M are known where all factors have one magnitude, and of boxes and ellipsoids; of others V is; none that is
/// out of range.
/// Throws InputError where a factor is 0, not finite, or out of range, or where sizes become so.
Body scaled(const Body& body, const Vec3d& factors);
/// By one factor along all axes.
inline Body scaled(const Body& body, double factor) { return scaled(body, {factor, factor, factor}); }

/// The mirror image in the plane x = 0, exactly.
inline Body mirrored(const Body& body) { return scaled(body, {-1.0, 1.0, 1.0}); }

/// A polytope under a linear map with these rows: its vertices go to (r1 . x, r2 . x, r3 . x), sums of products from
/// left to right, each operation rounded, and those are the body exactly. V is known to some 1e-12, but not of maps that
/// nearly flatten bodies: whose determinant is less than a thousandth of the sum of its products' magnitudes. Throws InputError for a body that
/// is no polytope, and for a matrix that is not finite or whose determinant, to rounding, is 0.
Body mapped(const Body& polytope, const std::array<Vec3d, 3>& rows);

}  // namespace vex
