#include "shapes/estimators/virial_coefficients.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>

#include "engine/numeric/errors.h"
#include "engine/sampling/points/trial_points.h"
#include "engine/sampling/virial/cluster_weights.h"
#include "engine/sampling/virial/triangle_integrand.h"
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

// What runs may take of it. Rounding of the formula, too, is an error.
KnownExcludedVolume excluded_volume_of(const B2& b2) {
  return {2.0 * b2.value, (b2.value > 0.0 ? b2.error / b2.value : 0.0) + 0x1p-40};
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
  driver.stop.trials = settings.trials;
  driver.first_trial = settings.first_trial;
  driver.seconds_between_states = settings.seconds_between_states;
  driver.ranks = settings.ranks;
  if (settings.samples && *settings.samples == 0) throw UsageError("a run has no samples - give one at least");
  if (settings.samples && settings.first_trial > 0) {
    throw UsageError("a range of trials with a number of clusters (first trial " +
                     std::to_string(settings.first_trial) + ") - give trials alone, which are bunches of clusters");
  }
  if (!settings.rel_error && !settings.seconds && !settings.samples && !settings.trials) {
    driver.stop.relative_error = 1e-3;
    driver.stop.seconds = 60.0;
  }
  require_threads_and_stop_rule(driver);
  return driver;
}

constexpr std::uint64_t kTrianglesOfBunch = VirialCoefficient::kTrianglesOfBunch;
static_assert(kTrianglesOfBunch % kClasses == 0);

bool is_of_triangles(const Tally& tally) { return tally.by_class.kind == ClassTally::Kind::scramblings; }

std::uint64_t n_samples(const Tally& tally, int n) {
  return tally.n_trials * (is_of_triangles(tally) ? 1 : VirialIntegrand::n_clusters(n));
}

// A range that there are points for, in the words of who asks for it.
void require_triangles(const MonteCarloSettings& driver) {
  constexpr std::uint64_t kMost = TrialPoints::kMostSobolTrials / kTrianglesOfBunch;
  const std::uint64_t first = driver.first_trial, n = driver.stop.trials.value_or(1);
  if (first < kMost && n <= kMost - first) return;
  throw UsageError("B3 has no points for these trials (" + std::to_string(n) + " from " + std::to_string(first) +
                   " on) - there are " + std::to_string(kMost) + ", of " + std::to_string(kTrianglesOfBunch) +
                   " triangles each: give a range of these, and another seed for more");
}

std::uint64_t triangles_of(std::uint64_t bunches) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max() / kTrianglesOfBunch;
  return std::min(bunches, kMost) * kTrianglesOfBunch;
}

// Of one coefficient.
struct Integration {
  MakeIntegrand integrand;
  bool is_of_triangles = false;
};

// The runs of the driver, a coefficient each, one after another.
class VirialRuns {
 public:
  VirialRuns(const VirialSettings& settings, std::size_t n_runs)
      : settings_(settings), driver_(driver_settings(settings)), n_runs_(n_runs), states_(settings.resume) {
    if (states_.size() > n_runs) {
      throw InputError("the state to go on from has more coefficients than this run (" +
                       std::to_string(states_.size()) + ", and " + std::to_string(n_runs) +
                       ") - ask for as many or more");
    }
  }

  double seconds() const { return seconds_; }

  // Of this order; what the driver calls the domain of hit or miss is not looked at.
  RunRecord next(int n, const ConvexBody& a, const ConvexBody& b, const Integration& integration) {
    MonteCarloSettings driver = driver_;
    driver.integrand = integration.integrand;
    if (settings_.samples) {
      const std::uint64_t n_of_bunch = integration.is_of_triangles ? kTrianglesOfBunch : VirialIntegrand::n_clusters(n);
      const std::uint64_t n_bunches = (*settings_.samples - 1) / n_of_bunch + 1;
      driver.stop.trials = std::min(driver.stop.trials.value_or(n_bunches), n_bunches);
    }
    if (integration.is_of_triangles) {
      require_triangles(driver);
      driver.sequence = Sequence::sobol;
      driver.first_trial = triangles_of(driver.first_trial);
      driver.stop.max_trials = triangles_of(driver.stop.max_trials);
      if (driver.stop.trials) driver.stop.trials = triangles_of(*driver.stop.trials);
    }
    // What is left of the time, for as many runs as are left.
    if (driver.stop.seconds) {
      driver.stop.seconds = std::fmax(0.0, (*driver.stop.seconds - seconds_) / static_cast<double>(n_runs_ - k_));
    }
    if (settings_.on_progress) {
      driver.on_progress = [this, n](const Progress& progress) { settings_.on_progress(n, progress); };
    }
    if (k_ < settings_.resume.size()) driver.resume = &settings_.resume[k_];
    if (settings_.on_state) {
      driver.on_state = [this](const RunState& state) {
        states_.resize(std::max(states_.size(), k_ + 1));
        states_[k_] = state;
        settings_.on_state(states_);
      };
    }
    RunRecord record = run_monte_carlo(a, b, driver);
    seconds_ += record.seconds;
    ++k_;
    return record;
  }

 private:
  const VirialSettings& settings_;
  const MonteCarloSettings driver_;
  const std::size_t n_runs_;
  std::size_t k_ = 0;
  double seconds_ = 0.0;  // of the runs that ended
  std::vector<RunState> states_;
};

struct ReducedVirial {
  double value = kUnknown, std_error = std::numeric_limits<double>::infinity();
};

