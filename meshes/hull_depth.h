// How deep the vertices and triangles of a mesh lie below its convex hull.
#pragma once

#include "engine/numeric/vec3.h"
#include "meshes/polyhedron_measures.h"
#include "meshes/triangles.h"

namespace vex {

/// The deepest of the points looked at.
struct HullDepth {
  double depth = 0.0;  // a length, never below the true one but by rounding
  Vec3d where;
};

/// The depth of every vertex of `mesh` and of the middle of each of its triangles below `hull`, a convex triangulation
/// over the same vertices that sees `centroid` from inside. Depth below a convex surface is a concave function, so no
/// point of a triangle lies deeper than three times its middle.
///
/// Each point is found under the hull facet that the ray from the centroid through it meets, by walking over the hull
/// from where a neighbour in the mesh was found: a few steps a point. Its distance from that facet's plane is an upper
/// bound of its depth, which is the least over all facets; where it exceeds `tolerated`, all facets are asked.
HullDepth depth_below_hull(const Triangles& mesh, const Triangles& hull, const LocalPoint& centroid, double tolerated);

}  // namespace vex
