#include "solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace vex::tests {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGolden = std::numbers::phi;

std::vector<Face> box_faces() {
  return {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
}

Solid box_between(const Vec3d& low, const Vec3d& high) {
  Solid solid;
  for (const double x : {low.x, high.x}) {
    for (const double y : {low.y, high.y}) {
      for (const double z : {low.z, high.z}) {
        solid.points.push_back({x, y, z});
      }
    }
  }
  solid.faces = box_faces();
  const Vec3d d = high - low;
  solid.measures = {d.x * d.y * d.z, 2.0 * (d.x * d.y + d.y * d.z + d.z * d.x), kPi * (d.x + d.y + d.z)};
  return solid;
}

/// Over a convex polygon, counter-clockwise, that `edges` go around, from z = `low` up to `high`. Its edges around both
/// ends turn by a right angle, and those that stand by 2 pi in all: M is half the sum of length times angle.
Solid prism(Vec3d start, const std::vector<std::array<double, 2>>& edges, double low, double high) {
  Solid solid;
  const auto n = static_cast<std::uint32_t>(edges.size());
  double area = 0.0;
  double perimeter = 0.0;
  for (const auto& [dx, dy] : edges) {
    solid.points.push_back({start.x, start.y, low});
    solid.points.push_back({start.x, start.y, high});
    area += 0.5 * (start.x * dy - start.y * dx);
    perimeter += std::sqrt(dx * dx + dy * dy);
    start = start + Vec3d{dx, dy, 0.0};
  }
  Face bottom;
  Face top;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    solid.faces.push_back({2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
    bottom.push_back(2 * (n - 1 - i));
    top.push_back(2 * i + 1);
  }
  solid.faces.push_back(bottom);
  solid.faces.push_back(top);
  const double height = high - low;
  solid.measures = {area * height, 2.0 * area + perimeter * height, kPi * (0.5 * perimeter + height)};
  return solid;
}

/// The faces of a regular solid about the origin with edges of 2: around each axis through a face's centre, the
/// vertices that are farthest along it, in order.
std::vector<Face> regular_faces(const std::vector<Vec3d>& points, const std::vector<Vec3d>& axes) {
  std::vector<Face> faces;
  for (const Vec3d& axis : axes) {
    double most = 0.0;
    for (const Vec3d& p : points) most = std::max(most, dot(p, axis));
    Face face;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      if (dot(points[i], axis) > most - 1e-6) face.push_back(i);
    }
    if (face.empty()) continue;
    const Vec3d first = points[face.front()];
    const Vec3d right = first - (dot(first, axis) / dot(axis, axis)) * axis;
    const Vec3d up = cross(axis, right);
    std::ranges::sort(face, {}, [&](std::uint32_t i) {
      return std::atan2(dot(points[i], up) / norm(up), dot(points[i], right) / norm(right));
    });
    faces.push_back(face);
  }
  return faces;
}

/// Cyclic turns of (0, +-b, +-c).
std::vector<Vec3d> rectangles(double b, double c) {
  std::vector<Vec3d> points;
  for (const double y : {-b, b}) {
    for (const double z : {-c, c}) {
      points.push_back({0, y, z});
      points.push_back({z, 0, y});
      points.push_back({y, z, 0});
    }
  }
  return points;
}
std::vector<Vec3d> cube_and(double s, std::vector<Vec3d> points) {
  for (const double x : {-s, s}) {
    for (const double y : {-s, s}) {
      for (const double z : {-s, s}) points.push_back({x, y, z});
    }
  }
  return points;
}

Solid moved(Solid solid, const Vec3d& by) {
  for (Vec3d& p : solid.points) p = p + by;
  return solid;
}

void join(const Solid& other, Solid* solid) {
  const auto first = static_cast<std::uint32_t>(solid->points.size());
  solid->points.insert(solid->points.end(), other.points.begin(), other.points.end());
  for (Face face : other.faces) {
    for (std::uint32_t& corner : face) corner += first;
    solid->faces.push_back(face);
  }
}

}  // namespace

Solid box() { return box_between({0.5, -1, 2}, {1.5, 1, 5}); }

