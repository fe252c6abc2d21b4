#include "shapes/estimators/estimator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/sampling/control_variate.h"
#include "shapes/formula.h"

namespace vex {

extern const Estimator kRadial, kHitOrMiss, kHitOrMissFitted, kStratified, kMixedVolume, kMeanWidth;

std::span<const Estimator* const> estimators() {
  static constexpr std::array<const Estimator*, 6> kAll = {&kRadial,     &kHitOrMissFitted, &kHitOrMiss,
                                                           &kStratified, &kMixedVolume,     &kMeanWidth};
  return kAll;
}

const Estimator* find_estimator(std::string_view name) {
  const auto found = std::ranges::find(estimators(), name, [](const Estimator* e) { return e->name; });
  return found == estimators().end() ? nullptr : *found;
}

const Estimator& estimator_named(std::string_view name) {
  if (const Estimator* const found = find_estimator(name)) return *found;
  std::string all;
  for (const Estimator* const one : estimators()) all += (all.empty() ? "" : ", ") + std::string(one->name);
  throw UsageError("no estimator of this name (" + std::string(name) + ") - there are " + all);
}

void set_estimator(MonteCarloSettings& settings, const Estimator& estimator, const Body& a, const Body& b,
                   std::optional<Domain::Kind> domain) {
  if (const std::optional<std::string> reason = estimator.why_not(a, b, settings.law)) {
    throw UsageError("not for these (the estimator " + std::string(estimator.name) + ": " + *reason +
                     ") - use another");
  }
  settings.integrand = nullptr;
  settings.stratified = false;
  settings.domain = {};
  estimator.prepare(settings, a, b, domain);
}

double set_control_variate(MonteCarloSettings& settings, const Estimator& estimator, const Body& control_a,
                           const Body& control_b) {
  if (estimator.samples_poses) {
    throw UsageError("hits and misses have no control variate (the estimator " + std::string(estimator.name) +
                     ") - use radial or mixed-volume");
  }
  if (!settings.integrand)
    throw UsageError("no estimator is set whose error a control variate could make smaller - set it");
  if (settings.law.kind() != OrientationLaw::Kind::isotropic) {
    throw UsageError("the formula of a control variate holds for random orientations (not for " + settings.law.name() +
                     " ones) - leave out the control variate");
  }
  const double mean = average_excluded_volume(control_a.measures, control_b.measures);
  if (!std::isfinite(mean)) {
    throw UsageError("the formula of a control variate needs the bodies' V, S and M (which " + control_a.kind + " or " +
                     control_b.kind + " does not tell) - take a body that does");
  }
  MonteCarloSettings of_control = settings;
  set_estimator(of_control, estimator, control_a, control_b);
  const MakeIntegrand make_f = settings.integrand, make_g = of_control.integrand;
  const double weight = control_weight(*make_f(), *make_g(), settings.seed);
  settings.integrand = [make_f, make_g, mean, weight] {
    return std::make_unique<ControlledIntegrand>(make_f(), make_g(), mean, weight);
  };
  return weight;
}

}  // namespace vex
