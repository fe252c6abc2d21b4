// What every backend answers on a stratum, and how often it was wrong.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/vex_stress/strata.h"
#include "engine/query/overlap_backend.h"

namespace vex {

/// How far from contact, relative to R_A + R_B, curved bodies of aspect ratios up to 1e6 may still be undecided.
inline constexpr double kUndecidedBand = 1e-14;

/// A pose to look at, and what makes it again: `vex_stress --stratum NAME --seed SEED`, pose number `index`.
struct StressExample {
  std::uint64_t index = 0;
  std::string pair;
  Transformd a_from_b;
};

/// Of one backend.
struct StressCounts {
  std::uint64_t n_pairs = 0;                   // poses that it was asked about
  std::uint64_t n_missed = 0, n_invented = 0;  // said disjoint, or overlap, where the referee proved the other
  std::uint64_t n_undecided = 0;
  std::uint64_t n_capped = 0;     // undecided because a search was given up
  std::uint64_t n_escalated = 0;  // answered by more than double precision, or not at all
  std::uint64_t n_beyond_band =
      0;                          // undecided where it must not be: any polytope, rounded or not; farther than the band
  std::uint64_t n_unproven = 0;   // of the engine: decided, but the checker does not accept the certificate
  double widest_undecided = 0.0;  // the largest gap or depth, relative to R_A + R_B
  double slowest_us = 0.0;        // the slowest single query
  std::optional<StressExample> first_wrong{}, first_beyond_band{},
      first_unproven{};  // of the smallest index of a stratum

  std::uint64_t n_wrong() const { return n_missed + n_invented; }
  /// What the engine must not do.
  std::uint64_t n_faults() const { return n_wrong() + n_unproven + n_beyond_band + n_capped; }
  /// The other's counts as well; examples stay those of the first stratum that has one.
  void add(const StressCounts& other);
};

struct StressRow {
  std::string name, bodies;
  std::optional<double> distance;
  std::uint64_t n_pairs = 0, n_overlaps = 0, n_unjudged = 0;
  std::vector<StressCounts> counts;  // in the order of the backends
  bool complete = false;
};

/// Everything that a measurement needs besides the stratum.
struct StressSettings {
  std::uint64_t seed = 1, n_pairs = 0;
  int n_threads = 1;
  std::vector<BackendKind> backends;  // the engine's is named "gjk"
  const std::atomic<int>* interrupt = nullptr;
  std::function<void(std::uint64_t)> on_progress = {};  // poses done of this stratum; on the calling thread
};

/// The counts are the same for any number of threads; the times are not.
StressRow measure(const Stratum& stratum, const StressSettings& settings);

}  // namespace vex