Solid corner(double a, double b, double c) {
  Solid solid;
  solid.points = {{0, 0, 0}, {a, 0, 0}, {0, b, 0}, {0, 0, c}};
  solid.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  // The slanting face has the normal (1/a, 1/b, 1/c); its angle with each other face follows.
  const double norm_of_slant = std::sqrt(1 / (a * a) + 1 / (b * b) + 1 / (c * c));
  const auto slant_edge = [&](double p, double q, double r) {  // opposite to the leg r
    return std::sqrt(p * p + q * q) * (kPi - std::acos(1 / r / norm_of_slant));
  };
  const double slant_area = 0.5 * std::sqrt(a * a * b * b + b * b * c * c + c * c * a * a);
  solid.measures = {a * b * c / 6, 0.5 * (a * b + b * c + c * a) + slant_area,
                    0.5 * ((a + b + c) * kPi / 2 + slant_edge(a, b, c) + slant_edge(b, c, a) + slant_edge(c, a, b))};
  return solid;
}

Solid tetrahedron() { return moved(corner(1, 2, 3), {0.25, -0.5, 1}); }

Solid octahedron() {
  const double r = 1.5;
  Solid solid;
  solid.points = {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}};
  solid.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const double edge = r * std::numbers::sqrt2;
  solid.measures = {4.0 / 3.0 * r * r * r, 4.0 * std::numbers::sqrt3 * r * r, 0.5 * 12 * edge * std::acos(1.0 / 3.0)};
  return moved(solid, {1, 2, -3});
}

Solid wedge() { return prism({-1, 0.5, 0}, {{3, 0}, {0, 4}, {-3, -4}}, 0.25, 2.25); }
Solid whole_wedge() { return prism({10, 13, 0}, {{3, 0}, {0, 4}, {-3, -4}}, 7, 9); }
Solid one_digit_prism() {
  Solid solid = prism({0, 0, 0}, {{9, 0}, {0, 9}, {-9, -8}, {0, -1}}, 0.1, 9);
  std::swap(solid.faces[3], solid.faces.back());
  return solid;
}
Solid five_prism() { return prism({1, 1, 0}, {{2, 0}, {1, 1}, {-1.5, 2}, {-2, -1.5}, {0.5, -1.5}}, -0.5, 1.5); }
Solid twelve_prism() {
  return prism(
      {0, 0.25, 0},
      {{3, 0}, {2, 1}, {1, 2}, {0, 2}, {-1, 2}, {-2, 1}, {-3, 0}, {-2, -1}, {-1, -2}, {0, -2}, {1, -2}, {2, -1}}, 1,
      2.5);
}

Solid icosahedron(const Vec3d& centre) {
  Solid solid;
  solid.points = rectangles(1, kGolden);
  solid.faces = regular_faces(solid.points, cube_and(1, rectangles(kGolden, 1 / kGolden)));
  const double root = std::sqrt(5.0);
  solid.measures = {10.0 / 3.0 * (3 + root), 20 * std::numbers::sqrt3, 30 * std::acos(root / 3)};
  return moved(solid, centre);
}

Solid dodecahedron(const Vec3d& centre) {
  Solid solid;
  solid.points = cube_and(kGolden, rectangles(kGolden * kGolden, 1));
  solid.faces = regular_faces(solid.points, rectangles(1, kGolden));
  const double root = std::sqrt(5.0);
  solid.measures = {2 * (15 + 7 * root), 12 * std::sqrt(25 + 10 * root), 30 * std::acos(1 / root)};
  return moved(solid, centre);
}

Solid cut_box(std::uint32_t n) {
  const Solid whole = box();
  Solid solid;
  solid.measures = whole.measures;
  solid.extreme = whole.points;
  std::map<std::array<double, 3>, std::uint32_t> places;
  for (const Face& face : whole.faces) {
    const Vec3d origin = whole.points[face[0]];
    const Vec3d u = 1.0 / n * (whole.points[face[1]] - origin);
    const Vec3d v = 1.0 / n * (whole.points[face[3]] - origin);
    const auto corner = [&](std::uint32_t i, std::uint32_t j) {
      const Vec3d p = origin + double{1} * i * u + double{1} * j * v;
      const auto [place, is_new] = places.emplace(std::array{p.x, p.y, p.z}, static_cast<std::uint32_t>(places.size()));
      if (is_new) solid.points.push_back(p);
      return place->second;
    };
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t j = 0; j < n; ++j) {
        solid.faces.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
      }
    }
  }
  return solid;
}