ReducedVirial reduced_virial(const Tally& tally) {
  if (tally.n_trials == 0) return {};
  const VolumeEstimate estimate = volume_estimate(tally, {});
  return {estimate.excluded_volume, estimate.std_error};
}

Integration integration_of(int n, const ConvexBody& body, const VirialSettings& settings,
                           const KnownExcludedVolume& known) {
  const OrientationLaw law = settings.law;
  const InstructionSet set = settings.instruction_set;
  if (n == 3 && TriangleIntegrand::is_for(body, law, known.value, known.relative_error)) {
    return {[=] { return std::make_unique<TriangleIntegrand>(body, law, known.value, known.relative_error, set); },
            true};
  }
  const auto weights = std::make_shared<const ClusterWeights>(n);
  // Of larger clusters next to nothing hangs on the distance of single neighbours.
  constexpr int kLastControlled = 6;
  const auto control = n > kLastControlled && chains_factorise(law)
                           ? nullptr
                           : VirialIntegrand::control_of(body, law, weights, known, set);
  return {[=] { return std::make_unique<VirialIntegrand>(body, law, weights, set, control, known); }};
}

}  // namespace

bool VirialCoefficient::sign_is_settled() const {
  constexpr double kSure = 3.0;
  return std::fabs(reduced) > kSure * std_error;
}

bool VirialCoefficients::is_series() const { return higher.empty() || higher.front().n == ClusterWeights::kLeastOrder; }

double VirialCoefficients::compressibility_factor(double volume_fraction) const {
  if (!is_series()) return kUnknown;
  double sum = 1.0 + b2_per_volume * volume_fraction, power = volume_fraction;
  for (const VirialCoefficient& coefficient : higher) {
    power *= volume_fraction;
    sum += coefficient.per_volume * power;
  }
  return sum;
}

void VirialCoefficient::conclude(double b2_per_volume, double b2_relative_error) {
  const ReducedVirial found = reduced_virial(record.tally);
  reduced = found.value;
  // <V_ex> is in the values of triangles and of bodies that are turned by a law, and then its error is in the mean.
  std_error = std::hypot(found.std_error, (n - 1) * reduced * b2_relative_error);
  samples = n_samples(record.tally, n);
  pairs = VirialPairs::of(record.tally);
  const double power = std::pow(b2_per_volume, n - 1);
  per_volume = reduced * power;
  per_volume_std_error = std_error * power;
}

void MixedVirial::conclude() {
  const ReducedVirial found = reduced_virial(record.tally);
  reduced = found.value;
  reduced_std_error = std::hypot(found.std_error, reduced * b2_relative_error);
  samples = n_samples(record.tally, 3);
  pairs = VirialPairs::of(record.tally);
  value = reduced * b2_product;
  std_error = reduced_std_error * b2_product;
}

VirialCoefficients virial_coefficients(const Body& body, const VirialSettings& settings) {
  for (const int order : {settings.first_order, settings.order}) {
    if (order >= std::max(ClusterWeights::kLeastOrder, settings.first_order) && order <= ClusterWeights::kMostOrder) {
      continue;
    }
    throw UsageError("no virial coefficients from order " + std::to_string(settings.first_order) + " to " +
                     std::to_string(settings.order) + " - give orders from " +
                     std::to_string(ClusterWeights::kLeastOrder) + " to " + std::to_string(ClusterWeights::kMostOrder));
  }
  VirialRuns runs(settings, static_cast<std::size_t>(settings.order - settings.first_order + 1));
  require_law_of_one_body(settings.law);
  VirialCoefficients result;
  const B2 b2 = known_b2(body, body, settings.law);
  require_overlaps(b2, body, settings.law);
  result.b2 = b2.value;
  result.b2_std_error = b2.error;
  result.b2_reason = b2.reason;
  const double volume = body.measures.volume;
  result.b2_per_volume = volume > 0.0 ? b2.value / volume : kUnknown;
  for (int n = settings.first_order; n <= settings.order; ++n) {
    VirialCoefficient found;
    found.n = n;
    found.record = runs.next(n, body.body, body.body, integration_of(n, body.body, settings, excluded_volume_of(b2)));
    found.conclude(result.b2_per_volume, result.b2_relative_error());
    result.complete = result.complete && found.record.complete;
    const bool is_interrupted = found.record.stopped_by == StopReason::interrupted;
    result.higher.push_back(std::move(found));
    if (is_interrupted) break;
  }
  result.seconds = runs.seconds();
  return result;
}

std::array<MixedVirial, 4> third_virials_of_mixture(const Body& a, const Body& b, const VirialSettings& settings) {
  std::array<MixedVirial, 4> result;
  VirialRuns runs(settings, result.size());
  require_law_of_one_body(settings.law);
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
    mixed.b2_product = first.value * second.value;
    mixed.b2_relative_error = first.error / first.value + second.error / second.value;
    const auto weights = std::make_shared<const ClusterWeights>(3);
    const std::array<KnownExcludedVolume, 2> known = {excluded_volume_of(first), excluded_volume_of(second)};
    const auto make = [&] {
      return std::make_unique<VirialIntegrand>(
          std::array<ConvexBody, 3>{bodies[0]->body, bodies[1]->body, bodies[2]->body}, settings.law, weights,
          settings.instruction_set, known);
    };
    mixed.record = runs.next(3, bodies[0]->body, bodies[2]->body, {make});
    mixed.conclude();
  }
  return result;
}

}  // namespace vex
