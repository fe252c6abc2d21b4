// The contenders of one pair, after their rounds.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "tests/bench/bench_pairs.h"

namespace vex {

inline constexpr const char* kTrial = "trial";
inline constexpr const char* kTrialWithoutQuick = "trial without quick verdicts";
inline constexpr const char* kQuery = "query";
inline constexpr const char* kOneAtATime = "one at a time";

struct PeerEntry {
  BackendKind kind;
  /// It is asked about as many poses as it answers in so many seconds.
  double most_seconds = std::numeric_limits<double>::infinity();
};

struct PairResult {
  BenchPair pair;
  std::size_t n_poses = 0, n_hits = 0;
  Tally tally;                     // of the whole trials
  std::vector<std::string> names;  // in the order of their turns
  std::map<std::string, Timing> timings;
  std::map<std::string, Differences> against;  // of peers

  const Timing* find(const std::string& name) const;
  const Timing& of(const std::string& name) const { return timings.at(name); }
  double ratio_of(const std::string& name, const std::string& base = kTrial) const { return ratio(of(name), of(base)); }
  /// A dash where there is no such contender.
  std::string timing_cell(const std::string& name) const;
  std::string differences_cell(const std::string& name) const;
  /// Of these, null where none took part.
  const std::string* fastest(const std::vector<std::string>& of_names) const;

  nlohmann::ordered_json json() const;
};

BackendKind renamed(BackendKind kind, const char* name);

/// Poses that are stored for the pair.
std::size_t n_poses_of(const BenchPair& pair, const BenchSettings& settings);

/// The whole trials, then the engine's queries, the first of which proves what peers are held against, then the peers
/// that take the pair.
PairResult run_pair(const BenchPair& pair, const BenchSettings& settings, const std::vector<Contender>& trials,
                    const std::vector<BackendKind>& engine_kinds, const std::vector<PeerEntry>& peers);

/// For the head of a table of such results.
extern const char* const kHowTimed;

}  // namespace vex
