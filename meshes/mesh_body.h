// A convex body on its way from a mesh file to the engine.
#pragma once

#include <vector>

#include "engine/numeric/vec3.h"
#include "meshes/polyhedron_measures.h"
#include "meshes/triangles.h"
#include "shapes/measures.h"

namespace vex {

/// `triangles` are convex, over all of `vertices`, and enclose `solid`.
struct MeshBody {
  std::vector<Vec3d> vertices;
  Triangles triangles;
  VolumeAndCentroid solid;
};

inline Measures measures_of(const MeshBody& body) {
  return {body.solid.volume, surface_area(body.triangles), integrated_mean_curvature(body.triangles)};
}

}  // namespace vex
