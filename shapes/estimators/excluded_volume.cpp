#include "shapes/estimators/excluded_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"
#include "shapes/any_shape.h"
#include "shapes/estimators/exact_average.h"
#include "shapes/formula.h"
#include "shapes/needle.h"

namespace vex {
namespace {

using Settings = ExcludedVolumeSettings;

void require_finite(double value, const char* what) {
  if (!std::isfinite(value)) {
    throw InputError(std::string("a result would overflow (") + what + ") - choose another unit of length");
  }
  if (value == 0.0) {
    throw InputError(std::string("a result would underflow (") + what + ") - choose another unit of length");
  }
}

/// Of a user's own body they may be anything; the shapes' own are none of these.
void require_measures_that_can_be(const Body& body) {
  const Measures& m = body.measures;
  if (m.volume < 0.0 || m.surface_area < 0.0 || m.integrated_mean_curvature < 0.0) {
    throw InputError("measures that no body has (V = " + shortest_number(m.volume) + ", S = " +
                     shortest_number(m.surface_area) + ", M = " + shortest_number(m.integrated_mean_curvature) +
                     " of " + body.kind + ") - none is negative: give the body's own, or none");
  }
}

/// Beyond, products of six lengths over- or underflow on the way.
void require_size_for_volumes(const Body& body) {
  const bool is_large = !(body.body.reach() <= 2.0 * kMeasuredSizes.largest);
  if (!is_large && body.body.circumradius() >= 0.5 * kMeasuredSizes.smallest) return;
  throw InputError("a body is too " + std::string(is_large ? "large" : "small") + " for a volume (" + body.kind +
                   ") - use sizes and coordinates between " + shortest_number(kMeasuredSizes.smallest) + " and " +
                   shortest_number(kMeasuredSizes.largest) + ": choose another unit of length");
}

/// Where no stop rule is given the run ends at this one; where others are, a pilot chooses for it.
constexpr double kUsualRelativeError = 1e-4;

/// Of poses, of which estimators without them have none; null where nothing is said of poses.
const char* option_of_poses(const Settings& settings) {
  if (settings.backend.is_peer || settings.backend.name != gjk_backend().name) return "backend";
  if (!settings.cross_check.empty()) return "cross-check";
  if (settings.verify) return "verify";
  return settings.quick_verdicts ? nullptr : "no-quick-verdicts";
}

std::optional<Domain::Kind> domain_of(const Settings& settings) {
  if (settings.domain == "ball") return Domain::Kind::ball;
  if (settings.domain == "box") return Domain::Kind::box;
  return std::nullopt;
}

/// Why B can lie nowhere inside A, whatever the orientations; empty where it can.
std::string why_no_volume(const Body& a, const Body& b, const OrientationLaw& law) {
  // By what the bodies are: measures that somebody gave must not answer in place of the run.
  if (a.body.target<Needle>() != nullptr && b.body.target<Needle>() != nullptr) {
    return "two needles exclude no volume, in no orientation: <V_ex> = 0";
  }
  if (difference_is_flat(a, b, law)) return "flat bodies in parallel planes exclude no volume: <V_ex> = 0";
  return "";
}

MonteCarloSettings driver_settings(const Settings& settings) {
  MonteCarloSettings driver;
  driver.seed = settings.seed;
  driver.n_threads =
      settings.threads > 0 ? settings.threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  driver.law = settings.law;
  driver.stop = {settings.trials, settings.rel_error, settings.seconds, settings.max_trials};
  if (!settings.trials && !settings.rel_error && !settings.seconds) driver.stop.relative_error = kUsualRelativeError;
  driver.instruction_set = settings.instruction_set;
  driver.quick_verdicts = settings.quick_verdicts;
  driver.backend = settings.backend;
  driver.cross_check = settings.cross_check;
  driver.verify = settings.verify;
  driver.interrupt = settings.interrupt;
  driver.on_progress = settings.on_progress;
  driver.first_trial = settings.first_trial;
  driver.resume = settings.resume;
  driver.on_state = settings.on_state;
  driver.seconds_between_states = settings.seconds_between_states;
  driver.ranks = settings.ranks;
  return driver;
}

/// By the seed and the bodies alone.
void choose(const Body& a, const Body& b, const Settings& settings, const MonteCarloSettings& driver,
            ExcludedVolume* result) {
  result->candidates = measure_candidates(a, b, driver);
  const double error = settings.rel_error.value_or(kUsualRelativeError);
  // Hit-or-miss is for every pair, also where an interrupt let no pilot tell anything.
  const Estimator& usual = estimator_named("hit-or-miss");
  const Candidate chosen =
      chosen_of(result->candidates, error).value_or(Candidate{&usual, usual.usual_sequence, PilotCost{}});
  result->estimator = chosen.estimator;
  result->sequence = settings.sequence.value_or(chosen.sequence);
  result->chosen_because = "a pilot found it the fastest to a relative error of " + shortest_number(error);
}

/// Of the run that is about to begin; from the pilot that chose it, or one of its own.
Outlook outlook_of(const Body& a, const Body& b, const MonteCarloSettings& driver, const ExcludedVolume& result) {
  const auto is_this_run = [&result](const Candidate& one) {
    return one.estimator == result.estimator && one.sequence == result.sequence && result.control_weight == 0.0;
  };
  const auto chosen = std::ranges::find_if(result.candidates, is_this_run);
  const PilotCost cost = chosen != result.candidates.end() ? chosen->cost : pilot(a, b, driver);
  const double rate = static_cast<double>(driver.n_threads) / cost.seconds_per_trial_here;
  const auto time_of = [rate](double n_trials) { return n_trials / rate; };
  double seconds = std::numeric_limits<double>::infinity();
  if (driver.stop.trials) seconds = time_of(static_cast<double>(*driver.stop.trials));
  if (driver.stop.relative_error) seconds = std::fmin(seconds, time_of(cost.trials_to(*driver.stop.relative_error)));
  if (driver.stop.seconds) seconds = std::fmin(seconds, *driver.stop.seconds);
  const double most = time_of(static_cast<double>(driver.stop.max_trials));
  const bool gives_up = std::isfinite(seconds) && seconds > most;
  if (gives_up) seconds = most;
  const double before = driver.resume != nullptr ? driver.resume->seconds : 0.0;
  return {result.estimator, result.sequence, std::fmax(0.0, seconds - before), gives_up};
}

void sample(const Body& a, const Body& b, const Settings& settings, MonteCarloSettings driver, const Estimator* asked,
            ExcludedVolume* result) {
  if (asked != nullptr) {
    result->estimator = asked;
    result->sequence = settings.sequence.value_or(asked->usual_sequence);
    result->chosen_because = settings.estimator.empty() ? "another setting asked for it" : "it was asked for";
  } else {
    choose(a, b, settings, driver, result);
  }
  driver.sequence = result->sequence;
  set_estimator(driver, *result->estimator, a, b, domain_of(settings));
  if (const std::vector<Body>& control = settings.control_variate; !control.empty()) {
    result->control_weight = set_control_variate(driver, *result->estimator, control.front(), control.back());
  }
  result->domain = driver.domain;
  result->stratified = driver.stratified;
  if (!driver.integrand) require_finite(result->domain.volume, "the sampling volume");
  if (settings.on_start) settings.on_start(outlook_of(a, b, driver, *result));
  result->record = run_monte_carlo(a, b, driver);
  result->complete = result->record.complete;
}

std::string why_no_formula(const OrientationLaw& law) {
  return "the formula holds for isotropic orientations, not for " + law.name() + " ones";
}

Reference exact_reference(const Body& a, const Body& b, const ExactAverage& average) {
  return {Reference::Kind::exact, average.excluded_volume, average.error,
          reduced_excluded_volume(average.excluded_volume, a.measures, b.measures),
          second_virial_coefficient(average.excluded_volume)};
}

/// The formula, or what takes its place for other laws.
void find_reference(const Body& a, const Body& b, const Settings& settings, ExcludedVolume* result) {
  if (settings.law.kind() == OrientationLaw::Kind::isotropic) {
    const Reference formula = formula_reference(a.measures, b.measures);
    if (std::isnan(formula.value)) {
      result->reference_reason = "V, S and M of a body are not known";
    } else {
      result->reference = formula;
    }
    return;
  }
  result->reference_reason = why_no_formula(settings.law);
  if (!settings.exact_average) return;
  const auto has_normals = [](const Body& body) { return body.normals.area && body.normals.mean_curvature; };
  if (!has_normals(a) || !has_normals(b) || !a.measures.are_known() || !b.measures.are_known()) {
    result->reference_reason += ", and a body is without its measures on normals";
    return;
  }
  ExactAverageSettings exact;
  exact.interrupt = settings.interrupt;
  const ExactAverage average = exact_average(a, b, settings.law, exact);
  if (!std::isfinite(average.error)) return;  // interrupted before it was known at all
  result->reference = exact_reference(a, b, average);
}

}  // namespace

const Estimator* estimator_asked_for(const ExcludedVolumeSettings& settings) {
  if (settings.threads < 0) {
    throw UsageError("a negative number of threads (" + std::to_string(settings.threads) + ") - give 0 for all cores");
  }
  if (settings.control_variate.size() > 2) {
    throw UsageError("too many bodies (" + std::to_string(settings.control_variate.size()) +
                     " for control-variate) - at most two");
  }
  const Estimator* const asked = settings.estimator.empty() ? nullptr : &estimator_named(settings.estimator);
  if (const char* const option = option_of_poses(settings)) {
    if (asked == nullptr) return &estimator_named("hit-or-miss");
    if (!asked->samples_poses) {
      throw UsageError(std::string(option) + " is about overlap verdicts, of which this estimator asks none (\"" +
                       settings.estimator + "\" for estimator) - use hit-or-miss, hit-or-miss-fitted or stratified");
    }
  }
  if (!settings.domain.empty()) {
    if (settings.domain != "best" && !domain_of(settings)) {
      throw UsageError("no domain of this name (" + settings.domain + ") - there are ball, box and best");
    }
    if (asked == nullptr) return &estimator_named("hit-or-miss");
    if (!asked->has_domains) {
      throw UsageError("only hit-or-miss has a choice of domains (\"" + settings.domain + "\" for domain with " +
                       settings.estimator + ") - leave out the domain");
    }
  }
  if (!settings.control_variate.empty() && asked == nullptr) return &estimator_named("radial");
  return asked;
}

Reference formula_reference(const Measures& a, const Measures& b) {
  const double volume = average_excluded_volume(a, b);
  return {Reference::Kind::formula, volume, 0.0, reduced_excluded_volume(volume, a, b),
          second_virial_coefficient(volume)};
}

ExcludedVolume excluded_volume(const Body& a, const Body& b, const ExcludedVolumeSettings& settings) {
  const Estimator* const asked = estimator_asked_for(settings);
  const MonteCarloSettings driver = driver_settings(settings);
  require_threads_and_stop_rule(driver);
  std::vector<const Body*> bodies = {&a, &b};
  for (const Body& control : settings.control_variate) bodies.push_back(&control);
  for (const Body* const body : bodies) {
    require_measures_that_can_be(*body);
    require_size_for_volumes(*body);
  }
  ExcludedVolume result;
  if (const double formula = average_excluded_volume(a.measures, b.measures); formula != 0.0 && !std::isnan(formula)) {
    require_finite(formula, "the excluded volume");
  }
  require_finite(ball_domain(a, b).volume, "the sampling volume");
  result.no_run_reason = why_no_volume(a, b, settings.law);
  if (result.no_run_reason.empty()) {
    find_reference(a, b, settings, &result);
    sample(a, b, settings, driver, asked, &result);
  } else {
    const bool is_isotropic = settings.law.kind() == OrientationLaw::Kind::isotropic;
    if (!is_isotropic) result.reference_reason = why_no_formula(settings.law);
    result.reference = is_isotropic ? formula_reference(a.measures, b.measures) : exact_reference(a, b, {});
    result.record.complete = true;
  }
  const bool is_certain = result.domain.volume > 0.0 && hits_by_construction(a, b, settings.law, result.domain);
  conclude(a.measures, b.measures, is_certain, &result);
  return result;
}

}  // namespace vex
