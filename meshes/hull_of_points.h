// The convex hull of any points, which --hull makes, with no more vertices than it has.
#pragma once

#include <span>
#include <vector>

#include "engine/numeric/vec3.h"
#include "meshes/triangles.h"

namespace vex {

struct HullOfPoints {
  std::vector<Vec3d> vertices;  // in the order of the points; every one is a corner of the hull
  Triangles triangles;          // over these vertices, convex exactly
};

/// The hull of points in any position, in general position or not. A point is left out only where signs that are exact
/// prove it inside, on a facet or on an edge, so the vertices' hull is all points' hull. Throws InputError where the
/// points span no volume.
HullOfPoints hull_of_points(std::span<const Vec3d> points);

/// For each vertex whether three or more edges of a convex surface, diagonals of its facets not counted, meet there, by
/// exact signs. None do inside a facet, and two on an edge.
std::vector<bool> hull_corners(const Triangles& convex);

/// The same triangles over the vertices that they use, and no others.
HullOfPoints over_used_vertices(Triangles convex, const std::vector<bool>& is_used);

/// In the same order.
std::vector<Vec3d> chosen_points(std::span<const Vec3d> points, const std::vector<bool>& is_chosen);

}  // namespace vex
