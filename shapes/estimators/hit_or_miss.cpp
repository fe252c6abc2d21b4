// The estimators that ask whether A and B overlap at random poses: share of hits times the volume of the domain.
#include "engine/sampling/poses/fitted_domain.h"
#include "shapes/estimators/estimator.h"

namespace vex {
namespace {

std::optional<std::string> for_all(const Body& /*a*/, const Body& /*b*/, const OrientationLaw& /*law*/) { return {}; }

Domain domain_of(std::optional<Domain::Kind> kind, const ConvexBody& a, const ConvexBody& b) {
  if (!kind) return best_domain(a, b);
  switch (*kind) {
    case Domain::Kind::ball: return ball_domain(a, b);
    case Domain::Kind::box: return box_domain(a, b);
    case Domain::Kind::fitted: break;
  }
  return fitted_domain(a, b);
}

void in_a_domain(MonteCarloSettings& settings, const Body& a, const Body& b, std::optional<Domain::Kind> domain) {
  settings.domain = domain_of(domain, a, b);
}

void in_fitted_domains(MonteCarloSettings& settings, const Body& a, const Body& b, std::optional<Domain::Kind>) {
  settings.domain = fitted_domain(a, b);
}

std::optional<std::string> not_for_balls(const Body& a, const Body& b, const OrientationLaw& /*law*/) {
  if (is_ball(a) && is_ball(b)) return "between the balls in and about two balls there is nothing";
  return std::nullopt;
}

void in_shells(MonteCarloSettings& settings, const Body& a, const Body& b, std::optional<Domain::Kind>) {
  settings.domain = ball_domain(a, b);
  settings.stratified = true;
}

}  // namespace

extern const Estimator kHitOrMiss, kHitOrMissFitted, kStratified;
constinit const Estimator kHitOrMiss{.name = "hit-or-miss",
                                     .meaning = "the paper's: hits in one domain",
                                     .samples_poses = true,
                                     .runs_gjk = true,
                                     .has_domains = true,
                                     .why_not = for_all,
                                     .prepare = in_a_domain};
constinit const Estimator kHitOrMissFitted{.name = "hit-or-miss-fitted",
                                           .meaning = "its domain fitted to each trial's orientation",
                                           .samples_poses = true,
                                           .runs_gjk = true,
                                           .pilot_sequence = Sequence::sobol,
                                           .why_not = for_all,
                                           .prepare = in_fitted_domains};
constinit const Estimator kStratified{.name = "stratified",
                                      .meaning = "hit or miss in shells",
                                      .samples_poses = true,
                                      .runs_gjk = true,
                                      .why_not = not_for_balls,
                                      .prepare = in_shells};

}  // namespace vex
