// A body as triangles, for pictures.
#pragma once

#include <cstdint>
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

}  // namespace vex
