#include "engine/sampling/depletion/depletion_integrand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/numeric/elementary.h"
#include "engine/query/overlap.h"

namespace vex {
namespace {

struct ShellReach {
  double low, high;
};

/// How far a placed body with a ball about each point reaches along a unit axis of A's frame, widened by more than what
/// its support mapping is off by.
ShellReach reach_along(const ConvexBody& body, const Transformd& a_from_body, const Vec3d& axis, double ball_radius) {
  const Vec3d dir = a_from_body.direction_to_b(axis);
  const double at = dot(axis, a_from_body.translation);
  const double margin = body.support_error() + 0x1p-40 * (body.reach() + std::fabs(at)) + ball_radius * (1.0 + 0x1p-40);
  return {at + dot(dir, body.support(-dir)) - margin, at + dot(dir, body.support(dir)) + margin};
}

double counted_volume(double all, Outcome outcome, double* half_width) {
  if (outcome == Outcome::disjoint) return 0.0;
  if (outcome == Outcome::overlap) return all;
  *half_width = 0.5 * all;
  return 0.5 * all;
}

}  // namespace

OverlapBox box_around_overlap(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                              double ball_radius) {
  const auto both = [&](const Vec3d& axis) -> ShellReach {
    const ShellReach of_a = reach_along(a, Transformd{}, axis, ball_radius);
    const ShellReach of_b = reach_along(b, a_from_b, axis, ball_radius);
    return {std::max(of_a.low, of_b.low), std::min(of_a.high, of_b.high)};
  };
  const ShellReach x = both({1.0, 0.0, 0.0}), y = both({0.0, 1.0, 0.0}), z = both({0.0, 0.0, 1.0});
  return {{x.low, y.low, z.low}, {x.high - x.low, y.high - y.low, z.high - z.low}};
}

Outcome outcome_at(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b) {
  return overlap(a, b, Pose::unchecked(a_from_b)).outcome;
}

DepletionIntegrand::DepletionIntegrand(const ConvexBody& a, const ConvexBody& b, const ConvexBody& ball,
                                       const Transformd& pose)
    : a_(a), b_(b), ball_(ball), pose_(pose) {}

DepletionIntegrand::DepletionIntegrand(const ConvexBody& a, const ConvexBody& b, const ConvexBody& ball,
                                       double distance, const OrientationLaw& law, What what)
    : a_(a), b_(b), ball_(ball), what_(what), is_average_(true), distance_(distance), law_(law) {}

int DepletionIntegrand::dimension() const {
  return (what_ == What::freedom ? 0 : 3) + (is_average_ ? 2 + law_.dimension() : 0);
}

double DepletionIntegrand::scale() const {
  if (what_ == What::freedom) return 1.0;
  const double edge = 2.0 * (std::min(a_.circumradius(), b_.circumradius()) + ball_.circumradius());
  return edge * edge * edge;
}

double DepletionIntegrand::absolute_rounding() const {
  if (what_ == What::freedom) return 0.0;
  const double radius = std::min(a_.circumradius(), b_.circumradius()) + ball_.circumradius();
  return 4.0 * std::numbers::pi * radius * radius * 0x1p-50 * (a_.reach() + b_.reach() + ball_.reach() + distance_);
}

Doubts DepletionIntegrand::evaluate(std::span<const double> points, std::span<double> values) {
  Doubts doubts;
  const std::size_t n = values.size();
  point_.resize(static_cast<std::size_t>(dimension()));
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t c = 0; c < point_.size(); ++c) point_[c] = points[c * n + k];
    double half_width = 0.0;
    values[k] = value_at(&half_width);
    if (half_width > 0.0) doubts.push_back({k, half_width});
  }
  return doubts;
}

/// Of three proven verdicts: all the volume where they say so, none, or the middle with half of it as the doubt.
double DepletionIntegrand::value_at(double* half_width) {
  std::size_t at = 0;
  Outcome is_free = Outcome::overlap;  // whether there is anything to count
  if (is_average_) {
    // Archimedes: the height of a uniform direction is uniform.
    const double height = point_[0] + point_[0] - 1.0;
    const double across = 2.0 * std::sqrt(point_[0] * (1.0 - point_[0]));
    const SinCos<double> azimuth = sincospi(point_[1] + point_[1]);
    const auto n_law = static_cast<std::size_t>(law_.dimension());
    pose_ = law_.rotation(std::span<const double>(point_).subspan(2, n_law));
    pose_.translation = {distance_ * (across * azimuth.cos), distance_ * (across * azimuth.sin), distance_ * height};
    at = 2 + n_law;
    const Outcome bodies = overlap(a_, b_, Pose::unchecked(pose_)).outcome;
    is_free = bodies == Outcome::overlap    ? Outcome::disjoint
              : bodies == Outcome::disjoint ? Outcome::overlap
                                            : Outcome::undecided;
    if (what_ == What::freedom) return counted_volume(1.0, is_free, half_width);
    if (is_free == Outcome::disjoint) return 0.0;
  }
  const OverlapBox box = box_around_overlap(a_, b_, pose_, ball_.circumradius());
  if (box.is_empty()) return 0.0;
  const Vec3d p{box.low.x + point_[at] * box.width.x, box.low.y + point_[at + 1] * box.width.y,
                box.low.z + point_[at + 2] * box.width.z};
  Transformd a_from_ball;
  a_from_ball.translation = p;
  const Outcome in_a = overlap(a_, ball_, Pose::unchecked(a_from_ball)).outcome;
  if (in_a == Outcome::disjoint) return 0.0;
  Transformd ball_from_b = pose_;
  ball_from_b.translation = pose_.translation - p;
  const Outcome in_b = overlap(ball_, b_, Pose::unchecked(ball_from_b)).outcome;
  if (in_b == Outcome::disjoint) return 0.0;
  const bool is_sure = in_a == Outcome::overlap && in_b == Outcome::overlap && is_free == Outcome::overlap;
  return counted_volume(box.volume(), is_sure ? Outcome::overlap : Outcome::undecided, half_width);
}

}  // namespace vex
