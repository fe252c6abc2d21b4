// The last condition on a mesh: convex, exactly or within the user's tolerance.
#pragma once

#include <optional>

#include "meshes/polyhedron_measures.h"
#include "meshes/triangles.h"

namespace vex {

/// The convex hull of a mesh that is convex only within the tolerance.
struct HullInstead {
  Triangles triangles;  // over the mesh's own vertices
  VolumeAndCentroid solid;
  double reflex_depth = 0.0;  // a length: the deepest reflex edge, vertex or triangle of the mesh
};

/// Nothing where the surface is convex as it is. Its hull where it is within `tolerance` times `size` of convex: no
/// edge is more reflex, no vertex and no triangle's middle lies deeper below the hull, and volume and area agree with
/// the hull's as far as that allows; many shallow edges can add up to a body far from convex. Otherwise throws
/// InputError.
std::optional<HullInstead> checked_convexity(const Triangles& mesh, const VolumeAndCentroid& solid, double size,
                                             double tolerance);

}  // namespace vex
