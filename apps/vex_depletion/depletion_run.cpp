#include "apps/vex_depletion/depletion_run.h"

#include <chrono>
#include <cmath>
#include <numbers>

#include "apps/common/case_seed.h"
#include "apps/common/interrupt.h"
#include "apps/common/numbers.h"
#include "apps/common/progress_bar.h"
#include "engine/numeric/quaternion.h"
#include "engine/sampling/domain.h"

namespace vex {
namespace {

/// R of B: turned about the line from A to B by the angle, after its own rotation.
Transformd pose_of(const DepletionOptions& options, double distance, double degrees) {
  const SinCos<double> half = sincospi(std::fmod(std::fmod(degrees, 720.0) + 720.0, 720.0) / 360.0);
  const Vec3d& n = options.direction;
  const auto& [w, x, y, z] = options.rotation;
  const double s = half.sin, c = half.cos;
  // The product of the two quaternions.
  Transformd pose =
      rotation_from_quaternion(c * w - s * (n.x * x + n.y * y + n.z * z), c * x + s * (n.x * w + n.y * z - n.z * y),
                               c * y + s * (n.y * w + n.z * x - n.x * z), c * z + s * (n.z * w + n.x * y - n.y * x));
  pose.translation = {distance * n.x, distance * n.y, distance * n.z};
  return pose;
}

void add_record(DepletionCase& one, const DepletionValue& value) {
  one.trials += value.record.tally.n_trials;
  one.undecided += value.record.tally.n_undecided;
  if (one.complete) one.stopped_by = value.record.stopped_by;
  one.complete = one.complete && value.complete;
}

DepletionCase case_of(const DepletionRun& run, const std::string& distance, const std::string& angle,
                      const DepletionSettings& settings) {
  const DepletionOptions& options = run.options;
  DepletionCase one;
  one.distance = distance;
  one.seed = settings.seed;
  const double at = parse_number(distance, "--distance");
  if (options.law) {
    const DepletionAverage found = depletion_average(run.a.shape, run.b.shape, at, *options.law, settings);
    one.free_share = found.free_share.value;
    one.free_share_error = found.free_share.std_error;
    one.overlap_volume = found.mean_of_free();
    one.std_error = found.mean_of_free_error();
    add_record(one, found.free_share);
    add_record(one, found.overlap_volume);
  } else {
    one.angle = angle;
    const DepletionAtPose found =
        depletion_at(run.a.shape, run.b.shape, pose_of(options, at, parse_number(angle, "--angle")), settings);
    one.bodies = found.bodies;
    one.overlap_volume = found.overlap_volume.value;
    one.std_error = found.overlap_volume.std_error;
    add_record(one, found.overlap_volume);
  }
  const ConvexBody &a = run.a.shape.body, &b = run.b.shape.body;
  const auto is_at_origin = [](const Vec3d& centre) { return centre.x == 0.0 && centre.y == 0.0 && centre.z == 0.0; };
  if (is_ball(a) && is_ball(b) && is_at_origin(a.centre()) && is_at_origin(b.centre()) && one.free_share != 0.0) {
    one.exact = overlap_of_balls(a.circumradius() + settings.ball_radius, b.circumradius() + settings.ball_radius, at);
    if (one.std_error > 0.0 && std::isfinite(one.std_error)) one.z = (one.overlap_volume - one.exact) / one.std_error;
  }
  return one;
}

}  // namespace

double DepletionRun::potential(const DepletionCase& one) const {
  const std::optional<double> density = options.number_density();
  return density && one.bodies != Outcome::overlap ? -*density * one.overlap_volume : DepletionCase::kNone;
}

double DepletionRun::potential_error(const DepletionCase& one) const {
  const std::optional<double> density = options.number_density();
  return density && one.bodies != Outcome::overlap ? *density * one.std_error : DepletionCase::kNone;
}

void run_cases(DepletionRun& run) {
  const auto start = std::chrono::steady_clock::now();
  const DepletionOptions& options = run.options;
  DepletionSettings settings = options.settings;
  settings.interrupt = &interrupting_signal();
  const std::size_t n = options.distances.size() * options.angles.size();
  for (const std::string& distance : options.distances) {
    for (const std::string& angle : options.angles) {
      if (interrupting_signal() != 0) {
        run.complete = false;
        break;
      }
      ProgressBar bar(!options.quiet, std::to_string(run.cases.size() + 1) + "/" + std::to_string(n) + " ");
      settings.on_progress = [&bar](const Progress& progress) { bar.show(progress); };
      settings.seed = seed_of_text(options.seed, distance + "\n" + angle);
      const auto begin = std::chrono::steady_clock::now();
      DepletionCase one = case_of(run, distance, angle, settings);
      one.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      run.complete = run.complete && one.complete;
      run.cases.push_back(std::move(one));
    }
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace vex
