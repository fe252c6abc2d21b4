#include "apps/referees/general_referee.h"

#include <cmath>

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
  const bool has_hint = hint.x != 0.0 || hint.y != 0.0 || hint.z != 0.0;
  if (has_hint && difference.support_value(hint) < 0.0 && difference.lies_behind({hint.x, hint.y, hint.z})) {
    return Outcome::disjoint;
  }
  // Where a search ends in a tie that rounding cannot break, another start comes from another side.
  const Vec3d starts[] = {has_hint ? hint : Vec3d{0.3, -0.5, 0.7}, {-0.71, 0.37, 0.53}, {0.17, 0.83, -0.41}};
  for (const Vec3d& start : starts) {
    const exact::SearchResult found = exact::search_origin(difference, {start.x, start.y, start.z});
    if (found.separating_dir) {
      if (difference.lies_behind(*found.separating_dir)) return Outcome::disjoint;
    } else if (is_around_origin(difference, found.around)) {
      return Outcome::overlap;
    }
    if (difference.is_rounded_polytope()) {
      if (const std::optional<Outcome> outcome = by_rational_numbers(difference, a_from_b)) return *outcome;
    }
  }
  return has_exact_outcome_ ? exact_outcome(body_a_, body_b_, a_from_b) : Outcome::undecided;
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
  if (!a_ || !b_) return INFINITY;
  const DifferenceBody difference(*a_, *b_, a_from_b);
  return std::fabs(difference.support_value(hint));
}

}  // namespace vex
