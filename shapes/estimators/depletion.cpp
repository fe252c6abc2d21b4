#include "shapes/estimators/depletion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <thread>

#include "engine/numeric/double_double.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"
#include "engine/sampling/depletion/depletion_integrand.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

using std::numbers::pi;

void require_settings(const Body& a, const Body& b, const DepletionSettings& settings) {
  if (!(settings.ball_radius > 0.0 && std::isfinite(settings.ball_radius))) {
    throw UsageError("no radius of a depletant's ball (" + shortest_number(settings.ball_radius) +
                     ") - give one above 0");
  }
  const double reach = a.body.reach() + b.body.reach() + settings.ball_radius;
  if (!(reach < 1e75 && settings.ball_radius > 1e-75)) {
    throw InputError("bodies or balls too large or small for their volumes to be numbers (sizes together " +
                     shortest_number(reach) + ", radius of the ball " + shortest_number(settings.ball_radius) +
                     ") - choose another unit of length");
  }
  if (settings.threads < 0) {
    throw UsageError("a negative number of threads (" + std::to_string(settings.threads) + ") - give 0 for all cores");
  }
}

// `largest`: of the values.
DepletionValue mean_of(const Body& a, const Body& b, const DepletionSettings& settings, double largest,
                       const MakeIntegrand& make) {
  MonteCarloSettings driver;
  driver.seed = settings.seed;
  const unsigned n_cores = std::max(1u, std::thread::hardware_concurrency());
  driver.n_threads = settings.threads > 0 ? settings.threads : static_cast<int>(std::min(n_cores, 1024u));
  driver.stop.trials = settings.trials;
  driver.stop.relative_error = settings.rel_error;
  driver.stop.seconds = settings.seconds;
  driver.stop.max_trials = settings.max_trials;
  if (!settings.trials && !settings.rel_error && !settings.seconds) driver.stop.relative_error = 1e-2;
  require_threads_and_stop_rule(driver);
  driver.integrand = make;
  driver.interrupt = settings.interrupt;
  driver.on_progress = settings.on_progress;
  DepletionValue found;
  found.record = run_monte_carlo(a.body, b.body, driver);
  found.complete = found.record.complete;
  found.value = std::numeric_limits<double>::quiet_NaN();
  found.std_error = std::numeric_limits<double>::infinity();
  if (found.record.tally.n_trials > 0) {
    const VolumeEstimate estimate = volume_estimate(found.record.tally, driver.domain);
    found.value = estimate.excluded_volume;
    found.std_error = estimate.std_error;
    // Where no point hits, or every one does, values that do not differ tell nothing of the error; one point that did
    // otherwise would be worth this.
    const double one_point = largest / static_cast<double>(found.record.tally.n_trials);
    const bool do_all_alike = !(found.value > 0.0 && found.value < largest * (1.0 - 0x1p-30));
    if (do_all_alike || !std::isfinite(found.std_error)) found.std_error = std::fmax(estimate.std_error, one_point);
    if (!std::isfinite(found.std_error)) found.std_error = largest;  // of a single point
  }
  return found;
}

DepletionValue certain(double value) {
  DepletionValue found;
  found.value = value;
  return found;
}

}  // namespace

// The two caps that the plane of the common circle cuts off. Their heights are products of what the balls reach into
// each other and out of each other, each of which is a sum of three lengths that is rounded once, so nothing cancels;
// and in units of the smaller radius nothing overflows that is not too large itself.
double overlap_of_balls(double radius_1, double radius_2, double distance) {
  const double larger = std::max(radius_1, radius_2), smaller = std::min(radius_1, radius_2);
  const DoubleDouble off = DoubleDouble(distance) + DoubleDouble(-larger);
  const double into = (DoubleDouble(smaller) + -off).high, out_of = (DoubleDouble(smaller) + off).high;
  if (!(into > 0.0) || !(smaller > 0.0)) return 0.0;
  const auto times_cube = [smaller](double volume) { return volume * smaller * smaller * smaller; };
  if (!(out_of > 0.0)) return times_cube(4.0 / 3.0 * pi);
  const double share = into / smaller;
  const double of_larger = 0.5 * (out_of / distance) * share;
  const double of_smaller = (0.5 + 0.5 * ((larger - smaller) / distance)) * share;
  const double radius = larger / smaller;
  const double cap_of_larger = std::isfinite(radius) ? of_larger * of_larger * (3.0 * radius - of_larger) : 0.0;
  return times_cube(pi / 3.0 * (cap_of_larger + of_smaller * of_smaller * (3.0 - of_smaller)));
}

double DepletionAverage::mean_of_free() const {
  return free_share.value > 0.0 ? overlap_volume.value / free_share.value : std::numeric_limits<double>::quiet_NaN();
}

double DepletionAverage::mean_of_free_error() const {
  // Of a ratio of two means, to first order; the two runs share their seed, and their errors might help each other in
  // the worst way.
  const double mean = mean_of_free();
  return overlap_volume.std_error / free_share.value + std::fabs(mean) * free_share.std_error / free_share.value;
}

DepletionAtPose depletion_at(const Body& a, const Body& b, const Pose& a_from_b, const DepletionSettings& settings) {
  require_settings(a, b, settings);
  const ConvexBody ball(Sphere(settings.ball_radius));
  DepletionAtPose found;
  found.bodies = outcome_at(a.body, b.body, a_from_b.a_from_b());
  const OverlapBox box = box_around_overlap(a.body, b.body, a_from_b.a_from_b(), settings.ball_radius);
  if (box.is_empty()) return found;  // surely none
  // Of shells that touch to within the box's own margins a bound is all there is to say.
  constexpr double kThin = 0x1p-30;
  const double reach = a.body.reach() + b.body.reach() + settings.ball_radius;
  if (std::min({box.width.x, box.width.y, box.width.z}) < kThin * reach) {
    found.overlap_volume.value = found.overlap_volume.std_error = 0.5 * box.volume();
    return found;
  }
  found.overlap_volume = mean_of(a, b, settings, box.volume(), [&] {
    return std::make_unique<DepletionIntegrand>(a.body, b.body, ball, a_from_b.a_from_b());
  });
  return found;
}

DepletionAverage depletion_average(const Body& a, const Body& b, double distance, const OrientationLaw& law,
                                   const DepletionSettings& settings) {
  require_settings(a, b, settings);
  if (!(distance >= 0.0 && distance < 1e75)) {
    throw UsageError("no distance (" + shortest_number(distance) + ") - give one from 0 up");
  }
  const ConvexBody ball(Sphere(settings.ball_radius));
  DepletionAverage found;
  // Beyond both circumspheres, measured from the origins, everything is apart.
  const double reach = (a.body.reach() + b.body.reach()) * (1.0 + 0x1p-40);
  const auto run = [&](DepletionIntegrand::What what) {
    const auto make = [&, what] {
      return std::make_unique<DepletionIntegrand>(a.body, b.body, ball, distance, law, what);
    };
    return mean_of(a, b, settings, make()->scale(), make);
  };
  found.free_share = distance > reach ? certain(1.0) : run(DepletionIntegrand::What::freedom);
  if (!(found.free_share.value > 0.0)) return found;  // no orientation was free, or none was drawn
  const bool are_shells_apart = distance > reach + 2.0 * settings.ball_radius * (1.0 + 0x1p-40);
  if (!are_shells_apart) found.overlap_volume = run(DepletionIntegrand::What::overlap_volume);
  return found;
}

}  // namespace vex
