#include "meshes/hull_of_points.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "engine/numeric/errors.h"
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

/// The same triangles over the vertices that they use alone.
HullOfPoints over(Triangles hull, const std::vector<bool>& is_used) {
  HullOfPoints result;
  std::vector<std::uint32_t> renumbered(hull.vertices.size(), kNone);
  for (std::size_t v = 0; v < renumbered.size(); ++v) {
    if (is_used[v]) {
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

/// Whether all points are one, lie on a line or lie in a plane: 0, 1, 2; 3 where they do not.
int dimension_of(std::span<const Vec3d> points) {
  const auto first_that = [&](const auto& condition) {
    return std::ranges::find_if(points, [&](const Vec3d& p) { return condition(p); });
  };
  const Vec3d a = points[0];
  const auto b = first_that([&](const Vec3d& p) { return p.x != a.x || p.y != a.y || p.z != a.z; });
  if (b == points.end()) {
    return 0;
  }
  const auto c = first_that([&](const Vec3d& p) { return !collinear(a, *b, p); });
  if (c == points.end()) {
    return 1;
  }
  return first_that([&](const Vec3d& p) { return orientation_sign(a, *b, *c, p) != 0; }) == points.end() ? 2 : 3;
}

[[noreturn]] void refuse(std::span<const Vec3d> points) {
  if (points.empty()) {
    throw InputError("the mesh has no points (0 vertices were read) - name a file that holds some");
  }
  const int dimension = dimension_of(points);
  if (dimension == 3) {
    throw InputError("no convex hull could be made of the points (they are too near to one plane, " +
                     point_text(points.front()) + " among them) - for a flat body use plate:A,B or disc:R");
  }
  const std::string all = "all " + std::to_string(points.size()) + " of them lie ";
  const std::string flat = dimension == 0   ? "all of them are one point"
                           : dimension == 1 ? all + "on one straight line"
                                            : all + "in one plane";
  throw InputError("the points span no volume (" + flat + ", the first is " + point_text(points.front()) +
                   ") - for a flat body use plate:A,B or disc:R, for a straight line needle:L");
}

std::vector<Vec3d> chosen(std::span<const Vec3d> points, const std::vector<bool>& is_chosen) {
  std::vector<Vec3d> result;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (is_chosen[v]) {
      result.push_back(points[v]);
    }
  }
  return result;
}

}  // namespace

HullOfPoints hull_of_points(std::span<const Vec3d> points) {
  std::optional<Triangles> hull = exact_hull(points);
  if (!hull) {
    refuse(points);
  }
  const std::vector<bool> is_corner = corners_of(*hull);
  std::vector<bool> is_used(points.size(), false);
  for (const auto& triangle : hull->corners) {
    for (const std::uint32_t v : triangle) {
      is_used[v] = true;
    }
  }
  if (is_used != is_corner) {  // once more, without those inside facets and edges
    const std::vector<Vec3d> corners = chosen(points, is_corner);
    if (std::optional<Triangles> of_corners = exact_hull(corners)) {
      return over(std::move(*of_corners), std::vector<bool>(corners.size(), true));
    }
  }
  return over(std::move(*hull), is_used);
}

}  // namespace vex
