// One thread's part of a run: blocks of trials answered one way or the other, and what it brings home from each.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/query/packets/quick_verdict.h"
#include "engine/sampling/monte_carlo.h"
#include "engine/sampling/points/trial_points.h"

namespace vex {

/// Trials first, first + step, ..., n of them.
struct Trials {
  std::uint64_t first, step;
  std::size_t n;

  std::uint64_t index(std::size_t k) const { return first + k * step; }
  Trials part(std::size_t from, std::size_t most) const { return {index(from), step, std::min(most, n - from)}; }
};

/// Those of begin ... end - 1 that are of class k, begin being a multiple of the number of classes.
inline Trials trials_of_class(std::uint64_t k, std::uint64_t n_classes, std::uint64_t begin, std::uint64_t end) {
  const std::uint64_t first = begin + k;
  return {first, n_classes, first < end ? static_cast<std::size_t>((end - first - 1) / n_classes + 1) : 0};
}

class TrialRunner {
 public:
  virtual ~TrialRunner() = default;
  /// `begin` is a multiple of the number of classes.
  virtual BlockRecord run(std::uint64_t begin, std::uint64_t end) = 0;
};

/// The classes of a run before its first trial.
ClassTally empty_classes(const MonteCarloSettings& settings, std::uint64_t n_classes);

/// The value at one fixed point, from which all threads of a run count theirs: of values that hardly vary the sum of
/// squares would lose all digits.
double reference_value(Integrand& integrand);

/// Values of an integrand of the settings, less `reference`. The settings must outlive it, here and below.
std::unique_ptr<TrialRunner> make_averaging_runner(const MonteCarloSettings& settings,
                                                   std::unique_ptr<Integrand> integrand, double reference);

/// Hit or miss; `quick` of the pair, or none.
std::unique_ptr<TrialRunner> make_pose_runner(const ConvexBody& a, const ConvexBody& b,
                                              const MonteCarloSettings& settings, const QuickVerdict* quick);

/// What its poses are made of.
TrialPoints points_of_poses(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings);

}  // namespace vex
