// The point of a body K = A - B that is nearest to the origin, or a separating direction: the descent of E. Gilbert,
// D. Johnson and S. Keerthi (1988), simplex by simplex.
//
// A flat K has no tetrahedron, and a portal of it no inside; a descent asks for neither. It comes where the portal has
// stalled. One lane only.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "engine/query/query_error.h"

namespace vex {

/// The point of the hull of one to four points that is nearest to the origin.
template <class L>
struct NearestPoint {
  Vec3<L> at;                     // a convex combination of the points, to the rounding of its sums
  Vec3<L> normal;                 // across the carriers, towards `at`: its direction, but for what cancels in `at`
  std::vector<Vec3<L>> carriers;  // the points it is a combination of; of four the origin is inside, and `at` is zero
};

namespace detail {

template <class L>
class NearestOf {
 public:
  explicit NearestOf(std::span<const Vec3<L>> points) : points_(points) {
    const std::size_t n = points.size();
    if (n == 4 && offer_inside()) return;
    for (std::size_t i = 0; i < n; ++i) {
      offer(points[i], points[i], {points[i]});
      for (std::size_t j = i + 1; j < n; ++j) {
        offer_edge(points[i], points[j]);
        for (std::size_t k = j + 1; k < n; ++k) offer_triangle(points[i], points[j], points[k]);
      }
    }
  }

  const NearestPoint<L>& nearest() const { return nearest_; }

 private:
  void offer(const Vec3<L>& at, const Vec3<L>& normal, std::vector<Vec3<L>> carriers) {
    const L square = dot(at, at);
    if (!nearest_.carriers.empty() && !(square < square_)) return;
    square_ = square;
    nearest_ = {at, normal, std::move(carriers)};
  }

  // p + s (q - p), 0 < s < 1, with both weights from products that do not cancel together.
  void offer_edge(const Vec3<L>& p, const Vec3<L>& q) {
    const Vec3<L> e = q - p;
    const L of_q = -dot(p, e), of_p = dot(q, e);
    if (!(of_p > L(0.0) && of_q > L(0.0))) return;
    const L sum = of_p + of_q;
    const Vec3<L> at = (of_p / sum) * p + (of_q / sum) * q;
    offer(at, at, {p, q});
  }

  void offer_triangle(const Vec3<L>& p, const Vec3<L>& q, const Vec3<L>& r) {
    const Vec3<L> normal = cross(q - p, r - p);
    const L of_p = dot(cross(q, r), normal), of_q = dot(cross(r, p), normal), of_r = dot(cross(p, q), normal);
    if (!(of_p > L(0.0) && of_q > L(0.0) && of_r > L(0.0))) return;
    const L sum = of_p + of_q + of_r;
    const Vec3<L> at = (of_p / sum) * p + (of_q / sum) * q + (of_r / sum) * r;
    offer(at, dot(normal, p) < L(0.0) ? -normal : normal, {p, q, r});
  }

  bool offer_inside() {
    const Vec3<L>&a = points_[0], &b = points_[1], &c = points_[2], &d = points_[3];
    const L parts[] = {dot(b, cross(c, d)), dot(a, cross(d, c)), dot(a, cross(b, d)), dot(a, cross(c, b))};
    const bool all_positive = std::ranges::all_of(parts, [](const L& x) { return x > L(0.0); });
    const bool all_negative = std::ranges::all_of(parts, [](const L& x) { return x < L(0.0); });
    if (!all_positive && !all_negative) return false;
    nearest_ = {{}, {}, {a, b, c, d}};
    return true;
  }

  std::span<const Vec3<L>> points_;
  NearestPoint<L> nearest_;
  L square_;
};

}  // namespace detail

template <class L>
NearestPoint<L> nearest_point(std::span<const Vec3<L>> points) {
  return detail::NearestOf<L>(points).nearest();
}

template <class L>
struct Descent {
  enum class End {
    disjoint,  // `separating_dir` separates the bodies
    ended,     // nothing is nearer, to rounding; or a tetrahedron of points of K seems to hold the origin
    capped,
  };
  End end = End::ended;
  Vec3<L> separating_dir;
  Vec3<L> nearest;  // a point of K to its error: its length bounds the gap from above
  int n_support_calls = 0;
};

template <class L, class Difference>
Descent<L> descend(const Difference& difference, const Vec3<L>& first_dir, const QueryError<L>& error,
                   int max_support_calls) {
  Descent<L> result;
  std::vector<Vec3<L>> simplex = {difference.support(first_dir)};
  result.n_support_calls = 1;
  L last_square(0.0);
  for (bool is_first = true;; is_first = false) {
    NearestPoint<L> found = nearest_point<L>(simplex);
    const L square = dot(found.at, found.at);
    if (!is_first && !(square < last_square)) return result;
    last_square = square;
    result.nearest = found.at;
    if (found.carriers.size() == 4 || !(norm_1(found.normal) > L(0.0))) return result;
    if (result.n_support_calls >= max_support_calls) {
      result.end = Descent<L>::End::capped;
      return result;
    }
    const Vec3<L> dir = -scaled_to_unit_exponent(found.normal);
    const Vec3<L> w = difference.support(dir);
    ++result.n_support_calls;
    const L value = dot(dir, w), slack = error.support * norm_1(dir);
    if (value < -slack) {
      result.end = Descent<L>::End::disjoint;
      result.separating_dir = dir;
      return result;
    }
    if (!(value - dot(dir, found.at) > slack)) return result;
    simplex = std::move(found.carriers);
    simplex.push_back(w);
  }
}

}  // namespace vex
