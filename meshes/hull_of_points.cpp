#include "meshes/hull_of_points.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "meshes/exact_hull.h"
#include "meshes/exact_sign.h"
#include "meshes/report_text.h"

namespace vex {
namespace {

constexpr std::uint32_t kNotNumbered = std::numeric_limits<std::uint32_t>::max();

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

}  // namespace

std::vector<bool> hull_corners(const Triangles& convex) {
  std::vector<unsigned char> n_edges(convex.vertices.size(), 0);
  for (std::uint32_t h = 0; h < convex.mates.size(); ++h) {
    if (h % 4096 == 0) end_if_interrupted();
    const std::uint32_t tail = convex.tail(h);
    if (n_edges[tail] < 3 &&
        orientation_sign(convex.point(tail), convex.point(convex.head(h)), convex.point(convex.opposite(h)),
                         convex.point(convex.opposite(convex.mates[h]))) != 0) {
      ++n_edges[tail];
    }
  }
  std::vector<bool> is_corner(n_edges.size());
  for (std::size_t v = 0; v < n_edges.size(); ++v) {
    is_corner[v] = n_edges[v] >= 3;
  }
  return is_corner;
}

HullOfPoints over_used_vertices(Triangles convex, const std::vector<bool>& is_used) {
  HullOfPoints result;
  std::vector<std::uint32_t> renumbered(convex.vertices.size(), kNotNumbered);
  for (std::size_t v = 0; v < renumbered.size(); ++v) {
    if (is_used[v]) {
      renumbered[v] = static_cast<std::uint32_t>(result.vertices.size());
      result.vertices.push_back(convex.vertices[v]);
    }
  }
  for (auto& triangle : convex.corners) {
    for (std::uint32_t& corner : triangle) {
      corner = renumbered[corner];
    }
  }
  result.triangles = std::move(convex);
  result.triangles.vertices = result.vertices;
  return result;
}

std::vector<Vec3d> chosen_points(std::span<const Vec3d> points, const std::vector<bool>& is_chosen) {
  std::vector<Vec3d> result;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (is_chosen[v]) {
      result.push_back(points[v]);
    }
  }
  return result;
}

HullOfPoints hull_of_points(std::span<const Vec3d> points) {
  const auto not_finite = std::ranges::find_if_not(points, [](const Vec3d& p) { return is_finite(p); });
  if (not_finite != points.end()) {
    throw InputError("a point is not finite (" + point_text(*not_finite) + ") - give finite coordinates");
  }
  std::optional<Triangles> hull = exact_hull(points);
  if (!hull) {
    refuse(points);
  }
  const std::vector<bool> is_corner = hull_corners(*hull);
  std::vector<bool> is_used(points.size(), false);
  for (const auto& triangle : hull->corners) {
    for (const std::uint32_t v : triangle) {
      is_used[v] = true;
    }
  }
  if (is_used != is_corner) {  // once more, without those inside facets and edges
    const std::vector<Vec3d> corners = chosen_points(points, is_corner);
    if (std::optional<Triangles> of_corners = exact_hull(corners)) {
      return over_used_vertices(std::move(*of_corners), std::vector<bool>(corners.size(), true));
    }
  }
  return over_used_vertices(std::move(*hull), is_used);
}

}  // namespace vex
