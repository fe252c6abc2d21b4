// The thirteen Archimedean solids: faces regular polygons of two or three kinds, all vertices alike, all edges of one
// length. Prisms and antiprisms apart.
#pragma once

#include <vector>

#include "shapes/faced_polytope.h"

namespace vex {

enum class ArchimedeanKind {
  truncated_tetrahedron,
  cuboctahedron,
  truncated_cube,
  truncated_octahedron,
  rhombicuboctahedron,
  truncated_cuboctahedron,
  snub_cube,
  icosidodecahedron,
  truncated_dodecahedron,
  truncated_icosahedron,
  rhombicosidodecahedron,
  truncated_icosidodecahedron,
  snub_dodecahedron
};

/// The body is the hull of the stored doubles, which are the regular body's coordinates to rounding; its centroid is
/// the origin. Two- or threefold axes are x, y and z. Of the two snub ones, which differ from their mirror images, one.
class ArchimedeanSolid : public FacedPolytope {
 public:
  ArchimedeanSolid(ArchimedeanKind kind, double edge);

 private:
  ArchimedeanSolid(const std::vector<Vec3d>& corners, const std::vector<Face>& faces);
};

}  // namespace vex
