// What the threads of a run have in common, and each thread's runner made from it.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "engine/query/packets/quick_verdict.h"
#include "engine/sampling/trial_runner.h"

namespace vex {

class RunnerFactory {
 public:
  /// All of it must outlive the runners. Throws UsageError where an integrand is none.
  RunnerFactory(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings);

  /// For the thread that calls; any thread may.
  std::unique_ptr<TrialRunner> make();

  /// Blocks begin at multiples of it.
  std::uint64_t grain() const;

 private:
  const ConvexBody& a_;
  const ConvexBody& b_;
  const MonteCarloSettings& settings_;
  std::optional<QuickVerdict> quick_;  // where the run uses it
  double reference_ = 0.0;             // of an integrand: made once, before the threads
  std::mutex mutex_;
  std::unique_ptr<Integrand> first_integrand_;  // which the reference is of: for the thread that comes first
};

}  // namespace vex
