#include "apps/common/estimators.h"

#include <algorithm>
#include <memory>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/sampling/control_variate.h"
#include "engine/sampling/fitted_domain.h"
#include "engine/sampling/radial_estimator.h"
#include "shapes/estimators/mean_width_estimator.h"
#include "shapes/estimators/mixed_volume_estimator.h"
#include "shapes/excluded_volume.h"

namespace vex {
namespace {

Domain domain_of(std::optional<Domain::Kind> kind, const ConvexBody& a, const ConvexBody& b) {
  if (!kind) return best_domain(a, b);
  switch (*kind) {
    case Domain::Kind::ball: return ball_domain(a, b);
    case Domain::Kind::box: return box_domain(a, b);
    case Domain::Kind::fitted: break;
  }
  return fitted_domain(a, b);
}

}  // namespace

std::optional<Estimator> estimator_named(std::string_view name) {
  const auto* const found = std::ranges::find(kEstimators, name, [](Estimator e) { return name_of(e); });
  return found == kEstimators.end() ? std::nullopt : std::optional(*found);
}

std::optional<std::string> why_not(Estimator estimator, const MeasuredBody& a, const MeasuredBody& b,
                                   const OrientationLaw& law) {
  switch (estimator) {
    case Estimator::hit_or_miss:
    case Estimator::hit_or_miss_fitted: return std::nullopt;
    case Estimator::radial:
      if (RadialMap(a.body, b.body, law).is_too_thin()) {
        return "A - B is thinner than 2^-22 of its length, and double precision does not tell rays in it apart";
      }
      return std::nullopt;
    case Estimator::stratified:
      if (is_ball(a.body) && is_ball(b.body)) return "between the balls in and about two balls there is nothing";
      return std::nullopt;
    case Estimator::mixed_volume:
      if (!a.normals.area || !b.normals.area) return "a body is without its measures on normals";
      return std::nullopt;
    case Estimator::mean_width: break;
  }
  if (law.kind() == OrientationLaw::Kind::isotropic) return std::nullopt;
  return "mean widths are of random orientations, not of " + law.name() + " ones";
}

void set_estimator(MonteCarloSettings& settings, Estimator estimator, const MeasuredBody& a, const MeasuredBody& b,
                   std::optional<Domain::Kind> domain) {
  if (const std::optional<std::string> reason = why_not(estimator, a, b, settings.law)) {
    throw UsageError("not for these (" + std::string(name_of(estimator)) + " for --estimator: " + *reason +
                     ") - use another");
  }
  settings.integrand = nullptr;
  settings.stratified = false;
  settings.domain = {};
  switch (estimator) {
    case Estimator::hit_or_miss: settings.domain = domain_of(domain, a.body, b.body); return;
    case Estimator::hit_or_miss_fitted: settings.domain = fitted_domain(a.body, b.body); return;
    case Estimator::stratified:
      settings.domain = ball_domain(a.body, b.body);
      settings.stratified = true;
      return;
    case Estimator::radial:
      settings.integrand = [&a = a.body, &b = b.body, law = settings.law, set = settings.instruction_set] {
        return std::make_unique<RadialEstimator>(a, b, law, set);
      };
      return;
    case Estimator::mixed_volume:
      // What the faces were sorted into is shared by the threads' copies.
      settings.integrand = [whole = std::make_shared<const MixedVolumeEstimator>(a, b, settings.law)] {
        return std::make_unique<MixedVolumeEstimator>(*whole);
      };
      return;
    case Estimator::mean_width:
      settings.integrand = [&a, &b] { return std::make_unique<MeanWidthEstimator>(a, b); };
      return;
  }
}

double set_control_variate(MonteCarloSettings& settings, Estimator estimator, const MeasuredBody& control_a,
                           const MeasuredBody& control_b) {
  if (samples_poses(estimator)) {
    throw UsageError("hits and misses have no control variate (" + std::string(name_of(estimator)) +
                     " for --estimator) - use radial or mixed-volume");
  }
  if (settings.law.kind() != OrientationLaw::Kind::isotropic) {
    throw UsageError("the formula of a control variate holds for random orientations (" + settings.law.name() +
                     " for --orientations) - leave out --control-variate");
  }
  MonteCarloSettings of_control = settings;
  set_estimator(of_control, estimator, control_a, control_b);
  const double mean = average_excluded_volume(control_a.measures, control_b.measures);
  const MakeIntegrand make_f = settings.integrand, make_g = of_control.integrand;
  const double weight = control_weight(*make_f(), *make_g(), settings.seed);
  settings.integrand = [make_f, make_g, mean, weight] {
    return std::make_unique<ControlledIntegrand>(make_f(), make_g(), mean, weight);
  };
  return weight;
}

std::vector<Candidate> measure_candidates(const MeasuredBody& a, const MeasuredBody& b,
                                          const MonteCarloSettings& settings) {
  std::vector<Candidate> candidates;
  // Of meshes with more faces than this the others' set-up would take as long as the run.
  constexpr std::size_t kMostFaces = 20000;
  const auto measure = [&](Estimator estimator, Sequence sequence) {
    if (settings.interrupt != nullptr && settings.interrupt->load() != 0 && !candidates.empty()) return;
    if (!is_independent_of_formula(estimator) && a.n_faces + b.n_faces > kMostFaces) return;
    MonteCarloSettings with = settings;
    with.sequence = sequence;
    try {
      set_estimator(with, estimator, a, b);
      if (!with.integrand && hits_by_construction(a.body, b.body, with.law, with.domain)) return;
      candidates.push_back({estimator, sequence, pilot(a.body, b.body, with)});
    } catch (const UsageError&) {  // it is not for the pair, or its values are lost to rounding
    }
  };
  measure(Estimator::radial, Sequence::sobol);
  measure(Estimator::hit_or_miss_fitted, Sequence::sobol);
  measure(Estimator::hit_or_miss, Sequence::random);
  measure(Estimator::stratified, Sequence::random);
  measure(Estimator::mixed_volume, Sequence::sobol);
  measure(Estimator::mean_width, Sequence::sobol);
  return candidates;
}

Candidate chosen_of(const std::vector<Candidate>& candidates, double relative_error) {
  std::optional<Candidate> chosen;
  double least = 0.0;
  for (const Candidate& candidate : candidates) {
    if (!is_independent_of_formula(candidate.estimator)) continue;
    constexpr double kPreferred = 0.25;
    const double seconds =
        (candidate.estimator == Estimator::radial ? kPreferred : 1.0) * candidate.cost.seconds_to(relative_error);
    if (chosen && !(seconds < least)) continue;
    least = seconds;
    chosen = candidate;
  }
  VEX_ENSURE(chosen.has_value());
  return chosen.value();
}

}  // namespace vex
