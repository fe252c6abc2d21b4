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
/// The distance from any facet's plane bounds a point's depth from above; the least of them is the depth. The facet is
/// found from where a neighbour in the mesh was found, by steps to a neighbouring facet whose plane is nearer and by a
/// short walk to the facet that the ray from the centroid meets: near-linear for all points together. Where the bound
/// so found exceeds `enough`, all facets are asked.
HullDepth depth_below_hull(const Triangles& mesh, const Triangles& hull, const LocalPoint& centroid, double enough);

}  // namespace vex
