// Queries of all pairs keep their memory: once a scene has answered, the same query of one thread allocates nothing.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>
#include <random>

#include "engine/scene/scene.h"
#include "shapes/box.h"
#include "tests/referees/random_poses.h"

namespace {

std::atomic<std::uint64_t> n_allocations{0};

}  // namespace

// Not inlined: a compiler that sees only one of them through takes them for a mismatched pair.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++n_allocations;
  if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++n_allocations;
  return std::malloc(size == 0 ? 1 : size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace vex {
namespace {

template <class Query>
std::uint64_t allocations_of(const Query& query) {
  for (int k = 0; k < 3; ++k) query();
  const std::uint64_t before = n_allocations;
  query();
  return n_allocations - before;
}

TEST(SceneAllocations, QueriesOfAllPairsAllocateNothingInSteadyState) {
  constexpr std::size_t kBodies = 3000;
  const double edge = std::cbrt(kBodies / 0.2444);
  std::mt19937_64 random(1);
  std::vector<Pose> poses;
  for (std::size_t k = 0; k < kBodies; ++k) {
    Transformd pose = random_rotation(random);
    for (double* x : {&pose.translation.x, &pose.translation.y, &pose.translation.z}) {
      *x = edge * (random_in_unit_interval(random) - 0.5);
    }
    poses.emplace_back(pose);
  }
  for (const bool is_periodic : {false, true}) {
    for (const BroadPhase phase : {BroadPhase::automatic, BroadPhase::grid, BroadPhase::tree}) {
      SceneSettings settings{.broad_phase = phase, .n_threads = 1, .skin = 0.0};
      Scene scene = is_periodic ? Scene(PeriodicBox::cube(edge), settings) : Scene(settings);
      const ShapeId cube = scene.add_shape(Box(1.0, 1.0, 1.0));
      for (const Pose& pose : poses) scene.add(cube, pose);
      ScenePairs found;
      SceneDistances distances;
      Clusters clusters;
      EXPECT_EQ(allocations_of([&] { scene.overlapping_pairs(found); }), 0u);
      ASSERT_GT(found.pairs.size(), kBodies / 2);
      EXPECT_EQ(allocations_of([&] { scene.move_all(poses), scene.overlapping_pairs(found); }), 0u);
      EXPECT_EQ(allocations_of([&] { scene.pairs_within(0.1, found); }), 0u);
      EXPECT_EQ(allocations_of([&] { scene.distances_within(0.1, distances); }), 0u);
      EXPECT_EQ(allocations_of([&] { scene.any_overlap(); }), 0u);
      EXPECT_EQ(allocations_of([&] { scene.clusters(clusters); }), 0u);
      EXPECT_EQ(allocations_of([&] { scene.overlaps_of(7, found); }), 0u);
      EXPECT_EQ(allocations_of([&] { scene.would_overlap(7, poses[8]); }), 0u);
      EXPECT_EQ(allocations_of([&] {
                  scene.clear();
                  clusters.reset(0);
                  while (scene.end() < kBodies) {
                    const BodyId first = scene.end();
                    for (std::size_t k = first; k < std::min<std::size_t>(first + 100, kBodies); ++k) {
                      scene.add(cube, poses[k]);
                      clusters.add();
                    }
                    scene.overlaps_of_added(first, found, &clusters);
                  }
                }),
                0u);
      settings.skin = 0.2;
      scene.set(settings);
      EXPECT_EQ(allocations_of([&] { scene.move_all(poses), scene.overlapping_pairs(found); }), 0u);
    }
  }
}

}  // namespace
}  // namespace vex
