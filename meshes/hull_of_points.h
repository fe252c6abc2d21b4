// The body that --hull makes: the convex hull of any points, with no more vertices than it has.
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

}  // namespace vex
