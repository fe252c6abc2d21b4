// Law: whatever a scene is asked, it answers as brute force does that asks `overlap` of every two bodies and every copy
// of them; for any bodies, box, broad phase, instruction set and number of threads. vex_scene_truth asks far more
// scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shapes/box.h"
#include "tests/referees/random_poses.h"
#include "tests/referees/scene_judge.h"

namespace vex {
namespace {

class RandomScenes : public testing::TestWithParam<SceneStratum> {};

TEST_P(RandomScenes, AnswerAsBruteForceDoes) {
  constexpr int kScenes = 40;
  std::mt19937_64 random(20 + static_cast<std::uint64_t>(GetParam()));
  std::uint64_t n_pairs = 0, n_asked = 0, n_open = 0, n_own = 0, n_repeated = 0;
  for (int k = 0; k < kScenes; ++k) {
    const RandomScene made = random_scene(GetParam(), random);
    Scene scene = made.scene();
    const EveryPair every = every_pair(scene);
    ASSERT_EQ(fault_of_scene(scene, made, every, random), "") << "scene " << k;
    n_pairs += every.pairs.size();
    n_asked += every.n_asked;
    n_own += every.n_own;
    n_repeated += every.n_repeated;
    n_open += made.box ? 0u : 1u;
  }
  // The sample is what it is meant to be.
  EXPECT_GT(n_pairs, 100u);
  EXPECT_GT(n_asked, n_pairs + n_pairs / 3);
  if (GetParam() == SceneStratum::crowded) {
    EXPECT_EQ(n_open, 0u);
    EXPECT_GT(n_own, 20u);
    EXPECT_GT(n_repeated, 50u);
  } else {
    EXPECT_GT(n_open, kScenes / 8u);
    EXPECT_LT(n_open, kScenes / 2u + 4u);
  }
}

INSTANTIATE_TEST_SUITE_P(Strata, RandomScenes, testing::ValuesIn(kSceneStrata),
                         [](const auto& tested) { return std::string(name_of(tested.param)); });

// Of one scene, everything in every way of finding it: what differs is at most which overlapping pair any_overlap
// tells.
class EverySetting : public testing::TestWithParam<bool> {};

TEST_P(EverySetting, GivesTheSameAnswers) {
  std::mt19937_64 random(5);
  RandomScene made = random_scene(SceneStratum::mixed, random);
  const std::vector<ConvexBody> kinds = made.bodies;
  made.box.reset();
  made.size = 16.0;
  if (GetParam()) made.box.emplace(16.0, 15.0, 17.0, 0.3, -0.2, 0.4);
  while (made.bodies.size() < 600) {
    made.bodies.push_back(kinds[random() % kinds.size()]);
    made.poses.push_back({});
  }
  for (Transformd& pose : made.poses) pose = random_place(made, random);
  constexpr double kMargin = 0.2;
  Scene plain = made.scene({});
  const EveryPair every = every_pair(plain), within = every_pair(plain, kMargin);
  ASSERT_GT(every.pairs.size(), 300u);
  ASSERT_GT(within.pairs.size(), every.pairs.size() + 100);
  Clusters clusters, clusters_again;
  plain.clusters(clusters);
  SceneDistances distances, distances_again;
  plain.distances_within(kMargin, distances);
  ScenePairs found;
  for (const BroadPhase phase : {BroadPhase::grid, BroadPhase::tree, BroadPhase::automatic}) {
    for (const InstructionSet set : instruction_sets()) {
      for (const int n_threads : {1, 2, 3, 8}) {
        Scene scene = made.scene({.broad_phase = phase, .n_threads = n_threads, .instruction_set = set, .skin = 0.0});
        const std::string how = std::string(name_of(set)) + ", " + std::to_string(n_threads) + " threads, phase " +
                                std::to_string(static_cast<int>(phase));
        ASSERT_EQ(fault_of_pairs(scene, every), "") << how;
        scene.pairs_within(kMargin, found);
        ASSERT_EQ(found.pairs, within.pairs) << how;
        ASSERT_EQ(found.undecided, within.undecided) << how;
        scene.clusters(clusters_again);
        ASSERT_EQ(clusters_again.labels(), clusters.labels()) << how;
        scene.distances_within(kMargin, distances_again);
        ASSERT_EQ(distances_again.entries.size(), distances.entries.size()) << how;
        for (std::size_t k = 0; k < distances.entries.size(); ++k) {
          const Separation &one = distances.entries[k].separation, &other = distances_again.entries[k].separation;
          ASSERT_EQ(distances_again.entries[k].pair, distances.entries[k].pair) << how;
          ASSERT_EQ(one.signed_distance, other.signed_distance) << how;
          ASSERT_EQ(one.lower, other.lower) << how;
          ASSERT_EQ(one.upper, other.upper) << how;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OpenAndPeriodic, EverySetting, testing::Bool(),
                         [](const auto& tested) { return std::string(tested.param ? "periodic" : "open"); });

// Many more bodies in a cell, or in a leaf's box, than a packet of pairs has room for.
TEST(ScenePairs, OfBodiesAllInOnePlaceAreAllFound) {
  std::mt19937_64 random(7);
  const ConvexBody body = displaced_hull(20, 0.5, {1.0, 2.0, 3.0}, random);
  constexpr std::size_t kBodies = 800;
  for (const bool is_periodic : {false, true}) {
    for (const BroadPhase phase : {BroadPhase::grid, BroadPhase::tree}) {
      const SceneSettings settings{.broad_phase = phase, .n_threads = 2, .skin = 0.0};
      Scene scene = is_periodic ? Scene(PeriodicBox::cube(4.0), settings) : Scene(settings);
      const ShapeId shape = scene.add_shape(body);
      for (std::size_t k = 0; k < kBodies; ++k) {
        Transformd pose = random_rotation(random);
        pose.translation = 1e-3 * random_direction(random) - pose(body.centre());
        scene.add(shape, pose);
      }
      ScenePairs found;
      scene.overlapping_pairs(found);
      EXPECT_EQ(found.pairs.size(), kBodies * (kBodies - 1) / 2);
      EXPECT_TRUE(std::ranges::is_sorted(found.pairs));
      EXPECT_EQ(std::ranges::adjacent_find(found.pairs), found.pairs.end());
    }
  }
}

// So many that bodies and pairs are sorted in several buckets, and that poses lie in huge pages.
TEST(ScenePairs, OfManyBodiesAreSortedWhateverTheThreads) {
  constexpr std::size_t kBodies = 60000;
  const double edge = std::cbrt(kBodies / 0.2444);
  std::mt19937_64 random(7);
  Scene scene(PeriodicBox::cube(edge), {.broad_phase = BroadPhase::tree});
  const ShapeId cube = scene.add_shape(Box(1.0, 1.0, 1.0));
  for (std::size_t k = 0; k < kBodies; ++k) {
    Transformd pose = random_rotation(random);
    for (double* x : {&pose.translation.x, &pose.translation.y, &pose.translation.z}) {
      *x = edge * (random_in_unit_interval(random) - 0.5);
    }
    scene.add(cube, pose);
  }
  for (BodyId body = 0; body < kBodies; body += 7) scene.remove(body);
  ScenePairs by_tree, found;
  scene.overlapping_pairs(by_tree);
  EXPECT_GT(by_tree.pairs.size(), kBodies / 2);
  EXPECT_TRUE(std::is_sorted(by_tree.pairs.begin(), by_tree.pairs.end()));
  for (const int n_threads : {1, 2, 3}) {
    scene.set({.broad_phase = BroadPhase::grid, .n_threads = n_threads});
    scene.overlapping_pairs(found);
    EXPECT_EQ(found.pairs, by_tree.pairs) << n_threads << " threads";
  }
  // What each body is told by itself, by another search and hardly sorted, is as much.
  std::size_t n = 0;
  for (BodyId body = 0; body < kBodies; ++body) {
    if (!scene.has(body)) continue;
    scene.overlaps_of(body, found);
    n += found.pairs.size();
  }
  EXPECT_EQ(n, 2 * by_tree.pairs.size());
}

}  // namespace
}  // namespace vex
