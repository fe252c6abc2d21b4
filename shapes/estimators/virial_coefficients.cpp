#include "shapes/estimators/virial_coefficients.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>

#include "engine/numeric/errors.h"
#include "engine/sampling/virial/cluster_weights.h"
#include "engine/sampling/virial/virial_integrand.h"
#include "shapes/estimators/exact_average.h"
#include "shapes/formula.h"

namespace vex {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct B2 {
  double value = kUnknown, error = 0.0;
  std::string reason;
};

B2 known_b2(const Body& a, const Body& b, const OrientationLaw& law) {
  if (law.kind() == OrientationLaw::Kind::isotropic) {
    const double volume = average_excluded_volume(a.measures, b.measures);
    if (std::isnan(volume)) return {kUnknown, 0.0, "V, S and M of a body are not known"};
    return {second_virial_coefficient(volume), 0.0, ""};
  }
  if (!a.normals.area || !a.normals.mean_curvature || !a.measures.are_known()) {
    return {kUnknown, 0.0, "a body is without its measures on normals"};
  }
  const ExactAverage average = exact_average(a, b, law);
  return {second_virial_coefficient(average.excluded_volume), second_virial_coefficient(average.error), ""};
}

void require_overlaps(const B2& b2, const Body& a, const OrientationLaw& law) {
  const double reach = a.body.circumradius();
  constexpr double kNothing = 1e-12;
  if (b2.reason.empty() && !(b2.value > kNothing * reach * reach * reach)) {
    throw InputError("bodies that never overlap with orientations " + law.name() +
                     " (B2 is 0) - virial coefficients are in units of B2: give others");
  }
}

MonteCarloSettings driver_settings(const VirialSettings& settings) {
  MonteCarloSettings driver;
  driver.seed = settings.seed;
  if (settings.threads < 0) {
    throw UsageError("a negative number of threads (" + std::to_string(settings.threads) + ") - give 0 for all cores");
  }
  const unsigned n_cores = std::max(1u, std::thread::hardware_concurrency());
  driver.n_threads = settings.threads > 0 ? settings.threads : static_cast<int>(std::min(n_cores, 1024u));
  driver.law = settings.law;
  driver.instruction_set = settings.instruction_set;
  driver.interrupt = settings.interrupt;
  driver.stop.relative_error = settings.rel_error;
  driver.stop.seconds = settings.seconds;
  driver.stop.max_trials = settings.max_trials;
  if (settings.samples) {
    if (*settings.samples == 0) throw UsageError("a run has no samples - give one at least");
  }
  if (!settings.rel_error && !settings.seconds && !settings.samples) {
    driver.stop.relative_error = 1e-3;
    driver.stop.seconds = 60.0;
  }
  require_threads_and_stop_rule(driver);
  return driver;
}

using MakeVirialIntegrand = std::function<std::unique_ptr<Integrand>(const std::shared_ptr<const ClusterWeights>&,
                                                                     const std::shared_ptr<VirialCounts>&)>;

// Of this order; what the driver calls the domain of hit or miss is not looked at.
VirialCoefficient run(int n, const ConvexBody& a, const ConvexBody& b, MonteCarloSettings driver,
                      const std::optional<std::uint64_t>& samples, const MakeVirialIntegrand& make) {
  const auto weights = std::make_shared<const ClusterWeights>(n);
  const auto counts = std::make_shared<VirialCounts>();
  driver.integrand = [&] { return make(weights, counts); };
  const std::uint64_t n_clusters = VirialIntegrand::n_clusters(*weights);
  if (samples) driver.stop.trials = (*samples - 1) / n_clusters + 1;
  VirialCoefficient found;
  found.n = n;
  found.record = run_monte_carlo(a, b, driver);
  found.samples = found.record.tally.n_trials * n_clusters;
  found.pairs = {counts->n_pairs, counts->n_by_balls, counts->n_searched, counts->n_undecided, counts->n_candidates};
  found.reduced = kUnknown;
  found.std_error = std::numeric_limits<double>::infinity();
  if (found.record.tally.n_trials > 0) {
    const VolumeEstimate estimate = volume_estimate(found.record.tally, driver.domain);
    found.reduced = estimate.excluded_volume;
    found.std_error = estimate.std_error;
  }
  return found;
}

// Tells each run of a few how long it may last.
class Clock {
 public:
  explicit Clock(const std::optional<double>& seconds) : left_(seconds) {}

  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  std::optional<double> next_part(int n_runs_left) const {
    if (!left_) return std::nullopt;
    return std::fmax(0.0, (*left_ - seconds()) / n_runs_left);
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<double> left_;
};

}  // namespace

bool VirialCoefficient::sign_is_settled() const {
  constexpr double kSure = 3.0;
  return std::fabs(reduced) > kSure * std_error;
}

double VirialCoefficients::compressibility_factor(double volume_fraction) const {
  double sum = 1.0 + b2_per_volume * volume_fraction, power = volume_fraction;
  for (const VirialCoefficient& coefficient : higher) {
    power *= volume_fraction;
    sum += coefficient.per_volume * power;
  }
  return sum;
}

VirialCoefficients virial_coefficients(const Body& body, const VirialSettings& settings) {
  const MonteCarloSettings driver = driver_settings(settings);
  if (settings.order < ClusterWeights::kLeastOrder || settings.order > ClusterWeights::kMostOrder) {
    throw UsageError("no virial coefficients to this order (" + std::to_string(settings.order) + ") - give one from " +
                     std::to_string(ClusterWeights::kLeastOrder) + " to " + std::to_string(ClusterWeights::kMostOrder));
  }
  require_factorising_law(settings.law);
  const Clock clock(driver.stop.seconds);
  VirialCoefficients result;
  const B2 b2 = known_b2(body, body, settings.law);
  require_overlaps(b2, body, settings.law);
  result.b2 = b2.value;
  result.b2_std_error = b2.error;
  result.b2_reason = b2.reason;
  const double volume = body.measures.volume;
  result.b2_per_volume = volume > 0.0 ? b2.value / volume : kUnknown;
  for (int n = ClusterWeights::kLeastOrder; n <= settings.order; ++n) {
    MonteCarloSettings of_order = driver;
    of_order.stop.seconds = clock.next_part(settings.order - n + 1);
    if (settings.on_progress) {
      of_order.on_progress = [&settings, n](const Progress& progress) { settings.on_progress(n, progress); };
    }
    VirialCoefficient found =
        run(n, body, body, of_order, settings.samples, [&](const auto& weights, const auto& counts) {
          return std::make_unique<VirialIntegrand>(body.body, settings.law, weights, counts, settings.instruction_set);
        });
    const double power = std::pow(result.b2_per_volume, n - 1);
    found.per_volume = found.reduced * power;
    found.per_volume_std_error =
        std::hypot(found.std_error * power, (n - 1) * found.per_volume * (b2.value > 0.0 ? b2.error / b2.value : 0.0));
    result.complete = result.complete && found.record.complete;
    const bool is_interrupted = found.record.stopped_by == StopReason::interrupted;
    result.higher.push_back(std::move(found));
    if (is_interrupted) break;
  }
  result.seconds = clock.seconds();
  return result;
}

std::array<MixedVirial, 4> third_virials_of_mixture(const Body& a, const Body& b, const VirialSettings& settings) {
  const MonteCarloSettings driver = driver_settings(settings);
  require_factorising_law(settings.law);
  const Clock clock(driver.stop.seconds);
  std::array<MixedVirial, 4> result;
  for (std::size_t k = 0; k < result.size(); ++k) {
    MixedVirial& mixed = result[k];
    std::array<const Body*, 3> bodies{};
    for (std::size_t at = 0; at < bodies.size(); ++at) {
      const bool is_a = at + k < bodies.size();
      bodies[at] = is_a ? &a : &b;
      mixed.name += is_a ? 'A' : 'B';
    }
    const B2 first = known_b2(*bodies[0], *bodies[1], settings.law);
    const B2 second = known_b2(*bodies[1], *bodies[2], settings.law);
    require_overlaps(first, *bodies[0], settings.law);
    require_overlaps(second, *bodies[1], settings.law);
    MonteCarloSettings of_this = driver;
    of_this.stop.seconds = clock.next_part(static_cast<int>(result.size() - k));
    if (settings.on_progress) {
      of_this.on_progress = [&settings](const Progress& progress) { settings.on_progress(3, progress); };
    }
    VirialCoefficient found =
        run(3, *bodies[0], *bodies[2], of_this, settings.samples, [&](const auto& weights, const auto& counts) {
          return std::make_unique<VirialIntegrand>(
              std::array<ConvexBody, 3>{bodies[0]->body, bodies[1]->body, bodies[2]->body}, settings.law, weights,
              counts, settings.instruction_set);
        });
    const double factor = first.value * second.value;
    mixed.reduced = found.reduced;
    mixed.reduced_std_error = found.std_error;
    mixed.value = found.reduced * factor;
    const double of_b2 = std::hypot(first.error / first.value, second.error / second.value);
    mixed.std_error = std::hypot(found.std_error * factor, mixed.value * of_b2);
    mixed.samples = found.samples;
    mixed.record = std::move(found.record);
  }
  return result;
}

}  // namespace vex