Solid triangulated(Solid solid) {
  std::vector<Face> triangles;
  for (const Face& face : solid.faces) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i) triangles.push_back({face[0], face[i], face[i + 1]});
  }
  solid.faces = std::move(triangles);
  return solid;
}

Solid with_own_corners(const Solid& solid) {
  Solid result = solid;
  result.points.clear();
  result.extreme = solid.vertices();
  for (Face& face : result.faces) {
    for (std::uint32_t& corner : face) {
      result.points.push_back(solid.points[corner]);
      corner = static_cast<std::uint32_t>(result.points.size() - 1);
    }
  }
  return result;
}

Solid inside_out(Solid solid) {
  for (Face& face : solid.faces) std::ranges::reverse(face);
  return solid;
}

Solid with_point(Solid solid, const Vec3d& unused) {
  solid.extreme = solid.vertices();
  solid.points.push_back(unused);
  return solid;
}

Solid with_hole(Solid solid) {
  solid.faces.pop_back();
  return solid;
}

Solid with_flipped_face(Solid solid) {
  std::ranges::reverse(solid.faces.back());
  return solid;
}

Solid two_boxes() {
  Solid solid = box();
  join(moved(box(), {4, 0, 0}), &solid);
  return solid;
}

Solid torus() {  // a square frame: rings of four corners, in four places around z
  Solid solid;
  for (const auto& [x, y] : {std::array{1.0, 1.0}, {-1.0, 1.0}, {-1.0, -1.0}, {1.0, -1.0}}) {
    solid.points.insert(solid.points.end(), {{2 * x, 2 * y, 0}, {2 * x, 2 * y, 1}, {x, y, 1}, {x, y, 0}});
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t next = (i + 1) % 4 * 4;
      solid.faces.push_back({4 * i + k, next + k, next + (k + 1) % 4, 4 * i + (k + 1) % 4});
    }
  }
  return solid;
}

Solid dented_box(double depth) {
  Solid solid = box();
  const auto middle = static_cast<std::uint32_t>(solid.points.size());
  solid.extreme = solid.points;
  solid.points.push_back({1, 0, 5 - depth});
  const Face top = solid.faces.back();  // z = 5
  solid.faces.pop_back();
  for (std::size_t i = 0; i < 4; ++i) solid.faces.push_back({top[i], top[(i + 1) % 4], middle});
  return solid;
}

Solid flat_box() { return box_between({0.5, -1, 2}, {1.5, 1, 2}); }

Vec3d far_point() { return {1, 0, 8}; }

Solid box_with_roof() {
  Solid solid = dented_box(-3);
  solid.extreme.clear();
  // The pyramid's base is 1 x 2. Its faces over the edges of 2 are hypot(3, 1/2) high, those over the edges of 1
  // hypot(3, 1), and lean from the upright by angles of the tangents 1/6 and 1/3.
  const double over_long = std::hypot(3.0, 0.5);
  const double over_short = std::hypot(3.0, 1.0);
  solid.measures.volume = 6.0 + 2.0;
  solid.measures.surface_area = 22.0 - 2.0 + 2.0 * over_long + over_short;
  // Neighbouring faces of the roof: the cosine of the angle between their normals (3, 0, 1/2) and (0, 3, 1).
  const double ridge = std::acos(0.5 / (over_long * over_short));
  const double ridge_length = std::sqrt(9.0 + 0.25 + 1.0);
  solid.measures.integrated_mean_curvature = 0.5 * (kPi / 2 * (6.0 + 4 * 3.0) + 4.0 * std::atan(1.0 / 6.0) +
                                                    2.0 * std::atan(1.0 / 3.0) + 4 * ridge_length * ridge);
  return solid;
}

}  // namespace vex::tests
