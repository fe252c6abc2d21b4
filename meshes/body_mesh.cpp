#include "meshes/body_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "engine/numeric/errors.h"
#include "meshes/hull_of_points.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

constexpr double kGrain = 0x1p-22;  // of the circumradius: less than what is left of it in 32 bits

Vec3d unit(const Vec3d& v) {
  const double length = norm(v);
  return length > 0.0 ? (1.0 / length) * v : Vec3d{0.0, 0.0, 1.0};
}

// Rings about the z axis, which most bodies with curved parts turn about; and beside each axis of the frame four
// directions, of which each has a corner of a flat part that faces there.
std::vector<Vec3d> sample_directions(int n_around) {
  std::vector<Vec3d> dirs = directions_around(n_around);
  constexpr double kBeside = 1e-7;
  for (const double sign : {-1.0, 1.0}) {
    for (const double u : {-kBeside, kBeside}) {
      for (const double v : {-kBeside, kBeside}) {
        dirs.push_back({sign, u, v});
        dirs.push_back({u, sign, v});
        dirs.push_back({u, v, sign});
      }
    }
  }
  return dirs;
}

// A face of a rounded polytope is that of its core, moved out by the radius.
void add_faces_of_core(const ConvexBody& body, std::vector<Vec3d>& points) {
  if (!body.is_rounded_polytope() || !(body.ball_radius() > 0.0)) return;
  const std::optional<ExactForm> form = body.exact_form();
  if (!form || form->points.size() < 4) return;
  try {
    const HullOfPoints hull = hull_of_points(form->points);
    for (const auto& [i, j, k] : hull.triangles.corners) {
      const Vec3d &a = hull.vertices[i], &b = hull.vertices[j], &c = hull.vertices[k];
      const Vec3d normal = unit(cross(b - a, c - a));
      for (const Vec3d& corner : {a, b, c}) points.push_back(corner + body.ball_radius() * normal);
    }
  } catch (const InputError&) {
    // A flat core has no sides but those that the directions beside the axes find.
  }
}

std::vector<Vec3d> points_of(const ConvexBody& body, int n_around) {
  std::vector<Vec3d> points = vertices_of(body);
  if (!points.empty()) return points;
  for (const Vec3d& dir : sample_directions(n_around)) points.push_back(body.support(dir));
  add_faces_of_core(body, points);
  return points;
}

std::tuple<double, double, double> lexicographic(const Vec3d& p) { return {p.x, p.y, p.z}; }

// Seen from the centre. Of a body with curved parts on a grid as fine as what is left in 32 bits, so that points that
// are one but for rounding become one, and flat parts flat.
void set_points(const ConvexBody& body, bool is_polytope, std::vector<Vec3d>& points) {
  const double grain = kGrain * body.circumradius();
  const auto rounded = [&](double x) { return is_polytope ? x : grain * std::round(x / grain); };
  for (Vec3d& p : points) {
    const Vec3d seen = p - body.centre();
    p = {rounded(seen.x), rounded(seen.y), rounded(seen.z)};
  }
  std::ranges::sort(points, {}, lexicographic);
  const auto are_equal = [&](const Vec3d& p, const Vec3d& q) { return lexicographic(p) == lexicographic(q); };
  points.erase(std::unique(points.begin(), points.end(), are_equal), points.end());
}

