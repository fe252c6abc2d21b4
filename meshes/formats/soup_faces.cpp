#include "meshes/formats/soup_faces.h"

#include <cstddef>

#include "engine/numeric/errors.h"

namespace vex {

void check_soup_size(std::uint64_t n_points, std::uint64_t n_corners, const std::string& name) {
  if (n_points > kMostSoupPoints || n_corners > kMostSoupPoints) {
    throw InputError("the mesh is too large (" + name + ": more than 2^30 vertices or corners of faces) - simplify it");
  }
}

void add_polygon(std::span<const std::uint32_t> corners, PolygonSoup* soup) {
  if (corners.size() < 3) {
    ++soup->n_ignored_faces;
    return;
  }
  soup->corners.insert(soup->corners.end(), corners.begin(), corners.end());
  soup->face_sizes.push_back(static_cast<std::uint32_t>(corners.size()));
}

void add_triangle_strip(std::span<const std::uint32_t> corners, PolygonSoup* soup) {
  if (corners.size() < 3) {
    ++soup->n_ignored_faces;
    return;
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const std::uint32_t a = corners[i - 2];
    const std::uint32_t b = corners[i - 1];
    const std::uint32_t c = corners[i];
    if (a == b || b == c || c == a) continue;
    if (i % 2 == 0) {
      soup->add_face({a, b, c});
    } else {
      soup->add_face({b, a, c});
    }
  }
}

}  // namespace vex
