// The last condition on a mesh: convex, exactly or within the user's tolerance.
#pragma once

#include <optional>
#include <string>

#include "meshes/polyhedron_measures.h"
#include "meshes/triangles.h"

namespace vex {

/// The convex hull of a mesh that is convex only within the tolerance.
struct HullInstead {
  Triangles triangles;  // over the mesh's own vertices
  VolumeAndCentroid solid;
  double reflex_depth = 0.0;  // a length: the deepest reflex edge, vertex or triangle of the mesh
};

/// How far from convex a mesh may be.
struct ConvexTolerance {
  double of_size = 0.0;
  std::string
      reason;  // why it is no larger, for refusals to add: "what 4 decimals explain"; empty where the user said it
};

/// Nothing where the surface is convex as it is. Its hull where it is within `tolerance` times `size` of convex: no
/// edge is more reflex, and no vertex and no triangle's middle lies deeper below the hull, for many shallow edges can
/// add up to a body far from convex. Besides, the surface winds once about its centroid, hardly any of it faces inward,
/// its volume differs from the hull's by no more than that depth allows, and it is thicker than that depth. Otherwise
/// throws InputError. The hull's triangulation is convex exactly, so its measures are those of the exact hull of its
/// vertices.
std::optional<HullInstead> checked_convexity(const Triangles& mesh, const VolumeAndCentroid& solid, double size,
                                             const ConvexTolerance& tolerance);

}  // namespace vex
