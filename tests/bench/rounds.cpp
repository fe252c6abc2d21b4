#include "tests/bench/rounds.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <nlohmann/json.hpp>

namespace vex {
namespace {

// Between neighbours of the sorted values where it falls there.
double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace

double Timing::median() const { return quantile(ns, 0.5); }
double Timing::least() const { return quantile(ns, 0.0); }
double Timing::spread() const { return (quantile(ns, 0.75) - quantile(ns, 0.25)) / median(); }

double processor_ns() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

double wall_ns() {
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::vector<Timing> take_turns(const std::vector<Contender>& contenders, int n_rounds, double least_turn_ms) {
  for (const Contender& contender : contenders) contender.turn();
  std::vector<Timing> timings(contenders.size());
  for (std::size_t round = 0; round < static_cast<std::size_t>(n_rounds); ++round) {
    for (std::size_t k = 0; k < contenders.size(); ++k) {
      const std::size_t which = (round + k) % contenders.size();
      const double start = processor_ns();
      double taken = 0.0, n = 0.0;
      do {
        contenders[which].turn();
        n += static_cast<double>(contenders[which].n_trials);
        taken = processor_ns() - start;
      } while (taken < 1e6 * least_turn_ms);
      timings[which].ns.push_back(taken / n);
    }
  }
  return timings;
}

double ratio(const Timing& timing, const Timing& base) {
  std::vector<double> ratios;
  for (std::size_t round = 0; round < timing.ns.size(); ++round) ratios.push_back(timing.ns[round] / base.ns[round]);
  return quantile(std::move(ratios), 0.5);
}

nlohmann::ordered_json timing_json(const Timing& timing) {
  return {{"median_ns", timing.median()}, {"least_ns", timing.least()}, {"spread", timing.spread()}};
}

}  // namespace vex
