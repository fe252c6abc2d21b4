// The simplex of a descent to the point of a body K = A - B that is nearest to the origin, and its step: the nearest
// point of one to four points, with the weights that make it of them.
//
// Of all faces of the simplex that have the newest point the nearest inner point wins, by its computed length: whatever
// is lost to rounding, a point that is chosen is a convex combination of points of K, and no step makes it longer.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "engine/numeric/vec3.h"
#include "engine/query/search/weighted_points.h"

namespace vex {

/// `Point::w` is a point of K; what else is in a `Point` goes with it. One lane only.
template <class L, class Point>
class NearestSimplex {
 public:
  int size() const { return static_cast<int>(points_.size()); }
  const Point& point(int k) const { return points_.point(static_cast<std::size_t>(k)); }
  const L& weight(int k) const { return points_.weight(static_cast<std::size_t>(k)); }
  /// The corners, with the weights that make the nearest point of them.
  const WeightedPoints<L, Point>& points() const { return points_; }
  /// The nearest point, to the rounding of its sums.
  const Vec3<L>& at() const { return at_; }
  const L& square() const { return square_; }
  /// Across the simplex, towards `at`: its direction, but for what cancels in `at`. Zero where the origin is inside.
  const Vec3<L>& normal() const { return normal_; }
  /// Four points, and the origin is inside of them, to rounding.
  bool is_around_origin() const { return size() == 4; }

  /// Takes a point in and keeps those that carry the nearest point. False, and nothing changes, where no face with it
  /// is nearer. Not for a simplex around the origin. `may_hold_origin`: false where K is proven to lie on one side of
  /// it.
  bool add(const Point& newest, bool may_hold_origin = true) {
    const std::size_t n = points_.size();
    Candidate best;
    if (n == 0) {
      best = vertex(newest.w);
      keep(best, newest);
      return true;
    }
    best.square = square_;
    best.is_any = false;
    const Vec3<L>& a = newest.w;
    if (n == 3 && may_hold_origin && offer_inside(best, a)) {
      keep(best, newest);
      return true;
    }
    if (!has_nearest_triangle(best, a, n)) {
      for (std::size_t i = 0; i < n; ++i) offer_edge(best, a, i);
      // Where an edge or a triangle has a nearest point inside, its corners are no nearer.
      if (!best.is_any) take(best, vertex(a));
    }
    if (!best.is_any) return false;
    keep(best, newest);
    return true;
  }

  /// Begins with two or three points whose edge or triangle is likely to have the nearest point inside: one step where
  /// it has, and where it has not the steps of `add` for each.
  void begin_with(std::span<const Point> points) {
    points_.clear();
    if (points.size() > 3) return add_all(points);
    for (std::size_t k = 0; k + 1 < points.size(); ++k) points_.add(L(0.0), points[k]);
    const Point& newest = points.back();
    Candidate best = vertex(newest.w);
    best.is_any = false;
    if (points.size() == 3) {
      const Vec3<L> e = points[1].w - points[0].w, f = points[2].w - points[0].w;
      if (spans_plane(e, f, cross(e, f))) offer_triangle(best, newest.w, 0, 1);
    }
    if (points.size() == 2) offer_edge(best, newest.w, 0);
    if (best.is_any) return keep(best, newest);
    points_.clear();
    add_all(points);
  }

 private:
  static constexpr std::size_t kNone = 4;

  // Of a sliver's normal rounding makes what it likes, and only its edges tell. Of a triangle's two edges.
  static bool spans_plane(const Vec3<L>& e, const Vec3<L>& f, const Vec3<L>& normal) {
    return dot(normal, normal) > L(0x1p-40) * (dot(e, e) * dot(f, f));
  }

  void add_all(std::span<const Point> points) {
    for (const Point& point : points) {
      if (!is_around_origin()) add(point);
    }
  }

  struct Candidate {
    L square{0.0};
    Vec3<L> at, normal;
    // Of the old points; the newest one's comes last.
    std::array<std::size_t, 3> old{kNone, kNone, kNone};
    std::array<L, 4> weight{L(0.0), L(0.0), L(0.0), L(0.0)};
    bool is_any = true;
  };

  static Candidate vertex(const Vec3<L>& a) {
    Candidate found;
    found.square = dot(a, a);
    found.at = found.normal = a;
    found.weight[3] = L(1.0);
    return found;
  }

  static void take(Candidate& best, const Candidate& other) {
    if (other.square < best.square) best = other;
  }

