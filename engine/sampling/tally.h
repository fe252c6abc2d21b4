// What a run counts. Whole numbers only: the same for any number of threads.
#pragma once

#include <array>
#include <cstdint>

#include "engine/query/verdict.h"

namespace vex {

struct Tally {
  std::uint64_t n_trials = 0;
  std::uint64_t n_hits = 0;
  std::uint64_t n_undecided = 0;
  std::array<std::uint64_t, kNDecidedBy> n_decided_by{};  // by DecidedBy; undecided trials are in none of them

  std::uint64_t n_misses() const { return n_trials - n_hits - n_undecided; }

  void add(const Verdict& verdict) {
    ++n_trials;
    if (verdict.outcome == Outcome::undecided) {
      ++n_undecided;
    } else {
      ++n_decided_by[static_cast<std::size_t>(verdict.by)];
      if (verdict.outcome == Outcome::overlap) ++n_hits;
    }
  }

  Tally& operator+=(const Tally& other) {
    n_trials += other.n_trials;
    n_hits += other.n_hits;
    n_undecided += other.n_undecided;
    for (std::size_t k = 0; k < n_decided_by.size(); ++k) n_decided_by[k] += other.n_decided_by[k];
    return *this;
  }

  friend bool operator==(const Tally&, const Tally&) = default;
};

}  // namespace vex
