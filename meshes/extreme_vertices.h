// What the engine asks each time it looks for a support point: vertices. Those that make no difference are left out.
#pragma once

#include <cstdint>

#include "meshes/hull_of_points.h"

namespace vex {

struct ExtremeVertices {
  HullOfPoints hull;
  double farthest_outside = 0.0;  // no vertex that was left out is farther outside the hull; 0 where none is outside
};

/// What the triangles of a convex surface follow from: the vertices, as a hull's do, or the faces of a file.
enum class MadeFrom : std::uint8_t { vertices, faces };

/// A body of fewer vertices: no vertex of `convex` is farther than `tolerance` outside their hull. `convex` is a convex
/// triangulation over some of its vertices, which are each once and in lexicographic order. First those are left out
/// that are no corners of the hull, by exact signs; then corners, where the tolerance allows. A corner that is farther
/// than that outside the hull of all others stays whatever else is left out. With those, and the outermost vertices in
/// a few directions, the hull is made again and again, and each time that vertex joins which is farthest outside above
/// each facet, until none is farther than the tolerance; or until those that are farther are few beside those that were
/// kept, and are kept too. What is left depends on the vertices alone, not on how a file's faces were cut. Where no
/// corner can go, that is seen without a hull. Of very many corners a few that could go stay: looking for them would
/// take longer than they do.
ExtremeVertices extreme_vertices(HullOfPoints convex, double tolerance, MadeFrom triangles);

}  // namespace vex
