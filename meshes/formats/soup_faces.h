// What the readers of several formats do with faces.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "meshes/polygon_soup.h"

namespace vex {

/// Points and corners have 32-bit names with room to spare; more than 2^30 of either are refused with the file's name.
constexpr std::uint64_t kMostSoupPoints = std::uint64_t{1} << 30;
void check_soup_size(std::uint64_t n_points, std::uint64_t n_corners, const std::string& name);

/// Sees, while a file is read, that what has been read of it and the file itself fit into three quarters of the memory:
/// of the shortest numbers that is eight times the file.
class SoupRoom {
 public:
  /// `beside_a_point`, `beside_a_corner`: what the reader keeps of each besides the soup, in bytes.
  SoupRoom(std::uint64_t n_file_bytes, std::string name, std::uint64_t beside_a_point = 0,
           std::uint64_t beside_a_corner = 0);
  SoupRoom(std::uint64_t n_file_bytes, std::string name, std::uint64_t beside_a_point, std::uint64_t beside_a_corner,
           std::uint64_t memory);

  /// Before so many of the file are held. Throws InputError with its name, and as check_soup_size does.
  void require(std::uint64_t n_points, std::uint64_t n_corners) {
    if (n_points > allowed_points_ || n_corners > allowed_corners_) allow_more(n_points, n_corners);
  }

 private:
  void allow_more(std::uint64_t n_points, std::uint64_t n_corners);

  std::uint64_t n_file_bytes_;
  std::string name_;
  std::uint64_t bytes_of_point_, bytes_of_corner_, memory_;
  std::uint64_t allowed_points_ = 0, allowed_corners_ = 0;
};

/// A face with these corners; fewer than three are counted as ignored.
void add_polygon(std::span<const std::uint32_t> corners, PolygonSoup* soup);

/// The triangles of a strip: each corner from the third on makes one with the two before it, every other one turned
/// round, so that all face the same side. Fewer than three corners are counted as ignored. Strips go round bends by
/// triangles that name a corner twice; they are no faces and left out.
void add_triangle_strip(std::span<const std::uint32_t> corners, PolygonSoup* soup);

}  // namespace vex
