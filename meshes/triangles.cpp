#include "meshes/triangles.h"

#include <algorithm>
#include <utility>

#include "engine/numeric/interruption.h"
#include "meshes/determinant.h"

namespace vex {
namespace {

bool has_area(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return norm(cross(exact_difference(b, a), exact_difference(c, a))) > 0.0;
}

/// Where in the face the fan starts: 0 where every choice leaves a triangle without area.
std::uint32_t fan_start(std::span<const Vec3d> vertices, std::span<const std::uint32_t> face) {
  constexpr std::uint32_t kTries = 16;
  const auto size = static_cast<std::uint32_t>(face.size());
  for (std::uint32_t start = 0; size > 3 && start < std::min(size, kTries); ++start) {
    const auto corner = [&](std::uint32_t i) { return vertices[face[(start + i) % size]]; };
    bool all_have_area = true;
    for (std::uint32_t i = 1; i + 1 < size && all_have_area; ++i) {
      all_have_area = has_area(corner(0), corner(i), corner(i + 1));
    }
    if (all_have_area) {
      return start;
    }
  }
  return 0;
}

}  // namespace

Triangles fan_triangles(const PolygonSurface& surface, std::span<const std::uint32_t> mates) {
  Triangles result;
  result.vertices = surface.vertices;
  const std::size_t n_triangles = surface.corners.size() - 2 * surface.n_faces();
  result.corners.reserve(n_triangles);
  result.mates.assign(3 * n_triangles, 0);
  std::vector<std::uint32_t> half_edge_of_corner(surface.corners.size());
  for (std::size_t f = 0; f < surface.n_faces(); ++f) {
    if (f % 4096 == 0) end_if_interrupted();
    const auto face = surface.face(f);
    const std::uint32_t begin = surface.face_begin[f];
    const auto size = static_cast<std::uint32_t>(face.size());
    const auto first = static_cast<std::uint32_t>(3 * result.corners.size());
    const std::uint32_t start = fan_start(surface.vertices, face);
    const auto at = [start, size](std::uint32_t i) { return (start + i) % size; };
    half_edge_of_corner[begin + start] = first;
    for (std::uint32_t i = 1; i + 1 < size; ++i) {
      const std::uint32_t triangle = first + 3 * (i - 1);  // its first half-edge
      result.corners.push_back({face[start], face[at(i)], face[at(i + 1)]});
      half_edge_of_corner[begin + at(i)] = triangle + 1;
      if (i + 2 < size) {  // the diagonal to the next triangle of the fan
        result.mates[triangle + 2] = triangle + 3;
        result.mates[triangle + 3] = triangle + 2;
      }
    }
    half_edge_of_corner[begin + at(size - 1)] = first + 3 * (size - 3) + 2;
  }
  for (std::size_t corner = 0; corner < mates.size(); ++corner) {
    result.mates[half_edge_of_corner[corner]] = half_edge_of_corner[mates[corner]];
  }
  return result;
}

std::optional<Triangles> paired_triangles(std::span<const Vec3d> vertices,
                                          std::vector<std::array<std::uint32_t, 3>> corners) {
  Triangles result;
  result.vertices = vertices;
  result.corners = std::move(corners);
  result.mates.assign(3 * result.corners.size(), 0);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> by_edge;  // the two vertices, lower first; the half-edge
  by_edge.reserve(result.mates.size());
  for (std::uint32_t h = 0; h < result.mates.size(); ++h) {
    const auto [low, high] = std::minmax({result.tail(h), result.head(h)});
    by_edge.emplace_back(std::uint64_t{low} << 32U | high, h);
  }
  std::sort(by_edge.begin(), by_edge.end());
  for (std::size_t i = 0; i < by_edge.size(); i += 2) {
    const bool alone = i + 1 == by_edge.size() || by_edge[i + 1].first != by_edge[i].first;
    const bool crowded = i + 2 < by_edge.size() && by_edge[i + 2].first == by_edge[i].first;
    if (alone || crowded || result.tail(by_edge[i].second) == result.tail(by_edge[i + 1].second)) {
      return std::nullopt;
    }
    result.mates[by_edge[i].second] = by_edge[i + 1].second;
    result.mates[by_edge[i + 1].second] = by_edge[i].second;
  }
  return result;
}

}  // namespace vex
