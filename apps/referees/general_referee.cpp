#include "apps/referees/general_referee.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "apps/referees/difference_body.h"
#include "apps/referees/exact_overlap.h"
#include "apps/referees/exact_referee.h"
#include "apps/referees/origin_search.h"

namespace vex {
namespace {

using exact::DifferenceBody;
using exact::DifferencePoint;
using exact::DyadicPoint;
using exact::Vec3dd;

// The differences of the vertices of two bodies are all looked at, so they must not be too many.
constexpr std::size_t kMaxDifferences = 5000;
// Beyond, the descent in rational numbers takes seconds.
constexpr std::size_t kMaxVertices = 3000;

bool is_direction(const Vec3d& d) { return d.x != 0.0 || d.y != 0.0 || d.z != 0.0; }

// Whether the closed tetrahedron, which must have volume, holds the origin.
bool holds_origin(const std::array<DyadicPoint, 4>& w) {
  const int whole = determinant(w[1] - w[0], w[2] - w[0], w[3] - w[0]).sign();
  if (whole == 0) return false;
  return whole * determinant(w[1], w[2], w[3]).sign() >= 0 && whole * determinant(w[0], w[3], w[2]).sign() >= 0 &&
         whole * determinant(w[0], w[1], w[3]).sign() >= 0 && whole * determinant(w[0], w[2], w[1]).sign() >= 0;
}

bool is_around_origin(const DifferenceBody& difference, const std::vector<DifferencePoint>& around) {
  const auto chosen =
      around.size() == 4 ? std::optional(std::array<std::size_t, 4>{0, 1, 2, 3}) : exact::deepest_tetrahedron(around);
  if (!chosen) return false;
  std::array<DyadicPoint, 4> w;
  for (std::size_t k = 0; k < 4; ++k) w[k] = difference.exactly(around[(*chosen)[k]]);
  return holds_origin(w);
}

exact::Point rational(const DyadicPoint& p) { return {p[0].rational(), p[1].rational(), p[2].rational()}; }

// Whether the hull of the points, which need not have volume, holds the origin. Slow.
bool hull_holds_origin(const DifferenceBody& difference, const std::vector<DifferencePoint>& points) {
  std::vector<exact::Point> exact_points;
  for (const DifferencePoint& p : points) exact_points.push_back(rational(difference.exactly(p)));
  return exact::distance_sq_from_origin(exact_points) == 0;
}

// What touching or flat bodies may have at the origin: a face, an edge, a rim across `normal`. Of bodies that tie along
// the normal, tilting it a little chooses a corner; where a body does not tie, the point along the normal itself is
// taken as well, since a tilt moves it off the plane of contact.
std::vector<DifferencePoint> points_across(const DifferenceBody& difference, const Vec3d& normal) {
  const double length = norm_1(normal);
  const Vec3d other = std::fabs(normal.x) < 0.4 * length ? Vec3d{1.0, 0.0, 0.0} : Vec3d{0.0, 1.0, 0.0};
  const Vec3d first = cross(other, normal), second = cross(normal, first);
  const double s = length / norm_1(first), q = length / norm_1(second);
  const DifferencePoint straight = difference.support({normal.x, normal.y, normal.z});
  std::vector<DifferencePoint> points = {straight};
  for (const double tilt : {0x1p-60, 0x1p-20}) {
    for (const auto& [i, j] : {std::pair{s, q}, {-s, q}, {s, -q}, {-s, -q}, {s, 0.0}, {-s, 0.0}}) {
      const Vec3d d = tilt * (i * first + j * second);
      const DifferencePoint tilted = difference.support(Vec3dd{normal.x, normal.y, normal.z} + Vec3dd{d.x, d.y, d.z});
      DifferencePoint corner = straight;
      if (tilted.a.is_vertex) corner.a = tilted.a;
      if (tilted.b.is_vertex) corner.b = tilted.b;
      points.push_back(tilted);
      points.push_back(corner);
    }
  }
  return points;
}

}  // namespace

GeneralReferee::GeneralReferee(const ConvexBody& a, const ConvexBody& b)
    : body_a_(a),
      body_b_(b),
      a_(a.exact_form()),
      b_(b.exact_form()),
      has_exact_outcome_(vex::has_exact_outcome(a, b)) {}

bool GeneralReferee::is_rational() const { return a_ && b_ && a_->is_rounded_polytope() && b_->is_rounded_polytope(); }

Outcome GeneralReferee::judge(const Transformd& a_from_b, const Vec3d& hint) const {
  if (!a_ || !b_) return has_exact_outcome_ ? exact_outcome(body_a_, body_b_, a_from_b) : Outcome::undecided;
  const DifferenceBody difference(*a_, *b_, a_from_b);
  const bool has_hint = is_direction(hint);
  if (has_hint && difference.support_value(hint) < 0.0 && difference.lies_behind({hint.x, hint.y, hint.z})) {
    return Outcome::disjoint;
  }
  // Where a search ends in a tie that rounding cannot break, another start comes from another side.
  const Vec3d starts[] = {has_hint ? hint : Vec3d{0.3, -0.5, 0.7}, {-0.71, 0.37, 0.53}, {0.17, 0.83, -0.41}};
  std::vector<DifferencePoint> around_last;
  for (const Vec3d& start : starts) {
    exact::SearchResult found = exact::search_origin(difference, {start.x, start.y, start.z});
    if (found.separating_dir) {
      if (difference.lies_behind(*found.separating_dir)) return Outcome::disjoint;
    } else if (is_around_origin(difference, found.around)) {
      return Outcome::overlap;
    } else {
      around_last = std::move(found.around);
    }
    if (difference.is_rounded_polytope()) {
      if (const std::optional<Outcome> outcome = by_rational_numbers(difference, a_from_b)) return *outcome;
    }
  }
  if (has_exact_outcome_) return exact_outcome(body_a_, body_b_, a_from_b);
  if (around_last.empty()) return Outcome::undecided;
  if (has_hint) {
    const std::vector<DifferencePoint> more = points_across(difference, hint);
    around_last.insert(around_last.end(), more.begin(), more.end());
  }
  return hull_holds_origin(difference, around_last) ? Outcome::overlap : Outcome::undecided;
}

std::optional<Outcome> GeneralReferee::by_rational_numbers(const DifferenceBody& difference,
                                                           const Transformd& pose) const {
  if (difference.is_polytope()) {
    if (a_->points.size() + b_->points.size() > kMaxVertices) return std::nullopt;
    return exact::overlap(a_->points, exact::placed(b_->points, pose)) ? Outcome::overlap : Outcome::disjoint;
  }
  if (a_->points.size() * b_->points.size() > kMaxDifferences) return std::nullopt;
  std::vector<exact::Point> differences;
  const std::vector<DyadicPoint> placed = difference.placed_points();
  for (const Vec3d& p : a_->points) {
    for (const DyadicPoint& q : placed) differences.push_back(rational(exact::dyadic(p) - q));
  }
  const exact::Rational reach = difference.ball_radius().rational();
  return exact::distance_sq_from_origin(differences) <= reach * reach ? Outcome::overlap : Outcome::disjoint;
}

double GeneralReferee::gap_bound(const Transformd& a_from_b, const Vec3d& hint) const {
  if (!a_ || !b_) return std::numeric_limits<double>::infinity();
  const DifferenceBody difference(*a_, *b_, a_from_b);
  std::vector<Vec3d> dirs = {a_from_b.translation};
  if (is_direction(hint)) dirs.push_back(hint);
  for (const Vec3d& axis : {Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, 0.0, 1.0}}) {
    for (const Vec3d& dir : {axis, a_from_b(axis) - a_from_b.translation}) {
      dirs.push_back(dir);
      dirs.push_back(-dir);
    }
  }
  const exact::SearchResult found = exact::search_origin(difference, {0.3, -0.5, 0.7});
  if (found.separating_dir) {
    const Vec3dd& d = *found.separating_dir;
    dirs.push_back({d.x.value(), d.y.value(), d.z.value()});
  }
  // The distance is the largest gap along any direction, the depth the least overlap along one.
  double distance = 0.0, depth = std::numeric_limits<double>::infinity();
  Vec3d shallowest;
  const auto consider = [&](const Vec3d& dir) {
    if (!is_direction(dir)) return false;
    const double value = difference.support_value(dir);
    distance = std::max(distance, -value);
    if (!(value < depth)) return false;
    depth = value;
    shallowest = (1.0 / norm(dir)) * dir;
    return true;
  };
  for (const Vec3d& dir : dirs) consider(dir);
  // Downhill from there, with steps that shrink: any direction gives a bound, a better one a better bound.
  for (double step = 0.25; step > 0x1p-50; step *= 0.5) {
    for (const double side : {-step, step}) {
      for (const Vec3d& axis : {Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, 0.0, 1.0}}) {
        for (int n = 0; n < 8 && consider(shallowest + side * axis); ++n) continue;
      }
    }
  }
  return distance > 0.0 ? distance : depth;
}

}  // namespace vex
