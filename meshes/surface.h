// A surface made of polygons, and the conditions on how they meet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/numeric/vec3.h"

namespace vex {

/// Polygons over shared vertices, in flat arrays. A half-edge is named by the corner that it starts at.
struct PolygonSurface {
  std::vector<Vec3d> vertices;               // in lexicographic order of their coordinates
  std::vector<std::uint32_t> corners;        // of all faces, one after another: indices into `vertices`
  std::vector<std::uint32_t> face_begin{0};  // face f has the corners face_begin[f] .. face_begin[f + 1] - 1

  std::size_t n_faces() const { return face_begin.size() - 1; }
  std::span<const std::uint32_t> face(std::size_t f) const {
    return {corners.data() + face_begin[f], corners.data() + face_begin[f + 1]};
  }

  /// Turns each face so that its lowest vertex comes first, and sorts the faces by their corners.
  void put_in_order();
  /// Reverses every face (what was outside is inside), in order again.
  void turn_inside_out();
};

/// Checks that the faces form one closed surface of the kind of a sphere, in this order: there are faces; they hang
/// together by shared vertices; every edge is shared by exactly two; and runs in opposite directions in them; the Euler
/// characteristic is 2. Throws InputError naming the first condition that fails, where, and by how much.
/// Returns for each half-edge the one that it is paired with.
std::vector<std::uint32_t> checked_half_edges(const PolygonSurface& surface);

/// How the half-edges of any faces at all are paired.
struct HalfEdgePairs {
  std::vector<std::uint32_t> mates;  // as checked_half_edges returns them, where `problem` is empty
  std::string problem;               // why they do not all run opposite to exactly one other
};
HalfEdgePairs half_edge_pairs(const PolygonSurface& surface);

/// For each vertex the least of those that faces connect it with: the name of its part.
std::vector<std::uint32_t> component_of_each_vertex(const PolygonSurface& surface);

}  // namespace vex
