// The parts of vex_scene_bench.
#pragma once

#include <cstddef>

#include "tests/bench/bench_report.h"

namespace vex {

struct ScenePartSettings {
  double share = 1.0;  // of the numbers of bodies
  int n_rounds = 5;
  int n_threads = 2;

  std::size_t bodies(double n) const {
    const double some = n * share;
    return some < 30.0 ? 30 : static_cast<std::size_t>(some);
  }
};

/// 10^6 cubes: from nothing, with poses given, each instruction set, two threads, each broad phase, beside a plain
/// grid.
BenchReport cubes_part(const ScenePartSettings& settings);
/// 10^4 to 10^7 cubes.
BenchReport growth_part(const ScenePartSettings& settings);
/// 10^6 needles, and 10^5 cubes of sizes 1:1000: grid, tree, the choice, and the plain grid.
BenchReport thin_and_unlike_part(const ScenePartSettings& settings);
/// What a body and a pair of boxes cost in the grid and in the tree.
BenchReport prices_part(const ScenePartSettings& settings);
/// FCL's DynamicAABBTreeCollisionManager.
BenchReport fcl_part(const ScenePartSettings& settings);
/// 10^5 hulls that move by a hundredth of their diameter a step.
BenchReport motion_part(const ScenePartSettings& settings);
/// Moves of a hard-particle Monte Carlo simulation.
BenchReport trial_moves_part(const ScenePartSettings& settings);

}  // namespace vex
