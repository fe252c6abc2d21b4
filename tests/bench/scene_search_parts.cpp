#include <memory>

#include "tests/bench/plain_grid.h"
#include "tests/bench/scene_cases.h"
#include "tests/bench/scene_laps.h"
#include "tests/bench/scene_parts.h"

namespace vex {
namespace {

struct Found {
  ScenePairs pairs;
  std::vector<std::uint64_t> plain;
};

// Poses given: bodies placed, index, stages, sorted list.
SceneLap with_poses(std::string name, const SceneCase& scene, const SceneSettings& settings, Found& found) {
  const auto made = std::make_shared<Scene>(scene.scene(settings));
  return {std::move(name), [made, &scene, &found] {
            made->move_all(scene.poses);
            made->overlapping_pairs(found.pairs);
            return found.pairs.pairs.size();
          }};
}

// All that there is made, too.
SceneLap from_nothing(std::string name, const SceneCase& scene, const SceneSettings& settings) {
  return {std::move(name), [&scene, settings] {
            Scene made = scene.scene(settings);
            ScenePairs pairs;
            made.overlapping_pairs(pairs);
            return pairs.pairs.size();
          }};
}

SceneLap by_plain_grid(const SceneCase& scene, Found& found) {
  const auto grid = std::make_shared<PlainGrid>(scene);
  return {"plain grid, unproven", [grid, &found] {
            grid->overlapping_pairs(found.plain);
            return found.plain.size();
          }};
}

SceneSettings with(BroadPhase phase, int n_threads = 1, InstructionSet set = best_instruction_set()) {
  return {.broad_phase = phase, .n_threads = n_threads, .instruction_set = set, .skin = 0.0};
}

BenchReport report_of(const std::string& title, const std::vector<SceneLapTimes>& times, std::size_t n,
                      const SceneCounts& counts) {
  BenchReport report;
  report.markdown = "### " + grouped(n) + " " + title + "\n\n" + lap_table(times, n) + "\n" + counts_line(counts);
  report.rows = lap_json(times, n);
  return report;
}

BenchReport phases_of(const SceneCase& scene, const ScenePartSettings& settings) {
  Found found;
  const std::vector<SceneLap> laps = {with_poses("automatic", scene, with(BroadPhase::automatic), found),
                                      with_poses("grid", scene, with(BroadPhase::grid), found),
                                      with_poses("tree", scene, with(BroadPhase::tree), found),
                                      with_poses("automatic, " + std::to_string(settings.n_threads) + " threads", scene,
                                                 with(BroadPhase::automatic, settings.n_threads), found),
                                      by_plain_grid(scene, found)};
  const std::vector<SceneLapTimes> times = take_laps(laps, settings.n_rounds);
  laps.front().turn();
  return report_of(scene.name + ", poses given", times, scene.size(), found.pairs.counts);
}

}  // namespace

BenchReport cubes_part(const ScenePartSettings& settings) {
  const SceneCase scene = cubes(settings.bodies(1e6));
  Found found;
  std::vector<SceneLap> laps = {with_poses("grid, poses given", scene, with(BroadPhase::grid), found)};
  const auto parts = std::make_shared<Scene>(scene.scene(with(BroadPhase::grid)));
  laps.push_back({"of that: poses placed", [parts, &scene] {
                    parts->move_all(scene.poses);
                    return std::size_t{0};
                  }});
  const auto indexed = std::make_shared<Scene>(scene.scene(with(BroadPhase::grid)));
  laps.push_back({"of that: all behind the index", [indexed, &found] {
                    indexed->overlapping_pairs(found.pairs);
                    return found.pairs.pairs.size();
                  }});
  for (const InstructionSet set : instruction_sets()) {
    if (set == best_instruction_set()) continue;
    laps.push_back(with_poses("the same, " + std::string(name_of(set)), scene, with(BroadPhase::grid, 1, set), found));
  }
  laps.push_back(with_poses("the same, " + std::to_string(settings.n_threads) + " threads", scene,
                            with(BroadPhase::grid, settings.n_threads), found));
  laps.push_back(with_poses("tree, poses given", scene, with(BroadPhase::tree), found));
  laps.push_back(from_nothing("automatic, from nothing", scene, with(BroadPhase::automatic)));
  laps.push_back(by_plain_grid(scene, found));
  const std::vector<SceneLapTimes> times = take_laps(laps, settings.n_rounds);
  laps.front().turn();
  return report_of(scene.name + ", eta .2444", times, scene.size(), found.pairs.counts);
}

BenchReport growth_part(const ScenePartSettings& settings) {
  BenchReport report;
  report.rows = nlohmann::ordered_json::array();
  MarkdownTable table({"cubes", "scene, processor s", "ns a body", "pairs", "plain grid, s", "times"});
  for (const double n : {1e4, 1e5, 1e6, 4e6, 1e7}) {
    const SceneCase scene = cubes(settings.bodies(n));
    Found found;
    std::vector<SceneLap> laps = {with_poses("grid, poses given", scene, with(BroadPhase::grid), found)};
    laps.push_back(by_plain_grid(scene, found));
    const std::vector<SceneLapTimes> times = take_laps(laps, n > 1e6 ? 1 : settings.n_rounds);
    table.add({grouped(scene.size()), three_digits(times[0].processor()),
               three_digits(1e9 * times[0].processor() / static_cast<double>(scene.size())), grouped(times[0].n_pairs),
               three_digits(times[1].processor()), three_digits(times[1].processor() / times[0].processor())});
    for (const auto& row : lap_json(times, scene.size())) report.rows.push_back(row);
  }
  report.markdown = "### Cubes at one density, more and more of them\n\n" + table.text();
  return report;
}

BenchReport thin_and_unlike_part(const ScenePartSettings& settings) {
  BenchReport report = phases_of(needles(settings.bodies(1e6)), settings);
  const BenchReport unlike = phases_of(unlike_cubes(settings.bodies(1e5)), settings);
  report.markdown += "\n" + unlike.markdown;
  for (const auto& row : unlike.rows) report.rows.push_back(row);
  return report;
}

}  // namespace vex
