// What trials brought home, and a run as far as it came: what it takes to go on from there, or to add it to others.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "engine/numeric/transform.h"
#include "engine/query/verdict.h"
#include "engine/sampling/domain.h"
#include "engine/sampling/tally.h"

namespace vex {

/// Two backends decided one pose differently.
struct Disagreement {
  std::uint64_t index = 0;  // of the trial
  Transformd a_from_b;
  std::vector<Outcome> outcomes;  // of the run's backend, then of those it was checked against
};

/// A verdict that could not be proven again.
struct UnprovenTrial {
  std::uint64_t index = 0;
  Transformd a_from_b;
  Outcome outcome = Outcome::undecided;
  std::string fault;
};

struct UndecidedTrial {
  std::uint64_t index = 0;
  UndecidedReason reason = UndecidedReason::none;
};

/// The first of a list that may be long, in the order of the trials, and how many there were.
template <class T>
struct FirstOf {
  static constexpr std::size_t kKept = 1000;
  std::vector<T> kept;
  std::uint64_t n_all = 0;

  void keep_first() {
    std::sort(kept.begin(), kept.end(), [](const T& x, const T& y) { return x.index < y.index; });
    if (kept.size() > kKept) kept.resize(kKept);
  }
  FirstOf& operator+=(FirstOf&& more) {
    n_all += more.n_all;
    kept.insert(kept.end(), std::make_move_iterator(more.kept.begin()), std::make_move_iterator(more.kept.end()));
    if (kept.size() > 2 * kKept) keep_first();
    more = {};
    return *this;
  }
};

/// Of consecutive trials. Records of disjoint blocks add to the same bits in any order, but that lists of trials must
/// be put in their order (`keep_first`).
struct BlockRecord {
  Tally tally;
  FirstOf<UndecidedTrial> undecided;
  FirstOf<Disagreement> disagreements;
  std::vector<Comparison> comparisons;  // with each backend of `MonteCarloSettings::cross_check`
  std::uint64_t n_proven_again = 0;     // of a verified run; with `unproven` and the undecided, all trials
  FirstOf<UnprovenTrial> unproven;

  BlockRecord& operator+=(BlockRecord&& more);
  void keep_first() {
    undecided.keep_first();
    disagreements.keep_first();
    unproven.keep_first();
  }
};

/// A run as far as it came.
struct RunState {
  std::uint64_t first_trial = 0;
  BlockRecord done;  // of the trials first_trial ... end() - 1; its lists in order
  Domain::Kind domain = Domain::Kind::ball;
  double domain_volume = 0.0;  // length^3; 0 of a run without one
  double seconds = 0.0;        // that it took

  std::uint64_t end() const { return first_trial + done.tally.n_trials; }

  /// The trials that follow these. Throws InputError where `next` does not begin where this one ends, or is of a run
  /// that counts in another way.
  void append(RunState&& next);
};

}  // namespace vex
