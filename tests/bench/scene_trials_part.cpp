#include <cmath>
#include <random>

#include "engine/scene/scene.h"
#include "shapes/box.h"
#include "tests/bench/rounds.h"
#include "tests/bench/scene_laps.h"
#include "tests/bench/scene_parts.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

constexpr double kEta = 0.5;
constexpr double kStep = 0.1, kTurn = 0.1;  // of an edge, and radians, at most, along and about each axis

Transformd turned_and_moved(const Transformd& from, std::mt19937_64& random) {
  const auto uniform = [&] { return 2.0 * random_in_unit_interval(random) - 1.0; };
  // A quaternion near 1.
  const double x = 0.5 * kTurn * uniform(), y = 0.5 * kTurn * uniform(), z = 0.5 * kTurn * uniform();
  const double s = 2.0 / (1.0 + x * x + y * y + z * z);
  const Vec3d rows[3] = {{1.0 - s * (y * y + z * z), s * (x * y - z), s * (x * z + y)},
                         {s * (x * y + z), 1.0 - s * (x * x + z * z), s * (y * z - x)},
                         {s * (x * z - y), s * (y * z + x), 1.0 - s * (x * x + y * y)}};
  const auto row = [&](const Vec3d& r) { return (r.x * from.row_x + r.y * from.row_y) + r.z * from.row_z; };
  return {row(rows[0]), row(rows[1]), row(rows[2]),
          from.translation + Vec3d{kStep * uniform(), kStep * uniform(), kStep * uniform()}};
}

struct Simulation {
  explicit Simulation(int n) : scene(PeriodicBox::cube(n / std::cbrt(kEta)), {.skin = 0.0}) {
    const double spacing = 1.0 / std::cbrt(kEta);
    const ShapeId cube = scene.add_shape(Box(1.0, 1.0, 1.0));
    for (int k = 0; k < n * n * n; ++k) {
      Transformd pose;
      pose.translation = {spacing * (k % n + 0.5 - 0.5 * n), spacing * (k / n % n + 0.5 - 0.5 * n),
                          spacing * (k / n / n + 0.5 - 0.5 * n)};
      poses.push_back(pose);
      scene.add(cube, pose);
    }
  }
  // So many trial moves; how many were taken.
  std::size_t run(std::size_t n_trials) {
    std::size_t n_moved = 0;
    for (std::size_t k = 0; k < n_trials; ++k) {
      const BodyId body = static_cast<BodyId>(random() % poses.size());
      const Transformd trial = turned_and_moved(poses[body], random);
      const Pose pose = Pose::unchecked(trial);
      if (scene.would_overlap(body, pose) != Outcome::disjoint) continue;
      scene.move(body, pose);
      poses[body] = trial;
      ++n_moved;
    }
    return n_moved;
  }

  Scene scene;
  std::vector<Transformd> poses;
  std::mt19937_64 random{4};
};

}  // namespace

BenchReport trial_moves_part(const ScenePartSettings& settings) {
  BenchReport report;
  report.rows = nlohmann::ordered_json::array();
  MarkdownTable table(
      {"cubes", "trial moves a second and core", "ns a move", "accepted", "overlapping pairs at the end"});
  for (const int n : {16, 46}) {
    Simulation simulation(settings.share < 0.1 ? 4 : n);
    const std::size_t n_bodies = simulation.poses.size();
    const std::size_t n_warm = settings.share < 0.1 ? 10 * n_bodies : (n == 16 ? 100 : 20) * n_bodies;
    simulation.run(n_warm);
    const std::size_t n_trials = settings.bodies(500000);
    std::vector<double> ns;
    std::size_t n_moved = 0;
    for (int round = 0; round < settings.n_rounds; ++round) {
      const double start = processor_ns();
      n_moved += simulation.run(n_trials);
      ns.push_back((processor_ns() - start) / static_cast<double>(n_trials));
    }
    ScenePairs found;
    simulation.scene.overlapping_pairs(found);
    const double accepted = static_cast<double>(n_moved) / static_cast<double>(n_trials) / settings.n_rounds;
    const double each = Timing{ns}.median();
    table.add({grouped(n_bodies), grouped(static_cast<std::uint64_t>(1e9 / each)), three_digits(each),
               percent(accepted), grouped(found.pairs.size())});
    report.rows.push_back({{"bodies", n_bodies},
                           {"ns", each},
                           {"accepted", accepted},
                           {"overlapping", found.pairs.size()},
                           {"undecided", found.undecided.size()}});
  }
  report.markdown =
      "### Trial moves of hard cubes, eta .5\n\nFrom an aligned lattice, after 100 or 20 moves a cube; each move "
      "shifts "
      "a cube by at most .1 edges and turns it by at most .1 rad along and about each axis, and asks whether it would "
      "overlap any other; random numbers included.\n\n" +
      table.text();
  return report;
}

}  // namespace vex
