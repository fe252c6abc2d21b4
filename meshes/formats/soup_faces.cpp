#include "meshes/formats/soup_faces.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "engine/numeric/errors.h"
#include "meshes/machine_memory.h"

namespace vex {

void check_soup_size(std::uint64_t n_points, std::uint64_t n_corners, const std::string& name) {
  if (n_points > kMostSoupPoints || n_corners > kMostSoupPoints) {
    throw InputError("the mesh is too large (" + name + ": more than 2^30 vertices or corners of faces) - simplify it");
  }
}

SoupRoom::SoupRoom(std::uint64_t n_file_bytes, std::string name, std::uint64_t beside_a_point,
                   std::uint64_t beside_a_corner)
    : SoupRoom(n_file_bytes, std::move(name), beside_a_point, beside_a_corner, machine_memory()) {}

// A face's size is beside its corners.
SoupRoom::SoupRoom(std::uint64_t n_file_bytes, std::string name, std::uint64_t beside_a_point,
                   std::uint64_t beside_a_corner, std::uint64_t memory)
    : n_file_bytes_(n_file_bytes),
      name_(std::move(name)),
      bytes_of_point_(sizeof(Vec3d) + beside_a_point),
      bytes_of_corner_(2 * sizeof(std::uint32_t) + beside_a_corner),
      memory_(memory) {}

void SoupRoom::allow_more(std::uint64_t n_points, std::uint64_t n_corners) {
  check_soup_size(n_points, n_corners, name_);
  constexpr std::uint64_t kAtOnce = 10'000;
  allowed_points_ = std::max(allowed_points_, n_points + n_points / 8 + kAtOnce);
  allowed_corners_ = std::max(allowed_corners_, n_corners + n_corners / 8 + kAtOnce);
  // An array that grows is there twice for a moment.
  const std::uint64_t needed =
      n_file_bytes_ + 2 * (bytes_of_point_ * allowed_points_ + bytes_of_corner_ * allowed_corners_);
  if (needed <= memory_ / 4 * 3) return;
  throw InputError("the mesh is too large for this machine (" + name_ + ": " + std::to_string(n_points) +
                   " vertices and " + std::to_string(n_corners) + " corners of faces so far, with " +
                   std::to_string(memory_ / kMiB) + " MiB of memory) - simplify it");
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
