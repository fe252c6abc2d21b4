// What ideal balls that two hard bodies exclude do to them: the depletion attraction of S. Asakura and F. Oosawa (J.
// Chem. Phys. 22, 1255, 1954; J. Polym. Sci. 33, 183, 1958).
//
// The centre of a ball of radius r cannot be nearer than r to a body: not within its depletion shell, the body rounded
// by r. Where the shells of two bodies overlap, the balls have more room. With n such balls in a unit of volume of a
// reservoir the free energy of the pair at a pose is -n k T times the volume of that overlap, and infinite where the
// bodies themselves overlap. For one pair this is exact; other bodies near by change it where three shells overlap.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "engine/numeric/pose.h"
#include "engine/sampling/monte_carlo.h"
#include "engine/sampling/poses/orientation_law.h"
#include "shapes/body.h"

namespace vex {

struct DepletionSettings {
  double ball_radius = 0.0;  // of the depletant; above 0

  // When a run ends: whichever comes first; without any at `rel_error` = 1e-2.
  std::optional<double> rel_error{};  // std_error / overlap volume
  std::optional<std::uint64_t> trials{};
  std::optional<double> seconds{};
  std::uint64_t max_trials = 1'000'000'000;

  std::uint64_t seed = 1;
  int threads = 0;  // 0: one for each core. The result is the same for any number, unless `seconds` ends the run.
  const std::atomic<int>* interrupt = nullptr;
  std::function<void(const Progress&)> on_progress{};
};

/// A mean over points of space, or over orientations too.
struct DepletionValue {
  double value = 0.0;
  double std_error = 0.0;  // 0 only where nothing was left to chance; of shells that just touch a bound, without a run
  RunRecord record{};      // empty where nothing was run
  bool complete = true;
};

/// Of two bodies at one pose.
struct DepletionAtPose {
  /// Of the bodies themselves, proven or undecided.
  Outcome bodies = Outcome::disjoint;
  DepletionValue overlap_volume;  // of the shells, whether or not the bodies overlap; length^3
};

/// Over all directions from A's origin to B's and the orientations of a law.
struct DepletionAverage {
  DepletionValue free_share;      // of the orientations at which the bodies do not overlap
  DepletionValue overlap_volume;  // of the shells, where the bodies do not overlap and 0 where they do; length^3

  /// The mean over orientations at which the bodies do not overlap, and a bound of its standard error, which
  /// the errors of both runs add up to (twice as large as it is, in runs of cubes); NaN where there are none.
  double mean_of_free() const;
  double mean_of_free_error() const;
};

/// Points are drawn uniformly from a box around the overlap, and each is asked, by the engine's proven overlap query,
/// whether a ball of the depletant's radius about it touches both bodies. Throws UsageError where a setting is none.
DepletionAtPose depletion_at(const Body& a, const Body& b, const Pose& a_from_b, const DepletionSettings& settings);

/// B's origin at this distance from A's, in any direction; both means by runs of their own, with one seed.
DepletionAverage depletion_average(const Body& a, const Body& b, double distance, const OrientationLaw& law,
                                   const DepletionSettings& settings);

/// The overlap of two balls of these radii with their centres this far apart, to some 16 roundings.
double overlap_of_balls(double radius_1, double radius_2, double distance);

}  // namespace vex
