// The Monte Carlo driver: one for every pair of bodies, every orientation law, every backend.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/query/overlap_backend.h"
#include "engine/sampling/domain.h"
#include "engine/sampling/estimate.h"
#include "engine/sampling/integrand.h"
#include "engine/sampling/points/trial_points.h"
#include "engine/sampling/poses/orientation_law.h"
#include "engine/sampling/ranks.h"
#include "engine/sampling/run_state.h"
#include "engine/sampling/stop_rule.h"
#include "engine/sampling/tally.h"

namespace vex {

/// What a run is doing, several times a second.
struct Progress {
  Tally tally;                  // of all blocks finished so far
  double relative_error = 0.0;  // infinite as long as there is no hit
  double seconds = 0.0;
  StopRule stop;  // of the run
};

/// More than any machine gains by.
inline constexpr int kMostThreads = 1024;

struct MonteCarloSettings {
  std::uint64_t seed = 1;
  int n_threads = 1;
  OrientationLaw law;
  /// What is averaged: one instance for each thread. Without it hits are counted, and the trials are poses.
  MakeIntegrand integrand;
  Sequence sequence = Sequence::random;
  StopRule stop;
  /// Of the kernels that draw points and poses; the backend has its own. Decides nothing but the time.
  InstructionSet instruction_set = best_instruction_set();

  // All that follows is of hit or miss alone.
  Domain domain;  // its kind is the estimator: hit-or-miss-fitted where it is fitted, otherwise hit-or-miss
  /// Positions between the ball of the inradii, which counts as it is, and the domain, a ball (ball_domain): in
  /// kClasses shells of equal volume, as many trials in each. With Sobol' points, which need no shells, between the
  /// balls.
  bool stratified = false;
  bool quick_verdicts = true;  // never before a peer
  BackendKind backend = gjk_backend();
  /// Answer the same poses again, for comparison; they do not change the tally.
  std::vector<BackendKind> cross_check;
  /// Prove every verdict again (`prove_again`): some hundred times the cost of a trial.
  bool verify = false;
  /// Becomes non-zero from outside, for example from a signal handler: the run ends within a block of each thread.
  const std::atomic<int>* interrupt = nullptr;
  /// Called on the calling thread.
  std::function<void(const Progress&)> on_progress;

  /// Trials first_trial, first_trial + 1, ...: of Sobol' points and strata a multiple of kClasses, of which each class
  /// then has as many. Other than 0 only where `stop.trials` alone ends the run: when an error is reached is a matter
  /// of all trials.
  std::uint64_t first_trial = 0;
  /// What a run with the same bodies and settings brought so far, and goes on from; its stop rule may have been another
  /// number of trials, or another time, which counts all seconds spent. Not owned; null: a new run.
  const RunState* resume = nullptr;
  /// Given the run as far as it came, every so many seconds and once more at the end. On the calling thread, while the
  /// others go on.
  std::function<void(const RunState&)> on_state;
  double seconds_between_states = 5.0;
  /// Other processes that take part, with the same bodies and settings but for threads: the result is that of one
  /// process. On a rank that does not lead nothing else is called, and the record is empty. Not owned; null: none.
  Ranks* ranks = nullptr;
};

struct RunRecord : BlockRecord {  // of the trials first_trial ... first_trial + n_trials - 1, also where interrupted
  std::uint64_t first_trial = 0;
  StopReason stopped_by = StopReason::trials;
  bool complete = false;
  double seconds = 0.0;  // those of the state that the run went on from among them
};

/// Makes trials first_trial, first_trial + 1, ... until the stop rule ends the run, and counts, or averages.
///
/// Hits, misses, undecided trials and sums depend on the bodies, seed, law, estimator and its settings, sequence,
/// backend and number of trials only, to the last bit; never on threads, on what was asked of the bodies before, or on
/// instruction sets. Which stage spoke (n_decided_by) may differ from set to set by trials within rounding of contact,
/// of which their searches leave different ones to the exact stages. A run that goes on from a state ends with what one
/// run without a break ends with (`seconds` excepted). Tables of directions that the run wants are made
/// before its first trial. Exceptions of a backend end the run and are thrown again here.
RunRecord run_monte_carlo(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings);

/// Throws UsageError where the numbers of threads or trials, the relative error or the time are none that a run can
/// have: what `run_monte_carlo` asks first, for those who may find that there is nothing to run.
void require_threads_and_stop_rule(const MonteCarloSettings& settings);

/// The ball within which B's centre always meets A: its share of the domain's volume, a little less than all of it.
double inner_share(const ConvexBody& a, const ConvexBody& b, const Domain& domain);

/// The pose of one trial of hit or miss, as the driver draws it: for replaying an undecided or disputed one.
Transformd trial_pose(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings,
                      std::uint64_t index);

/// Whether every trial hits by construction: of two balls (is_ball) in the ball of their radii; and where there is one
/// orientation and the fitted domain is all of A - B, as of two aligned boxes.
bool hits_by_construction(const ConvexBody& a, const ConvexBody& b, const OrientationLaw& law, const Domain& domain);

}  // namespace vex
