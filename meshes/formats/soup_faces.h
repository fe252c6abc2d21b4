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

/// A face with these corners; fewer than three are counted as ignored.
void add_polygon(std::span<const std::uint32_t> corners, PolygonSoup* soup);

/// The triangles of a strip: each corner from the third on makes one with the two before it, every other one turned
/// round, so that all face the same side. Fewer than three corners are counted as ignored. Strips go round bends by
/// triangles that name a corner twice; they are no faces and left out.
void add_triangle_strip(std::span<const std::uint32_t> corners, PolygonSoup* soup);

}  // namespace vex
