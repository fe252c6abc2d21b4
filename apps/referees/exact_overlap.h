// Do two polytopes share a point? Decided in exact rational arithmetic, by another algorithm than the engine's.
//
// The distance from the origin to the convex hull of the differences p_i - q_j, by Gilbert's and Wolfe's descent over
// simplices: keep the simplex that carries the nearest point, add the vertex deepest in its direction, find the nearest
// point of the enlarged simplex by trying every face of it. In exact arithmetic the distance falls in every step and
// the simplices are finitely many, so it ends, with the truth.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <vector>

#include "engine/numeric/transform.h"

namespace vex::exact {

using Rational = boost::multiprecision::cpp_rational;
using Point = std::array<Rational, 3>;

inline Point exactly(const Vec3d& p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }
inline Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Rational inner(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The vertices as they are placed: ((r1*x + r2*y) + r3*z) + t, rounded. These coordinates are what a verdict is about.
inline std::vector<Vec3d> placed(const std::vector<Vec3d>& vertices, const Transformd& a_from_b) {
  std::vector<Vec3d> result;
  for (const Vec3d& v : vertices) result.push_back(a_from_b(v));
  return result;
}

/// Solves the square system in place by Gaussian elimination; false where it is singular.
inline bool solve(std::vector<std::vector<Rational>>& m, std::vector<Rational>& rhs) {
  const std::size_t n = rhs.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    while (pivot < n && m[pivot][c] == 0) ++pivot;
    if (pivot == n) return false;
    std::swap(m[pivot], m[c]);
    std::swap(rhs[pivot], rhs[c]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c || m[r][c] == 0) continue;
      const Rational factor = m[r][c] / m[c][c];
      for (std::size_t k = c; k < n; ++k) m[r][k] -= factor * m[c][k];
      rhs[r] -= factor * rhs[c];
    }
  }
  for (std::size_t c = 0; c < n; ++c) rhs[c] /= m[c][c];
  return true;
}

/// The point of conv(simplex) nearest to the origin; drops the vertices that do not carry it.
inline Point nearest_point(std::vector<Point>& simplex) {
  bool found = false;
  Point best;
  Rational best_sq;
  std::vector<Point> best_face;
  for (unsigned subset = 1; subset < (1u << simplex.size()); ++subset) {
    std::vector<Point> face;
    for (std::size_t k = 0; k < simplex.size(); ++k) {
      if ((subset >> k) & 1u) face.push_back(simplex[k]);
    }
    // The affine combination of least norm: sum_j l_j (f_j - f_0) . (f_i - f_0) = -f_0 . (f_i - f_0), l_0 = 1 - sum.
    const std::size_t n = face.size() - 1;
    std::vector<std::vector<Rational>> gram(n, std::vector<Rational>(n));
    std::vector<Rational> l(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Point e_i = minus(face[i + 1], face[0]);
      for (std::size_t j = 0; j < n; ++j) gram[i][j] = inner(e_i, minus(face[j + 1], face[0]));
      l[i] = -inner(face[0], e_i);
    }
    if (!solve(gram, l)) continue;
    Rational l_0 = 1;
    bool inside = true;
    Point p = face[0];
    for (std::size_t i = 0; i < n; ++i) {
      l_0 -= l[i];
      inside = inside && l[i] >= 0;
      const Point e_i = minus(face[i + 1], face[0]);
      for (std::size_t k = 0; k < 3; ++k) p[k] += l[i] * e_i[k];
    }
    if (!inside || l_0 < 0) continue;
    const Rational sq = inner(p, p);
    if (!found || sq < best_sq) {
      found = true;
      best = p;
      best_sq = sq;
      best_face = face;
    }
  }
  simplex = best_face;
  return best;
}

/// The same direction with whole coordinates: sums of products of whole numbers need no common denominators, which is
/// most of the time otherwise.
inline Point whole_direction(const Point& v) {
  const auto common = lcm(lcm(denominator(v[0]), denominator(v[1])), denominator(v[2]));
  return {v[0] * common, v[1] * common, v[2] * common};
}

/// Both point sets times a power of two that makes every coordinate whole.
inline void make_whole(std::vector<Point>& a, std::vector<Point>& b) {
  boost::multiprecision::cpp_int largest = 1;  // denominators are powers of two
  for (const std::vector<Point>* points : {&a, &b}) {
    for (const Point& p : *points) {
      for (const Rational& x : p) largest = std::max(largest, boost::multiprecision::cpp_int(denominator(x)));
    }
  }
  for (std::vector<Point>* points : {&a, &b}) {
    for (Point& p : *points) {
      for (Rational& x : p) x *= largest;
    }
  }
}

/// Whether the convex hulls of the two point sets share a point.
inline bool overlap(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  std::vector<Point> exact_a, exact_b;
  for (const Vec3d& p : a) exact_a.push_back(exactly(p));
  for (const Vec3d& p : b) exact_b.push_back(exactly(p));
  make_whole(exact_a, exact_b);
  std::vector<Point> simplex = {minus(exact_a[0], exact_b[0])};
  while (true) {
    const Point v = whole_direction(nearest_point(simplex));
    if (v[0] == 0 && v[1] == 0 && v[2] == 0) return true;
    // The support point of the difference against v.
    const Point* p = &exact_a[0];
    const Point* q = &exact_b[0];
    for (const Point& candidate : exact_a) {
      if (inner(candidate, v) < inner(*p, v)) p = &candidate;
    }
    for (const Point& candidate : exact_b) {
      if (inner(candidate, v) > inner(*q, v)) q = &candidate;
    }
    const Point w = minus(*p, *q);
    if (inner(w, v) > 0) return false;  // v separates
    simplex.push_back(w);               // inner(w, v) <= 0: the distance falls
  }
}

/// The point of the convex hull nearest to the origin, by the same descent, to its end.
inline Point nearest_to_origin(const std::vector<Point>& points) {
  std::vector<Point> simplex = {points[0]};
  while (true) {
    const Point v = nearest_point(simplex);
    const Rational v_sq = inner(v, v);
    if (v_sq == 0) return v;
    const Point* w = &points[0];
    for (const Point& candidate : points) {
      if (inner(candidate, v) < inner(*w, v)) w = &candidate;
    }
    if (inner(*w, v) >= v_sq) return v;  // no point of the hull is nearer along v
    simplex.push_back(*w);
  }
}

/// The squared distance of the convex hull from the origin.
inline Rational distance_sq_from_origin(const std::vector<Point>& points) {
  const Point nearest = nearest_to_origin(points);
  return inner(nearest, nearest);
}

/// Whether every point of `a` lies strictly behind every point of `b` along `dir`: what a disjoint verdict claims.
inline bool separates(const Vec3d& dir, const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  const Point d = exactly(dir);
  Rational most_a = inner(exactly(a[0]), d), least_b = inner(exactly(b[0]), d);
  for (const Vec3d& p : a) most_a = std::max(most_a, Rational(inner(exactly(p), d)));
  for (const Vec3d& p : b) least_b = std::min(least_b, Rational(inner(exactly(p), d)));
  return most_a < least_b;
}

}  // namespace vex::exact
