#include "tests/bench/scene_laps.h"

#include <algorithm>

#include "tests/bench/rounds.h"

namespace vex {
namespace {

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

}  // namespace

double SceneLapTimes::processor() const { return median(processor_s); }
double SceneLapTimes::wall() const { return median(wall_s); }

std::vector<SceneLapTimes> take_laps(const std::vector<SceneLap>& laps, int n_rounds, double patience_s) {
  std::vector<SceneLapTimes> times(laps.size());
  std::vector<bool> is_slow(laps.size());
  const auto turn = [&](std::size_t k) {
    const double processor = processor_ns(), wall = wall_ns();
    times[k].n_pairs = laps[k].turn();
    times[k].processor_s.push_back(1e-9 * (processor_ns() - processor));
    times[k].wall_s.push_back(1e-9 * (wall_ns() - wall));
  };
  for (std::size_t k = 0; k < laps.size(); ++k) {
    times[k].name = laps[k].name;
    turn(k);
    is_slow[k] = times[k].processor_s.back() > patience_s;
    if (is_slow[k]) continue;
    times[k].processor_s.clear();
    times[k].wall_s.clear();
  }
  for (std::size_t round = 0; round < static_cast<std::size_t>(n_rounds); ++round) {
    for (std::size_t k = 0; k < laps.size(); ++k) {
      const std::size_t which = (round + k) % laps.size();
      if (!is_slow[which]) turn(which);
    }
  }
  return times;
}

std::string lap_table(const std::vector<SceneLapTimes>& times, std::size_t n_bodies) {
  MarkdownTable table({"", "processor s", "wall s", "ns a body", "pairs", "times the first"});
  for (const SceneLapTimes& one : times) {
    table.add({one.name, three_digits(one.processor()), three_digits(one.wall()),
               three_digits(1e9 * one.processor() / static_cast<double>(n_bodies)), grouped(one.n_pairs),
               three_digits(one.processor() / times.front().processor())});
  }
  return table.text();
}

nlohmann::ordered_json lap_json(const std::vector<SceneLapTimes>& times, std::size_t n_bodies) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const SceneLapTimes& one : times) {
    rows.push_back({{"name", one.name},
                    {"bodies", n_bodies},
                    {"pairs", one.n_pairs},
                    {"processor_s", one.processor()},
                    {"wall_s", one.wall()},
                    {"all_processor_s", one.processor_s},
                    {"all_wall_s", one.wall_s}});
  }
  return rows;
}

std::string counts_line(const SceneCounts& counts) {
  std::string line;
  for (int k = 0; k < kNSceneStages; ++k) {
    const SceneStage stage = static_cast<SceneStage>(k);
    if (counts[stage].seen == 0) continue;
    line += (line.empty() ? "" : ", ") + std::string(name_of(stage)) + " " + grouped(counts[stage].seen) +
            " (settles " + grouped(counts[stage].settled) + ")";
  }
  return "Stages: " + line + ".\n";
}

}  // namespace vex
