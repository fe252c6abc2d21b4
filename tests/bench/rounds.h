// Contenders that take turns: in each round every one of them once, so that what disturbs a machine disturbs them all.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace vex {

struct Contender {
  std::string name;
  std::size_t n_trials = 0;  // of a turn
  std::function<void()> turn;
};

/// Nanoseconds a trial, of each round.
struct Timing {
  std::vector<double> ns;

  double median() const;
  double least() const;
  /// Between the quartiles, relative to the median.
  double spread() const;
};

/// Processor time of this process, all its threads: on a machine that is shared the wall clock tells of others.
double processor_ns();
double wall_ns();

/// The contenders' timings, in their order. One turn of each goes before the rounds and does not count: it fills caches
/// and makes what is made at first use. Each round begins with the next contender. A turn is repeated until it has
/// taken so many milliseconds: after another's a processor needs a while to be itself again.
std::vector<Timing> take_turns(const std::vector<Contender>& contenders, int n_rounds, double least_turn_ms);

/// How many times as long as `base`: the median over the rounds, each round's two turns beside each other.
double ratio(const Timing& timing, const Timing& base);

/// median_ns, least_ns, spread.
nlohmann::ordered_json timing_json(const Timing& timing);

}  // namespace vex