  // Offers the triangles of the newest point. True where one has the nearest point of all inside, of which no edge has
  // to be asked: of a triangle alone, or of a tetrahedron that is on the other side of its plane than the origin.
  bool has_nearest_triangle(Candidate& best, const Vec3<L>& a, std::size_t n) const {
    const auto is_offered = [&](std::size_t i, std::size_t j) {
      return offer_triangle(best, a, i, j) && spans_plane(points_.point(i).w - a, points_.point(j).w - a, best.normal);
    };
    if (n == 2) return is_offered(0, 1);
    for (std::size_t k = 0; n == 3 && k < 3; ++k) {
      const std::size_t i = k == 0 ? 1 : 0, j = k == 2 ? 1 : 2;
      if (is_offered(i, j) && dot(best.normal, points_.point(k).w - a) > L(0.0)) return true;
    }
    return false;
  }

  // Both weights are products that do not cancel together.
  void offer_edge(Candidate& best, const Vec3<L>& a, std::size_t i) const {
    const Vec3<L>& b = points_.point(i).w;
    const Vec3<L> e = b - a;
    const L of_b = -dot(a, e), of_a = dot(b, e);
    if (!(of_a > L(0.0) && of_b > L(0.0))) return;
    const L inverse = L(1.0) / (of_a + of_b);
    const L weight_a = of_a * inverse, weight_b = of_b * inverse;
    const Vec3<L> at = weight_a * a + weight_b * b;
    const L square = dot(at, at);
    if (!(square < best.square)) return;
    best.square = square;
    best.at = best.normal = at;
    best.old = {i, kNone, kNone};
    best.weight = {weight_b, L(0.0), L(0.0), weight_a};
    best.is_any = true;
  }

  // Whether its nearest point is inside, and nearer than the best one.
  bool offer_triangle(Candidate& best, const Vec3<L>& a, std::size_t i, std::size_t j) const {
    const Vec3<L>&b = points_.point(i).w, &c = points_.point(j).w;
    const Vec3<L> normal = cross(b - a, c - a);
    const L of_a = dot(cross(b, c), normal), of_b = dot(cross(c, a), normal), of_c = dot(cross(a, b), normal);
    if (!(of_a > L(0.0) && of_b > L(0.0) && of_c > L(0.0))) return false;
    const L inverse = L(1.0) / ((of_a + of_b) + of_c);
    const L weight_a = of_a * inverse, weight_b = of_b * inverse, weight_c = of_c * inverse;
    const Vec3<L> at = (weight_a * a + weight_b * b) + weight_c * c;
    const L square = dot(at, at);
    if (!(square < best.square)) return false;
    best.square = square;
    best.at = at;
    best.normal = dot(normal, a) < L(0.0) ? -normal : normal;
    best.old = {i, j, kNone};
    best.weight = {weight_b, weight_c, L(0.0), weight_a};
    return best.is_any = true;
  }

  bool offer_inside(Candidate& best, const Vec3<L>& d) const {
    const Vec3<L>&a = points_.point(0).w, &b = points_.point(1).w, &c = points_.point(2).w;
    const Vec3<L> cd = cross(c, d), ab = cross(a, b);
    const L of_a = dot(b, cd), of_b = -dot(a, cd), of_c = dot(d, ab), of_d = -dot(c, ab);
    const bool all_positive = of_a > L(0.0) && of_b > L(0.0) && of_c > L(0.0) && of_d > L(0.0);
    const bool all_negative = of_a < L(0.0) && of_b < L(0.0) && of_c < L(0.0) && of_d < L(0.0);
    if (!all_positive && !all_negative) return false;
    const L inverse = L(1.0) / ((of_a + of_b) + (of_c + of_d));
    best.old = {0, 1, 2};
    best.weight = {of_a * inverse, of_b * inverse, of_c * inverse, of_d * inverse};
    best.at = (best.weight[0] * a + best.weight[1] * b) + (best.weight[2] * c + best.weight[3] * d);
    best.square = dot(best.at, best.at);
    best.normal = {};
    return true;
  }

  void keep(const Candidate& found, const Point& newest) {
    std::size_t n = 0;
    // The old ones stand in order, so that none is overwritten before it is moved.
    for (; n < 3 && found.old[n] != kNone; ++n) points_.keep(n, found.old[n], found.weight[n]);
    points_.cut(n);
    points_.add(found.weight[3], newest);
    at_ = found.at;
    square_ = found.square;
    normal_ = found.normal;
  }

  WeightedPoints<L, Point> points_;
  Vec3<L> at_, normal_;
  L square_{0.0};
};

}  // namespace vex
