#include "shapes/archimedean.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/numeric/rounding.h"
#include "engine/support/checked_input.h"

namespace vex {
namespace {

constexpr double kPhi = std::numbers::phi;
constexpr double kSilver = 1.0 + std::numbers::sqrt2;

/// Different points, which of these solids are never near each other.
void add_new(std::vector<Vec3d>& points, const Vec3d& p) {
  const auto is_same = [&](const Vec3d& q) { return norm(p - q) < 1e-6 * norm(p); };
  if (std::ranges::none_of(points, is_same)) points.push_back(p);
}

Vec3d turned_about_111(const Vec3d& p) { return {p.y, p.z, p.x}; }

/// All changes of sign and the cyclic permutations of the coordinates; the others where `all_orders`. Those alone whose
/// number of minus signs is even, and odd after an odd permutation, where `is_snub`; even after both where
/// `even_signs`.
struct Orbit {
  bool all_orders = false, is_snub = false, even_signs = false;

  void add(std::vector<Vec3d>& points, Vec3d p) const {
    for (const bool is_odd : {false, true}) {
      if (is_odd && !all_orders) return;
      Vec3d q = is_odd ? Vec3d{p.y, p.x, p.z} : p;
      for (int turn = 0; turn < 3; ++turn, q = turned_about_111(q)) {
        for (int signs = 0; signs < 8; ++signs) {
          const Vec3d r{(signs & 1) ? -q.x : q.x, (signs & 2) ? -q.y : q.y, (signs & 4) ? -q.z : q.z};
          const bool is_even = ((signs & 1) + (signs >> 1 & 1) + (signs >> 2 & 1)) % 2 == 0;
          if ((is_snub && is_even == is_odd) || (even_signs && !is_even)) continue;
          add_new(points, r);
        }
      }
    }
  }
};

std::vector<Vec3d> orbit(const Orbit& group, std::initializer_list<Vec3d> starts) {
  std::vector<Vec3d> points;
  for (const Vec3d& p : starts) group.add(points, p);
  return points;
}

/// Of (1, 1/t, t), t the tribonacci constant, t^3 = t^2 + t + 1.
std::vector<Vec3d> snub_cube() {
  const double r = std::sqrt(33.0);
  const double t = (1.0 + std::cbrt(19.0 + 3.0 * r) + std::cbrt(19.0 - 3.0 * r)) / 3.0;
  return orbit({.all_orders = true, .is_snub = true}, {{1.0, 1.0 / t, t}});
}

/// The rotations of an icosahedron take one vertex to all: those about (1, 1, 1), and those by a fifth of a turn.
/// H. S. M. Coxeter's solid with x^3 + 2 x^2 = phi^2.
std::vector<Vec3d> snub_dodecahedron() {
  constexpr double p = kPhi, p2 = p * p;
  double x = 0.94315125924388;
  for (int step = 0; step < 3; ++step) x -= (x * x * (x + 2.0) - p2) / (x * (3.0 * x + 4.0));
  const auto fifth = [](const Vec3d& v) {
    return Vec3d{0.5 * (v.x / p - p * v.y + v.z), 0.5 * (p * v.x + v.y + v.z / p), 0.5 * (-v.x + v.y / p + p * v.z)};
  };
  std::vector<Vec3d> points = {{p2 - p2 * x, -p * p2 + p * x + 2.0 * p * x * x, x}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3d from = points[i];
    add_new(points, fifth(from));
    add_new(points, turned_about_111(from));
  }
  return points;
}

std::vector<Vec3d> corners_of(ArchimedeanKind kind) {
  constexpr Orbit all{.all_orders = true}, cyclic{};
  constexpr double p = kPhi, p2 = p * p, s = kSilver;
  switch (kind) {
    case ArchimedeanKind::truncated_tetrahedron: return orbit({.all_orders = true, .even_signs = true}, {{1, 1, 3}});
    case ArchimedeanKind::cuboctahedron: return orbit(all, {{1, 1, 0}});
    case ArchimedeanKind::truncated_cube: return orbit(all, {{s, s, 1}});
    case ArchimedeanKind::truncated_octahedron: return orbit(all, {{0, 1, 2}});
    case ArchimedeanKind::rhombicuboctahedron: return orbit(all, {{1, 1, s}});
    case ArchimedeanKind::truncated_cuboctahedron: return orbit(all, {{1, s, s + std::numbers::sqrt2}});
    case ArchimedeanKind::snub_cube: return snub_cube();
    case ArchimedeanKind::icosidodecahedron: return orbit(cyclic, {{0, 0, 2 * p}, {1, p, p2}});
    case ArchimedeanKind::truncated_dodecahedron:
      return orbit(cyclic, {{0, 1 / p, 2 + p}, {1 / p, p, 2 * p}, {p, 2, p + 1}});
    case ArchimedeanKind::truncated_icosahedron:
      return orbit(cyclic, {{0, 1, 3 * p}, {1, 2 + p, 2 * p}, {p, 2, 2 * p + 1}});
    case ArchimedeanKind::rhombicosidodecahedron:
      return orbit(cyclic, {{1, 1, p * p2}, {p2, p, 2 * p}, {2 + p, 0, p2}});
    case ArchimedeanKind::truncated_icosidodecahedron:
      return orbit(
          cyclic,
          {{1 / p, 1 / p, 3 + p}, {2 / p, p, 1 + 2 * p}, {1 / p, p2, 3 * p - 1}, {2 * p - 1, 2, 2 + p}, {p, 3, 2 * p}});
    case ArchimedeanKind::snub_dodecahedron: return snub_dodecahedron();
  }
  return {};
}

double least_distance(const std::vector<Vec3d>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < points.size(); ++i) least = std::min(least, norm(points[i] - points[0]));
  return least;
}

std::vector<Vec3d> with_edge(std::vector<Vec3d> points, double edge) {
  const double factor = checked_size(edge, "the edge of an Archimedean solid") / least_distance(points);
  for (Vec3d& p : points) p = factor * p;
  return points;
}

/// To the nearest face. What rounding changes of these well-shaped faces is some 1e-15 of it.
double inner_radius(const std::vector<Vec3d>& points, const std::vector<FacedPolytope::Face>& faces) {
  double least = std::numeric_limits<double>::infinity();
  for (const FacedPolytope::Face& face : faces) {
    const Vec3d a = points[face[0]], b = points[face[1]], c = points[face[2]];
    const Vec3d dir = (1.0 / norm_1(b - a)) * cross((1.0 / norm_1(c - b)) * (b - a), c - b);
    least = std::min(least, dot(a, dir) / norm(dir));
  }
  return least * (1.0 - 0x1p-40);
}

}  // namespace

ArchimedeanSolid::ArchimedeanSolid(ArchimedeanKind kind, double edge)
    : ArchimedeanSolid(with_edge(corners_of(kind), edge), faces_of_equal_edges(corners_of(kind))) {}

ArchimedeanSolid::ArchimedeanSolid(const std::vector<Vec3d>& corners, const std::vector<Face>& faces)
    : FacedPolytope(corners, faces, {}, inner_radius(corners, faces)) {}

}  // namespace vex
