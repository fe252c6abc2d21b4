#include "engine/sampling/runner_factory.h"

#include <utility>

#include "engine/numeric/errors.h"
#include "engine/sampling/poses/pose_map.h"

namespace vex {

RunnerFactory::RunnerFactory(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings)
    : a_(a), b_(b), settings_(settings) {
  if (settings.quick_verdicts && !settings.backend.is_peer && !settings.integrand)
    quick_.emplace(a, b, kDrawnRotationError);
  if (settings.integrand) {
    first_integrand_ = settings.integrand();
    if (first_integrand_ == nullptr) throw UsageError("a run's integrand is none - give one");
    reference_ = reference_value(*first_integrand_);
  }
}

std::unique_ptr<TrialRunner> RunnerFactory::make() {
  if (!settings_.integrand) return make_pose_runner(a_, b_, settings_, quick_ ? &*quick_ : nullptr);
  std::unique_ptr<Integrand> integrand;
  {
    const std::lock_guard lock(mutex_);
    integrand = std::move(first_integrand_);
  }
  if (integrand == nullptr) integrand = settings_.integrand();
  return make_averaging_runner(settings_, std::move(integrand), reference_);
}

std::uint64_t RunnerFactory::grain() const {
  return settings_.sequence == Sequence::sobol || settings_.stratified ? kClasses : 1;
}

}  // namespace vex
