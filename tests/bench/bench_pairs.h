// Bodies, stored poses, and backends that are asked about them: what the modes of vex_trial_bench have in common.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/query/overlap_backend.h"
#include "engine/sampling/monte_carlo.h"
#include "tests/bench/bench_report.h"
#include "tests/bench/rounds.h"

namespace vex {

/// A body with itself.
struct BenchPair {
  std::string name;
  ConvexBody body;
  std::size_t n_poses;  // unless told otherwise
  double goal_ccd;      // what the faster of libccd's queries is to take beside a whole trial
  double goal_fcl;
};
/// The goal beside the same trial without quick verdicts.
inline constexpr double kGoalWithoutQuickVerdicts = 6.0;

/// Cube, ellipsoid 4:1:1, capsule, plate, hulls of 100 and of 10 000 points.
std::vector<BenchPair> bench_pairs();

/// Trials 0 ... n - 1 in the ball domain, on one thread.
MonteCarloSettings trial_settings(const ConvexBody& body, std::uint64_t seed, std::size_t n,
                                  InstructionSet set = best_instruction_set());

/// The poses of the same trials.
std::vector<Pose> stored_poses(const ConvexBody& body, std::uint64_t seed, std::size_t n);

/// A whole trial: random numbers, pose, quick verdicts, query, tally.
Contender trial_contender(std::string name, const ConvexBody& body, const MonteCarloSettings& settings);

/// A backend alone, on stored poses.
class StoredQuery {
 public:
  StoredQuery(const BackendKind& kind, const ConvexBody& body, const std::vector<Pose>& poses);
  /// Of the first n poses; `this` must outlive it.
  Contender contender(std::size_t n);
  const std::string& name() const { return name_; }
  const std::vector<Verdict>& verdicts() const { return verdicts_; }
  /// Poses that it answers in so many seconds, to go by the first of them: all, or a power of two from 64 up.
  std::size_t n_answered_in(double seconds);

 private:
  void answer(std::size_t n);

  std::string name_;
  const std::vector<Pose>& poses_;
  std::unique_ptr<OverlapBackend> backend_;
  std::vector<Verdict> verdicts_;
};

/// A peer's answers beside proven ones.
struct Differences {
  std::size_t n_compared = 0, n_missed = 0, n_invented = 0, n_given_up = 0;

  std::string text() const;  // missed + invented, and in brackets what was given up
  nlohmann::ordered_json json() const;
};
Differences differences(const std::vector<Verdict>& proven, const std::vector<Verdict>& other, std::size_t n);

std::size_t n_hits(const std::vector<Verdict>& verdicts);

/// 52.1 (3 %): median and spread.
std::string timing_text(const Timing& timing);

}  // namespace vex
