// Faces and edges of small polytopes, to put one on another.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/support/exact_form.h"

namespace vex {

struct Features {
  struct Face {
    Vec3d unit_normal;  // outwards
    std::vector<Vec3d> vertices;
  };
  struct Edge {
    Vec3d from, to;
    Vec3d unit_normals[2];  // of the faces on either side
  };
  std::vector<Vec3d> vertices;
  std::vector<Face> faces;
  std::vector<Edge> edges;
};

/// None for bodies that are curved, rounded, flat, or of more than 20 vertices: every plane through three of them is
/// tried. Vertices within 1e-9 of a face's plane, relative, count as on it.
Features features_of(const ExactForm& form);

}  // namespace vex
