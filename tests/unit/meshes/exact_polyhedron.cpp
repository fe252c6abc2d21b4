#include "exact_polyhedron.h"

#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace vex::tests {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Real = boost::multiprecision::cpp_bin_float_50;

template <class T>
using Point = std::array<T, 3>;

template <class T>
Point<T> point(const Vec3d& p) {
  return {T(p.x), T(p.y), T(p.z)};
}
template <class T>
Point<T> minus(const Point<T>& a, const Point<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class T>
T dot_of(const Point<T>& a, const Point<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The part of `v` that is perpendicular to `edge`.
Point<Real> perpendicular(const Point<Real>& v, const Point<Real>& edge) {
  const Real along = dot_of(v, edge) / dot_of(edge, edge);
  return {v[0] - along * edge[0], v[1] - along * edge[1], v[2] - along * edge[2]};
}

}  // namespace

Measures exact_measures(const PolygonSoup& triangles) {
  Triangles result;
  result.vertices = triangles.points;
  for (std::size_t i = 0; i < triangles.corners.size(); i += 3) {
    result.corners.push_back({triangles.corners[i], triangles.corners[i + 1], triangles.corners[i + 2]});
  }
  return exact_measures(result);
}

Measures exact_measures(const Triangles& triangles) {
  using Key = std::array<double, 3>;
  Rational six_volumes = 0;
  Real area = 0;
  std::map<std::pair<Key, Key>, Point<Real>> third_corner;  // of the triangle left of each directed edge
  const auto key = [](const Vec3d& p) { return Key{p.x, p.y, p.z}; };
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::array<Vec3d, 3> p{triangles.corner(t, 0), triangles.corner(t, 1), triangles.corner(t, 2)};
    const auto a = point<Rational>(p[0]);
    const auto b = point<Rational>(p[1]);
    const auto c = point<Rational>(p[2]);
    six_volumes +=
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    const auto u = minus(point<Real>(p[1]), point<Real>(p[0]));
    const auto v = minus(point<Real>(p[2]), point<Real>(p[0]));
    area += sqrt(dot_of(u, u) * dot_of(v, v) - dot_of(u, v) * dot_of(u, v)) / 2;
    for (std::size_t k = 0; k < 3; ++k) {
      third_corner[{key(p[k]), key(p[(k + 1) % 3])}] = point<Real>(p[(k + 2) % 3]);
    }
  }
  Real curvature = 0;
  for (const auto& [edge, left] : third_corner) {
    const auto [tail, head] = edge;
    const auto back = third_corner.find({head, tail});
    if (back == third_corner.end()) {
      throw std::logic_error("the referee was given a surface that is not closed");
    }
    if (tail < head) {
      const Point<Real> a{Real(tail[0]), Real(tail[1]), Real(tail[2])};
      const Point<Real> direction = minus(Point<Real>{Real(head[0]), Real(head[1]), Real(head[2])}, a);
      const Point<Real> u = perpendicular(minus(left, a), direction);
      const Point<Real> v = perpendicular(minus(back->second, a), direction);
      Real cosine = dot_of(u, v) / sqrt(dot_of(u, u) * dot_of(v, v));
      cosine = cosine < -1 ? Real(-1) : cosine > 1 ? Real(1) : cosine;
      const Real dihedral = acos(cosine);
      curvature += sqrt(dot_of(direction, direction)) * (boost::math::constants::pi<Real>() - dihedral) / 2;
    }
  }
  return {static_cast<double>(Real(six_volumes) / 6), static_cast<double>(area), static_cast<double>(curvature)};
}

}  // namespace vex::tests
