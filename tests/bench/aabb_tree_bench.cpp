// What a tree of boxes costs: to build it, to fit it to boxes that moved, to find all pairs that meet. One command:
// build/release/bin/vex_aabb_tree_bench [threads]. Milliseconds, the least of five rounds: with one thread of processor
// time, because on a machine that is shared the wall clock tells of others; with more of wall time.
#include <time.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "engine/scene/aabb_tree.h"
#include "engine/scene/threads.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

constexpr int kRounds = 5;

double milliseconds(int n_threads) {
  if (n_threads > 1) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

// Of a box with these edges in a random rotation, anywhere in a cube.
Aabb random_bounds(std::mt19937_64& random, const Vec3d& edges, double cube) {
  const Transformd pose = random_rotation(random);
  const auto half = [&](const Vec3d& row) {
    return 0.5 * (std::fabs(row.x) * edges.x + std::fabs(row.y) * edges.y + std::fabs(row.z) * edges.z);
  };
  const Vec3d extents{half(pose.row_x), half(pose.row_y), half(pose.row_z)};
  const auto place = [&] { return cube * random_in_unit_interval(random); };
  const Vec3d middle{place(), place(), place()};
  return {middle - extents, middle + extents};
}

struct Crowd {
  std::string name;
  std::vector<Aabb> boxes;
};

Crowd needles(std::mt19937_64& random) {
  Crowd crowd{"1e6 needles 1x1x50", {}};
  for (int k = 0; k < 1000000; ++k) crowd.boxes.push_back(random_bounds(random, {1, 1, 50}, 1344.0));
  return crowd;
}

Crowd cubes(std::mt19937_64& random) {
  Crowd crowd{"1e6 cubes, volume fraction .2444", {}};
  for (int k = 0; k < 1000000; ++k) crowd.boxes.push_back(random_bounds(random, {1, 1, 1}, std::cbrt(1e6 / 0.2444)));
  return crowd;
}

// Edges between 1 and 1000: log-uniform, or many small ones (a power law).
Crowd unlike_cubes(std::mt19937_64& random, bool log_uniform) {
  Crowd crowd{log_uniform ? "1e5 cubes 1:1000, log-uniform" : "1e5 cubes 1:1000, power law -3", {}};
  std::vector<double> edges;
  double volume = 0.0;
  for (int k = 0; k < 100000; ++k) {
    const double u = random_in_unit_interval(random);
    edges.push_back(log_uniform ? std::pow(1000.0, u) : 1.0 / std::sqrt(1.0 - u * (1.0 - 1e-6)));
    volume += edges.back() * edges.back() * edges.back();
  }
  for (const double e : edges) crowd.boxes.push_back(random_bounds(random, {e, e, e}, std::cbrt(volume / 0.2444)));
  return crowd;
}

std::size_t n_pairs(const AabbTree& tree, int n_threads) {
  const Vec3d no_shift{};
  std::vector<AabbTree::PairTask> tasks;
  tree.pair_tasks({&no_shift, 1}, n_threads > 1 ? 64 * static_cast<std::size_t>(n_threads) : 1, tasks);
  std::atomic<std::size_t> n{0};
  share_parts(n_threads, tasks.size(), [&](std::size_t k) {
    std::size_t n_here = 0, mixed = 0;
    tree.pairs(tasks[k], no_shift, [&](std::uint32_t i, std::uint32_t j) {
      ++n_here;
      mixed ^= i * std::size_t{7} + j;  // so that the numbers are looked at
    });
    n += n_here + (mixed == ~std::size_t{0} ? 1 : 0);
  });
  return n;
}

void measure(const Crowd& crowd, int n_threads) {
  AabbTree tree;
  double build = HUGE_VAL, refit = HUGE_VAL, pairs = HUGE_VAL;
  std::size_t n = 0;
  for (int round = 0; round < kRounds; ++round) {
    const double start = milliseconds(n_threads);
    tree.build(crowd.boxes, n_threads);
    const double built = milliseconds(n_threads);
    tree.refit(crowd.boxes, n_threads);
    const double fitted = milliseconds(n_threads);
    n = n_pairs(tree, n_threads);
    pairs = std::min(pairs, milliseconds(n_threads) - fitted);
    refit = std::min(refit, fitted - built);
    build = std::min(build, built - start);
  }
  std::printf("| %s | %.1f | %.1f | %.1f | %zu | %.2f |\n", crowd.name.c_str(), build, refit, pairs, n,
              2.0 * static_cast<double>(n) / static_cast<double>(crowd.boxes.size()));
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  const int n_threads = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 1;
  std::printf("%d thread(s)\n\n| boxes | build, ms | refit, ms | pairs, ms | pairs | meeting a box |\n", n_threads);
  std::printf("|---|---|---|---|---|---|\n");
  std::mt19937_64 random(1);
  vex::measure(vex::needles(random), n_threads);
  vex::measure(vex::unlike_cubes(random, true), n_threads);
  vex::measure(vex::unlike_cubes(random, false), n_threads);
  vex::measure(vex::cubes(random), n_threads);
}
