// The surface that B's centre may not enter, as triangles, for pictures: the boundary of A + (-R B).
#pragma once

#include "engine/numeric/transform.h"
#include "meshes/body_mesh.h"

namespace vex {

struct DifferenceMesh {
  BodyMesh surface;       // of B's centre seen from A's; without points where A - R B has no volume
  bool is_exact = false;  // the hull of all differences of vertices, not of some points of the surface
};

/// Of B turned by R, `rotation` without its translation, in A's frame. Of two polytopes with at most 4096 pairs of
/// vertices exact, but for the rounding of the differences. Otherwise the hull of points of the surface, and so inside
/// of it: the support points in about n_around^2 directions, rings about each body's z axis, and those of the flat
/// faces of `mesh_a` and `mesh_b`, which are mesh_of each body.
DifferenceMesh difference_mesh(const ConvexBody& a, const BodyMesh& mesh_a, const ConvexBody& b, const BodyMesh& mesh_b,
                               const Transformd& rotation, int n_around);

}  // namespace vex
