// The hull of points of a body's surface: its faces and its sharp edges.
#pragma once

#include <vector>

#include "engine/support/convex_body.h"

namespace vex {

struct HullFace {
  std::vector<Vec3d> corners;  // counterclockwise from outside; triangles in one plane are one face
  Vec3d unit_normal;
};

struct HullEdge {
  Vec3d from, to;
  Vec3d unit_left, unit_right;  // normals of the faces beside it
};

struct SampledHull {
  std::vector<HullFace> faces;
  std::vector<HullEdge> edges;  // between different faces
};

/// Of a polytope exactly; of other bodies, of support points in directions all around. Empty for a flat body.
SampledHull sampled_hull(const ConvexBody& body);

/// Whether the point is inside the hull, or behind it for an eye far away towards `unit_view`. Points on the surface
/// that the eye sees are not. `size` is what the tolerance is relative to.
bool is_covered(const SampledHull& hull, const Vec3d& point, const Vec3d& unit_view, double size);

}  // namespace vex