// Twice the area of a, b, c, seen along -z.
double turn(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The corners of a polygon in the plane z = 0, counter-clockwise, of points sorted by x and y (A. M. Andrew, Inf.
// Process. Lett. 9, 216, 1979).
std::vector<Vec3d> polygon_of(const std::vector<Vec3d>& points) {
  std::vector<Vec3d> corners;
  const auto join = [&corners](const Vec3d& p, std::size_t n_kept) {
    while (corners.size() > n_kept && turn(corners.end()[-2], corners.back(), p) <= 0.0) corners.pop_back();
    corners.push_back(p);
  };
  for (const Vec3d& p : points) join(p, 1);
  const std::size_t n_lower = corners.size();
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) join(*p, n_lower);
  corners.pop_back();  // the first one again
  return corners;
}

// All of them in one plane of the frame, across the axis of this number: a fan about the first, and one normal.
BodyMesh flat_mesh(std::vector<Vec3d> points, int across) {
  // The axes turn in a circle, so that counter-clockwise stays so.
  const auto turned = [](const Vec3d& p, int by) {
    return by == 0 ? p : by == 1 ? Vec3d{p.y, p.z, p.x} : Vec3d{p.z, p.x, p.y};
  };
  const int by = (across + 1) % 3;
  for (Vec3d& p : points) p = turned(p, by);
  std::ranges::sort(points, {}, lexicographic);
  BodyMesh mesh;
  mesh.is_flat = true;
  for (const Vec3d& corner : polygon_of(points)) mesh.points.push_back(turned(corner, (3 - by) % 3));
  mesh.normals.assign(mesh.points.size(), turned({0.0, 0.0, 1.0}, (3 - by) % 3));
  for (std::uint32_t k = 1; k + 1 < mesh.points.size(); ++k) {
    mesh.indices.insert(mesh.indices.end(), {0, k, k + 1});
  }
  return mesh;
}

BodyMesh line_mesh(const std::vector<Vec3d>& points) {
  BodyMesh mesh;
  mesh.is_line = true;
  mesh.points = {points.front(), points.back()};
  mesh.indices = {0, 1};
  return mesh;
}

// Triangles about a vertex whose planes are no farther from each other than this are one smooth surface.
class Shading {
 public:
  Shading(const HullOfPoints& hull, double crease_rad) : hull_(hull), least_cosine_(std::cos(crease_rad)) {
    const auto& corners = hull.triangles.corners;
    around_.resize(hull.vertices.size());
    for (std::uint32_t t = 0; t < corners.size(); ++t) {
      const auto& [i, j, k] = corners[t];
      const Vec3d &a = hull.vertices[i], &b = hull.vertices[j], &c = hull.vertices[k];
      areas_.push_back(cross(b - a, c - a));
      for (const std::uint32_t vertex : corners[t]) around_[vertex].push_back(t);
    }
  }

  Vec3d normal(std::uint32_t triangle, std::uint32_t vertex) const {
    const Vec3d own = unit(areas_[triangle]);
    Vec3d sum;
    for (const std::uint32_t other : around_[vertex]) {
      if (dot(unit(areas_[other]), own) >= least_cosine_) sum = sum + areas_[other];
    }
    return unit(sum);
  }

 private:
  const HullOfPoints& hull_;
  double least_cosine_;
  std::vector<Vec3d> areas_;                        // twice the area, along the normal
  std::vector<std::vector<std::uint32_t>> around_;  // triangles of a vertex
};

BodyMesh solid_mesh(const HullOfPoints& hull, double crease_rad) {
  const Shading shading(hull, crease_rad);
  BodyMesh mesh;
  std::map<std::tuple<std::uint32_t, double, double, double>, std::uint32_t> known;
  constexpr double kSame = 0x1p-20;  // of normals that a viewer cannot tell apart
  for (std::uint32_t t = 0; t < hull.triangles.size(); ++t) {
    for (const std::uint32_t vertex : hull.triangles.corners[t]) {
      const Vec3d normal = shading.normal(t, vertex);
      const auto key =
          std::tuple(vertex, std::round(normal.x / kSame), std::round(normal.y / kSame), std::round(normal.z / kSame));
      const auto [found, is_new] = known.emplace(key, static_cast<std::uint32_t>(mesh.points.size()));
      if (is_new) {
        mesh.points.push_back(hull.vertices[vertex]);
        mesh.normals.push_back(normal);
      }
      mesh.indices.push_back(found->second);
    }
  }
  return mesh;
}

}  // namespace

std::vector<Vec3d> directions_around(int n_around) {
  std::vector<Vec3d> dirs;
  const int n_rings = n_around / 2;
  for (int i = 0; i <= n_rings; ++i) {
    const double polar = std::numbers::pi * i / n_rings;
    for (int j = 0; j < n_around; ++j) {
      const double azimuth = 2.0 * std::numbers::pi * j / n_around;
      dirs.push_back({std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)});
      if (i == 0 || i == n_rings) break;
    }
  }
  return dirs;
}

BodyMesh mesh_of_points(std::span<const Vec3d> points, double crease_rad) {
  return solid_mesh(hull_of_points(points), crease_rad);
}

BodyMesh mesh_of(const ConvexBody& body, int n_around) {
  std::vector<Vec3d> points = points_of(body, n_around);
  const bool is_polytope = !vertices_of(body).empty();
  set_points(body, is_polytope, points);
  std::vector<int> flat_along;  // axes of the frame
  for (int axis = 0; axis < 3; ++axis) {
    const auto is_0 = [axis](const Vec3d& p) { return (axis == 0 ? p.x : axis == 1 ? p.y : p.z) == 0.0; };
    if (std::ranges::all_of(points, is_0)) flat_along.push_back(axis);
  }
  BodyMesh mesh;
  if (flat_along.size() >= 2) {
    mesh = line_mesh(points);
  } else if (flat_along.size() == 1) {
    mesh = flat_mesh(std::move(points), flat_along.front());
  } else {
    mesh = mesh_of_points(points, is_polytope ? kFlatRad : kCreaseRad);
  }
  mesh.origin = body.centre();
  return mesh;
}

}  // namespace vex
