// A closed surface of triangles with its adjacency.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/numeric/vec3.h"
#include "meshes/surface.h"

namespace vex {

/// Triangles over vertices that somebody else keeps. Half-edge 3 t + k runs from corner k of triangle t to corner k
/// + 1.
struct Triangles {
  std::span<const Vec3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> corners;
  std::vector<std::uint32_t> mates;  // of each half-edge: the one that runs back along it in the neighbour

  std::size_t size() const { return corners.size(); }
  Vec3d point(std::uint32_t vertex) const { return vertices[vertex]; }
  Vec3d corner(std::size_t triangle, std::size_t k) const { return vertices[corners[triangle][k]]; }

  /// Where a half-edge starts and ends, and the corner of its triangle that is on neither end.
  std::uint32_t tail(std::uint32_t half_edge) const { return corners[half_edge / 3][half_edge % 3]; }
  std::uint32_t head(std::uint32_t half_edge) const { return corners[half_edge / 3][(half_edge + 1) % 3]; }
  std::uint32_t opposite(std::uint32_t half_edge) const { return corners[half_edge / 3][(half_edge + 2) % 3]; }
};

/// The half-edges that follow and precede one in its triangle.
constexpr std::uint32_t next_in_triangle(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
constexpr std::uint32_t previous_in_triangle(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

/// Each face cut into triangles that fan out from its first corner, or from the first one of a few for which no
/// triangle is without area (a corner may lie on a straight side). Diagonals are paired within their own face, so two
/// faces that share more than an edge stay apart. `mates` is what checked_half_edges returned.
Triangles fan_triangles(const PolygonSurface& surface, std::span<const std::uint32_t> mates);

/// Triangles given by their corners, over vertices of which some may be unused. Nothing where they do not form a
/// closed, consistently oriented surface.
std::optional<Triangles> paired_triangles(std::span<const Vec3d> vertices,
                                          std::vector<std::array<std::uint32_t, 3>> corners);

}  // namespace vex
