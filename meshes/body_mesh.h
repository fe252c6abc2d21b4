// A body as triangles, for pictures.
#pragma once

#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "engine/numeric/vec3.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Corners of triangles, counter-clockwise seen from outside, in the body's frame but for `origin`; of a needle the two
/// ends of a line.
struct BodyMesh {
  Vec3d origin;                // the body's centre: points are seen from there
  std::vector<Vec3d> points;   // of the body, to 2^-22 of its circumradius
  std::vector<Vec3d> normals;  // of length 1, one a point; none of a line
  std::vector<std::uint32_t> indices;
  bool is_flat = false;  // both sides of it are seen
  bool is_line = false;
};

/// Of a polytope its faces, exactly. Of a body with curved parts the hull of its support points in about
/// n_around^2 / 2 directions, among them those of its flat parts, with normals that are smooth where it is.
BodyMesh mesh_of(const ConvexBody& body, int n_around);

/// The hull of points that span a volume; normals are smooth over angles below `crease_rad`. Its origin is 0. Throws
/// InputError where they span none.
BodyMesh mesh_of_points(std::span<const Vec3d> points, double crease_rad);

/// Between planes of polytopes, and between those that a curved surface was cut into.
inline constexpr double kFlatRad = 1e-3, kCreaseRad = 40.0 * std::numbers::pi / 180.0;

/// Directions all around, about n_around^2 / 2, the rings about the z axis among them.
std::vector<Vec3d> directions_around(int n_around);

}  // namespace vex
