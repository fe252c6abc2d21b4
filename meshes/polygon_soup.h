// What a mesh file holds once everything but its geometry is left out: points, and faces that name them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace vex {

/// A point as readers deliver it. These 32-bit floats, promoted to double, are what a mesh *is*.
struct SoupPoint {
  float x = 0.0F, y = 0.0F, z = 0.0F;
};

/// Points and polygons, as they come: nothing is welded, and nothing is promised of how the faces meet.
struct PolygonSoup {
  std::vector<SoupPoint> points;
  std::vector<std::uint32_t> corners;     // of all faces, one after another: indices into `points`
  std::vector<std::uint32_t> face_sizes;  // the number of corners of each face
  std::size_t n_parts = 0;                // meshes of the file, counted once for each node that shows them
  std::size_t n_ignored_faces = 0;        // points and lines: "faces" of fewer than three corners

  void add_face(std::initializer_list<std::uint32_t> face) {
    corners.insert(corners.end(), face);
    face_sizes.push_back(static_cast<std::uint32_t>(face.size()));
  }
};

}  // namespace vex
