#include "meshes/hull_of_points.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "meshes/exact_hull.h"
#include "meshes/exact_sign.h"
#include "meshes/report_text.h"

namespace vex {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// For each vertex whether three or more of the hull's edges that are no diagonals of a facet meet there. None do
/// inside a facet, and two on an edge.
std::vector<bool> corners_of(const Triangles& hull) {
  std::vector<unsigned char> n_edges(hull.vertices.size(), 0);
  for (std::uint32_t h = 0; h < hull.mates.size(); ++h) {
    const std::uint32_t tail = hull.tail(h);
    if (n_edges[tail] < 3 && orientation_sign(hull.point(tail), hull.point(hull.head(h)), hull.point(hull.opposite(h)),
                                              hull.point(hull.opposite(hull.mates[h]))) != 0) {
      ++n_edges[tail];
    }
  }
  std::vector<bool> is_corner(n_edges.size());
  for (std::size_t v = 0; v < n_edges.size(); ++v) {
    is_corner[v] = n_edges[v] >= 3;
  }
  return is_corner;
}

/// The same triangles over the corners alone, which are all that they use.
HullOfPoints over_corners(Triangles hull, const std::vector<bool>& is_corner) {
  HullOfPoints result;
  std::vector<std::uint32_t> renumbered(hull.vertices.size(), kNone);
  for (std::size_t v = 0; v < renumbered.size(); ++v) {
    if (is_corner[v]) {
      renumbered[v] = static_cast<std::uint32_t>(result.vertices.size());
      result.vertices.push_back(hull.vertices[v]);
    }
  }
  for (auto& triangle : hull.corners) {
    for (std::uint32_t& corner : triangle) {
      corner = renumbered[corner];
    }
  }
  result.triangles = std::move(hull);
  result.triangles.vertices = result.vertices;
  return result;
}

[[noreturn]] void refuse_flat(std::span<const Vec3d> points) {
  throw InputError(
      "the points span no volume (all " + std::to_string(points.size()) +
      " of them lie in one plane) - for a flat body use plate:A,B or disc:R, for a straight line needle:L");
}

}  // namespace

HullOfPoints hull_of_points(std::span<const Vec3d> points) {
  std::optional<Triangles> hull = exact_hull(points);
  if (!hull) {
    refuse_flat(points);
  }
  std::vector<bool> is_corner = corners_of(*hull);
  const bool has_only_corners = std::ranges::all_of(hull->corners, [&](const std::array<std::uint32_t, 3>& triangle) {
    return std::ranges::all_of(triangle, [&](std::uint32_t v) { return is_corner[v]; });
  });
  if (has_only_corners) {
    return over_corners(std::move(*hull), is_corner);
  }
  std::vector<Vec3d> corners;
  for (std::size_t v = 0; v < is_corner.size(); ++v) {
    if (is_corner[v]) {
      corners.push_back(points[v]);
    }
  }
  hull = exact_hull(corners);
  VEX_ENSURE(hull.has_value());
  is_corner.assign(corners.size(), true);
  return over_corners(std::move(*hull), is_corner);
}

}  // namespace vex
