// What a mesh file holds once everything but its geometry is left out: points, and faces that name them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "engine/numeric/vec3.h"

namespace vex {

/// How finely a file states its coordinates.
struct CoordinateDigits {
  enum class Kind : std::uint8_t {
    doubles,   // 64-bit numbers; or text that shows no sign of having been rounded more coarsely
    floats,    // 32-bit numbers; or text that holds nothing but such, with all their digits
    decimals,  // text whose writer rounded to a number of digits
  };

  Kind kind = Kind::doubles;
  int n_digits = 0;         // of decimals: significant digits that the largest coordinate has, or would have
  double last_place = 0.0;  // one unit in the last place of the coordinate of largest magnitude, a length; 0 where the
                            // points are not from a file
};

/// Points and polygons, as they come: nothing is welded, and nothing is promised of how the faces meet.
struct PolygonSoup {
  std::vector<Vec3d> points;              // what the file says, correctly rounded to double
  std::vector<std::uint32_t> corners;     // of all faces, one after another: indices into `points`
  std::vector<std::uint32_t> face_sizes;  // the number of corners of each face, three at least
  std::size_t n_parts = 0;                // meshes of the file, counted once for each node that shows them
  std::size_t n_ignored_faces = 0;        // points and lines: "faces" of fewer than three corners
  CoordinateDigits digits;
  std::string unit;          // of length, as the file states it: "mm"; empty where it states none
  double unit_metres = 0.0;  // that unit in metres; 0 where the file states none
  std::string unconfined;    // why the process that read it was not confined; empty where it was, or needed not be

  void add_face(std::initializer_list<std::uint32_t> face) {
    corners.insert(corners.end(), face);
    face_sizes.push_back(static_cast<std::uint32_t>(face.size()));
  }
};

}  // namespace vex
