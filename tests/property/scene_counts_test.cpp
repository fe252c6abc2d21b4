// Nothing is computed that was not asked for: what the stages' counts, and a body that counts its support calls, say.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>

#include "engine/query/overlap.h"
#include "shapes/any_shape.h"
#include "tests/referees/random_poses.h"
#include "tests/referees/scene_judge.h"

namespace vex {
namespace {

using Stage = SceneStage;

std::uint64_t settled_by_all(const SceneCounts& counts) {
  std::uint64_t sum = 0;
  for (const SceneCounts::Stage& stage : counts.stages) sum += stage.settled;
  return sum;
}

// Bodies of one or several kinds in a cubic box.
RandomScene bodies_in_a_box(const std::vector<ConvexBody>& kinds, std::size_t n, double edge, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  RandomScene made;
  made.box.emplace(edge, edge, edge);
  made.size = edge;
  for (std::size_t k = 0; k < n; ++k) {
    made.bodies.push_back(kinds[k % kinds.size()]);
    Transformd pose = random_rotation(random);
    for (double* x : {&pose.translation.x, &pose.translation.y, &pose.translation.z}) {
      *x = edge * (random_in_unit_interval(random) - 0.5);
    }
    made.poses.push_back(pose);
  }
  return made;
}

const ConvexBody kCube = parse_shape("box:1,1,1");

TEST(SceneCounts, EachPairIsSettledByOneStageOrUndecided) {
  for (const SceneStratum stratum : kSceneStrata) {
    std::mt19937_64 random(31);
    for (int k = 0; k < 10; ++k) {
      const RandomScene made = random_scene(stratum, random);
      Scene scene = made.scene();
      ScenePairs found;
      scene.overlapping_pairs(found);
      EXPECT_EQ(settled_by_all(found.counts) + found.undecided.size(), found.counts[Stage::balls].seen);
      SceneSettings settings = made.settings;
      settings.skin = 0.1 * made.size;
      scene.set(settings);
      scene.overlapping_pairs(found);
      scene.overlapping_pairs(found);
      EXPECT_EQ(settled_by_all(found.counts) + found.undecided.size(), found.counts[Stage::unmoved].seen);
    }
  }
}

TEST(SceneCounts, NoPairIsSeenTwice) {
  constexpr std::size_t kBodies = 300;
  RandomScene made = bodies_in_a_box({kCube}, kBodies, 0.1, 1);
  made.box.reset();
  for (const BroadPhase phase : {BroadPhase::grid, BroadPhase::tree}) {
    for (const int n_threads : {1, 3}) {
      Scene scene = made.scene({.broad_phase = phase, .n_threads = n_threads, .skin = 0.0});
      ScenePairs found;
      scene.overlapping_pairs(found);
      EXPECT_EQ(found.counts[Stage::balls].seen, kBodies * (kBodies - 1) / 2);
    }
  }
}

// 10^6 cubes of the issue, a hundredth of them: what each stage has to do there.
TEST(SceneCounts, BoundsComeBeforePacketsAndPacketsBeforeTheRest) {
  const RandomScene made = bodies_in_a_box({kCube}, 10000, std::cbrt(10000 / 0.2444), 2);
  for (const BroadPhase phase : {BroadPhase::grid, BroadPhase::tree}) {
    Scene scene = made.scene({.broad_phase = phase, .skin = 0.0});
    ScenePairs found;
    scene.overlapping_pairs(found);
    const SceneCounts& counts = found.counts;
    EXPECT_LT(counts[Stage::balls].seen, 21u * 10000);
    const std::uint64_t met = counts[Stage::balls].seen - counts[Stage::balls].settled;
    EXPECT_EQ(counts[Stage::bounds].seen, met);
    EXPECT_GT(counts[Stage::bounds].settled, met / 5);
    if (best_instruction_set() != InstructionSet::scalar) {
      EXPECT_EQ(counts[Stage::packets].seen, met - counts[Stage::bounds].settled);
      EXPECT_LT(counts[Stage::scalar].seen, met / 1000);
    }
    EXPECT_EQ(counts[Stage::cylinders].seen, 0u);
    EXPECT_EQ(counts[Stage::exact].seen, 0u);
    EXPECT_EQ(counts[Stage::unmoved].seen, 0u);
    EXPECT_EQ(counts[Stage::joined].seen, 0u);
  }
}

TEST(SceneCounts, SpheresAreDecidedByTheirBallsAlone) {
  const RandomScene made = bodies_in_a_box({parse_shape("sphere:0.5"), parse_shape("sphere:0.3")}, 4000, 18.0, 3);
  Scene scene = made.scene({});
  ScenePairs found;
  scene.overlapping_pairs(found);
  ASSERT_GT(found.pairs.size(), 500u);
  for (const Stage stage : {Stage::cylinders, Stage::packets, Stage::scalar, Stage::double_double, Stage::exact}) {
    EXPECT_EQ(found.counts[stage].seen, 0u) << name_of(stage);
  }
}

TEST(SceneCounts, NeedlesAndPlatesArePartedByTheirCylinders) {
  for (const char* name : {"box:0.1,0.1,10", "box:4,4,0.04"}) {
    const RandomScene made = bodies_in_a_box({parse_shape(name)}, 2000, 25.0, 4);
    Scene scene = made.scene({});
    ScenePairs found;
    scene.overlapping_pairs(found);
    const SceneCounts::Stage& cylinders = found.counts[Stage::cylinders];
    EXPECT_GT(cylinders.seen, 1000u) << name;
    EXPECT_GT(cylinders.settled, cylinders.seen / 3) << name;
    EXPECT_LT(found.counts[Stage::packets].seen, cylinders.seen - cylinders.settled + 1) << name;
  }
}

// In one grid, of cells as large as the large bodies, each small one would be compared with all others, nearly 8000.
TEST(SceneCounts, SmallBodiesLookForEachOtherInSmallCells) {
  const ConvexBody large = parse_shape("sphere:1"), small = parse_shape("sphere:0.05");
  std::vector<ConvexBody> kinds(1000, small);
  kinds.front() = large;
  const RandomScene made = bodies_in_a_box(kinds, 8000, 4.0, 37);
  Scene scene = made.scene();
  ScenePairs found;
  std::uint64_t n_of_small = 0, n_of_large = 0;
  for (BodyId body = 0; body < scene.end(); ++body) {
    scene.overlaps_of(body, found);
    (body % kinds.size() == 0 ? n_of_large : n_of_small) += found.counts[Stage::balls].seen;
  }
  EXPECT_LT(n_of_small, 200 * 7992);
  EXPECT_GT(n_of_large, 8 * 500);
}

TEST(SceneCounts, AnyOverlapEndsAtTheFirst) {
  const RandomScene made = bodies_in_a_box({kCube}, 20000, std::cbrt(20000 / 0.2444), 5);
  for (const BroadPhase phase : {BroadPhase::grid, BroadPhase::tree}) {
    Scene scene = made.scene({.broad_phase = phase, .skin = 0.0});
    ScenePairs found;
    scene.overlapping_pairs(found);
    const SceneAnswer any = scene.any_overlap();
    EXPECT_EQ(any.outcome, Outcome::overlap);
    EXPECT_LT(any.counts[Stage::balls].seen, found.counts[Stage::balls].seen / 3);
  }
}

TEST(SceneCounts, ClustersDoNotTestWhatIsJoined) {
  // Far beyond the density at which all is one cluster.
  const RandomScene made = bodies_in_a_box({kCube}, 5000, std::cbrt(5000 / 1.5), 6);
  for (const int n_threads : {1, 2}) {
    Scene scene = made.scene({.n_threads = n_threads, .skin = 0.0});
    ScenePairs found;
    Clusters clusters;
    scene.overlapping_pairs(found);
    scene.clusters(clusters);
    const SceneCounts& counts = clusters.counts;
    EXPECT_EQ(clusters.n_clusters(), 1u);
    EXPECT_EQ(counts[Stage::balls].seen, found.counts[Stage::balls].seen);
    EXPECT_GT(counts[Stage::joined].settled, counts[Stage::joined].seen / 4);
    EXPECT_LT(5 * counts[Stage::packets].seen, 4 * found.counts[Stage::packets].seen);
    EXPECT_EQ(settled_by_all(counts) + clusters.undecided.size(), counts[Stage::balls].seen);
  }
}

TEST(SceneCounts, AtRestOnlyWhatNearlyTouchesIsLookedAtAgain) {
  const RandomScene made = bodies_in_a_box({kCube}, 5000, std::cbrt(5000 / 0.2444), 7);
  for (const int n_threads : {1, 2}) {
    Scene scene = made.scene({.n_threads = n_threads, .skin = 0.2});
    ScenePairs first, again;
    scene.overlapping_pairs(first);
    EXPECT_EQ(first.counts[Stage::unmoved].settled, 0u);
    scene.overlapping_pairs(again);
    EXPECT_EQ(again.pairs, first.pairs);
    EXPECT_EQ(again.counts[Stage::unmoved].seen, first.counts[Stage::unmoved].seen);
    EXPECT_EQ(again.counts[Stage::balls].settled, 0u);
    // Neither the circumscribed balls are apart nor the inscribed ones meet.
    std::uint64_t n_near = 0;
    for (BodyId a = 0; a < scene.end(); ++a) scene.overlaps_of(a, again), n_near += again.counts[Stage::bounds].seen;
    scene.overlapping_pairs(again);
    EXPECT_LE(again.counts[Stage::balls].seen, n_near / 2);
    EXPECT_EQ(again.counts[Stage::unmoved].seen,
              again.counts[Stage::unmoved].settled + again.counts[Stage::balls].seen);
  }
}

TEST(SceneCounts, MovedLittleWhatIsKnownHolds) {
  RandomScene made = bodies_in_a_box({kCube}, 5000, std::cbrt(5000 / 0.2444), 8);
  std::mt19937_64 random(9);
  Scene scene = made.scene({.skin = 0.3});
  ScenePairs found;
  scene.overlapping_pairs(found);
  scene.overlapping_pairs(found);
  const std::uint64_t at_rest = found.counts[Stage::unmoved].settled;
  for (int k = 0; k < 5; ++k) {
    for (Transformd& pose : made.poses) pose.translation = pose.translation + 0.005 * random_direction(random);
    scene.move_all(std::vector<Pose>(made.poses.begin(), made.poses.end()));
    scene.overlapping_pairs(found);
    EXPECT_GT(found.counts[Stage::unmoved].settled, at_rest / 2) << "step " << k;
  }
}

// A box that counts how often it is asked for a support point.
struct CountedBox {
  std::shared_ptr<std::atomic<std::uint64_t>> n_calls;

