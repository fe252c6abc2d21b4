#include <random>

#include "tests/bench/rounds.h"
#include "tests/bench/scene_cases.h"
#include "tests/bench/scene_laps.h"
#include "tests/bench/scene_parts.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

constexpr int kSteps = 60;

struct StepTimes {
  std::vector<double> move_ns, query_ns;
  SceneCounts counts;  // of all steps
  std::size_t n_pairs = 0;
};

// The same motion for everyone: each body goes straight on, and does not turn.
std::vector<Vec3d> steps_of(const SceneCase& scene) {
  std::mt19937_64 random(3);
  std::vector<Vec3d> steps;
  for (std::size_t k = 0; k < scene.size(); ++k) {
    const Vec3d dir = random_direction(random);
    steps.push_back((0.01 / norm(dir)) * dir);
  }
  return steps;
}

// Where they are, as a simulation does it: poses that are all read from other memory at each step would be measured
// with it.
void move(std::vector<Pose>& poses, const std::vector<Vec3d>& steps) {
  for (std::size_t body = 0; body < poses.size(); ++body) {
    Transformd pose = poses[body].a_from_b();
    pose.translation = pose.translation + steps[body];
    poses[body] = Pose::unchecked(pose);
  }
}

StepTimes move_along(const SceneCase& scene, const std::vector<Vec3d>& steps, double skin, int n_threads) {
  Scene made = scene.scene({.n_threads = n_threads, .skin = skin});
  ScenePairs found;
  made.overlapping_pairs(found);
  std::vector<Pose> poses = scene.poses;
  StepTimes times;
  for (int k = 0; k < kSteps; ++k) {
    move(poses, steps);
    const double start = processor_ns();
    made.move_all(poses);
    const double moved = processor_ns();
    made.overlapping_pairs(found);
    times.query_ns.push_back(processor_ns() - moved);
    times.move_ns.push_back(moved - start);
    times.counts += found.counts;
  }
  times.n_pairs = found.pairs.size();
  return times;
}

double sum_ms(const std::vector<double>& ns) {
  double sum = 0.0;
  for (const double x : ns) sum += 1e-6 * x;
  return sum / static_cast<double>(ns.size());
}

}  // namespace

BenchReport motion_part(const ScenePartSettings& settings) {
  const SceneCase scene = hulls(settings.bodies(1e5));
  const std::vector<Vec3d> steps = steps_of(scene);
  std::vector<double> from_nothing;
  SceneCase now = scene;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(settings.n_rounds); ++k) {
    move(now.poses, steps);
    const double start = processor_ns();
    Scene made = now.scene({.skin = 0.0});
    ScenePairs found;
    made.overlapping_pairs(found);
    if (k > 0) from_nothing.push_back(processor_ns() - start);
  }
  const double whole = 1e-6 * Timing{from_nothing}.median();
  BenchReport report;
  report.rows = nlohmann::ordered_json::array();
  MarkdownTable table({"skin", "move_all, ms a step", "query, ms a step", "slowest query, ms",
                       "a step of a scene from nothing", "pairs"});
  std::string lines;
  for (const double skin : {0.0, 0.1, 0.2, 0.3}) {
    const StepTimes times = move_along(scene, steps, skin, 1);
    const double move = sum_ms(times.move_ns), query = sum_ms(times.query_ns);
    const double slowest = 1e-6 * *std::max_element(times.query_ns.begin(), times.query_ns.end());
    table.add({three_digits(skin), three_digits(move), three_digits(query), three_digits(slowest),
               percent((move + query) / whole), grouped(times.n_pairs)});
    lines +=
        "Skin " + three_digits(skin) + ", " + std::to_string(kSteps) + " steps. " + counts_line(times.counts) + "\n";
    report.rows.push_back({{"skin", skin},
                           {"move_ms", move},
                           {"query_ms", query},
                           {"slowest_query_ms", slowest},
                           {"from_nothing_ms", whole},
                           {"pairs", times.n_pairs}});
  }
  report.markdown = "### " + grouped(scene.size()) + " " + scene.name + ", moved by .01 diameters a step\n\n" +
                    "A scene from nothing (bodies added, pairs found) takes " + three_digits(whole) +
                    " ms. One thread, processor time, means of " + std::to_string(kSteps) +
                    " steps, those in which the list is made anew among "
                    "them.\n\n" +
                    table.text() + "\n" + lines;
  return report;
}

}  // namespace vex
