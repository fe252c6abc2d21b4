// Ways of finding the pairs of a scene that take turns, and a table of their times.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/scene/scene_pair.h"
#include "tests/bench/bench_report.h"

namespace vex {

struct SceneLap {
  std::string name;
  std::function<std::size_t()> turn;  // tells how many pairs it has found
};

struct SceneLapTimes {
  std::string name;
  std::size_t n_pairs = 0;
  std::vector<double> processor_s, wall_s;

  double processor() const;  // medians
  double wall() const;
};

/// One turn of each that does not count, then the rounds, each beginning with the next lap. What takes longer than
/// `patience_s` has one turn alone, which counts.
std::vector<SceneLapTimes> take_laps(const std::vector<SceneLap>& laps, int n_rounds, double patience_s = 20.0);

/// Seconds of processor and wall clock, nanoseconds a body, pairs, and times what the first one takes.
std::string lap_table(const std::vector<SceneLapTimes>& times, std::size_t n_bodies);
nlohmann::ordered_json lap_json(const std::vector<SceneLapTimes>& times, std::size_t n_bodies);

/// The stages that have seen a pair: "balls 17 300 000 -> 2 660 000, ...".
std::string counts_line(const SceneCounts& counts);

}  // namespace vex