  Vec3d support(const Vec3d& d) const {
    ++*n_calls;
    return {d.x < 0 ? -0.5 : 0.5, d.y < 0 ? -0.5 : 0.5, d.z < 0 ? -0.5 : 0.5};
  }
  double support_error() const { return 0.0; }
  Vec3d centre() const { return {}; }
  double circumradius() const { return 0.8661; }
  double inradius() const { return 0.5; }
};

TEST(SceneCounts, ABooleanAsksForNoDistanceAndADistanceForNoDepth) {
  const CountedBox box{std::make_shared<std::atomic<std::uint64_t>>(0)};
  const RandomScene made = bodies_in_a_box({box}, 200, 9.0, 10);
  Scene scene = made.scene({.broad_phase = BroadPhase::grid, .skin = 0.0});
  const auto calls = [&](const auto& query) {
    query();  // makes what is made once
    const std::uint64_t before = *box.n_calls;
    query();
    return *box.n_calls - before;
  };
  ScenePairs found;
  SceneDistances distances;
  constexpr double kMargin = 0.3;
  const std::uint64_t of_overlap = calls([&] { every_pair(scene); });
  const std::uint64_t of_margin = calls([&] { every_pair(scene, kMargin); });
  const std::uint64_t of_pairs = calls([&] { scene.overlapping_pairs(found); });
  EXPECT_GT(found.pairs.size(), 30u);
  EXPECT_GT(of_pairs, 0u);
  EXPECT_LT(of_pairs, of_overlap);
  const std::uint64_t of_within = calls([&] { scene.pairs_within(kMargin, found); });
  EXPECT_LT(of_within, of_margin);
  const std::uint64_t of_distances = calls([&] { scene.distances_within(kMargin, distances); });
  EXPECT_GT(of_distances, of_within);
  // What overlaps has no distance, and no depth is looked for.
  for (const SceneDistances::Entry& entry : distances.entries) {
    const bool overlaps = entry.separation.verdict.outcome == Outcome::overlap;
    EXPECT_EQ(entry.separation.has_witnesses, !overlaps);
  }
  // Bodies that are far from each other are asked for nothing at all.
  Scene far_apart({.broad_phase = BroadPhase::grid, .skin = 0.0});
  const ShapeId shape = far_apart.add_shape(box);
  for (int k = 0; k < 100; ++k) {
    Transformd pose;
    pose.translation = {3.0 * k, 0.0, 0.0};
    far_apart.add(shape, pose);
  }
  EXPECT_EQ(calls([&] { far_apart.overlapping_pairs(found); }), 0u);
  EXPECT_TRUE(found.pairs.empty());
}

}  // namespace
}  // namespace vex
