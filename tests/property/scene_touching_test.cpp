// Law: bodies that exactly touch are decided as `overlap` decides them, in open space and across the faces of a box.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/query/overlap.h"
#include "shapes/any_shape.h"
#include "tests/referees/scene_judge.h"

namespace vex {
namespace {

constexpr BroadPhase kPhases[] = {BroadPhase::grid, BroadPhase::tree};

// n^3 unturned copies at the places of a cubic lattice, in its periodic box or in open space.
Scene lattice(const ConvexBody& body, int n, double spacing, bool is_periodic, const SceneSettings& settings) {
  Scene scene = is_periodic ? Scene(PeriodicBox::cube(n * spacing), settings) : Scene(settings);
  const ShapeId shape = scene.add_shape(body);
  for (int k = 0; k < n * n * n; ++k) {
    Transformd pose;
    pose.translation = {spacing * (k % n), spacing * (k / n % n), spacing * (k / n / n)};
    scene.add(shape, pose);
  }
  return scene;
}

std::uint64_t cube_of(std::uint64_t n) { return n * n * n; }

TEST(TouchingBodies, CubesOnALatticeShareFacesEdgesAndCorners) {
  const ConvexBody cube = parse_shape("box:1,1,1");
  for (const BroadPhase phase : kPhases) {
    for (const InstructionSet set : instruction_sets()) {
      // From a box of one cube, which meets 26 copies of itself, on.
      for (int n = 1; n <= 4; ++n) {
        const SceneSettings settings{.broad_phase = phase, .n_threads = 2, .instruction_set = set, .skin = 0.0};
        ScenePairs found;
        Scene periodic = lattice(cube, n, 1.0, true, settings);
        periodic.overlapping_pairs(found);
        EXPECT_EQ(found.pairs.size(), 13 * cube_of(static_cast<std::uint64_t>(n)));
        const EveryPair every = every_pair(periodic);
        EXPECT_EQ(fault_of_pairs(periodic, every), "");
        EXPECT_EQ(fault_of_clusters(periodic, every), "");
        Clusters clusters;
        periodic.clusters(clusters);
        EXPECT_EQ(clusters.n_clusters(), 1u);
        EXPECT_EQ(clusters.wraps(0), (std::array<bool, 3>{true, true, true}));
        Scene open = lattice(cube, n, 1.0, false, settings);
        const EveryPair in_the_open = every_pair(open);
        EXPECT_EQ(fault_of_pairs(open, in_the_open), "");
        EXPECT_EQ(fault_of_single_bodies(open, in_the_open), "");
      }
    }
  }
}

TEST(TouchingBodies, SpheresOnALatticeTouchTheirNeighboursAlongTheAxes) {
  const ConvexBody sphere = parse_shape("sphere:0.5");
  for (const BroadPhase phase : kPhases) {
    for (int n = 1; n <= 5; ++n) {
      Scene scene = lattice(sphere, n, 1.0, true, {.broad_phase = phase, .skin = 0.0});
      ScenePairs found;
      scene.overlapping_pairs(found);
      EXPECT_EQ(found.pairs.size(), 3 * cube_of(static_cast<std::uint64_t>(n)));
      EXPECT_TRUE(found.undecided.empty());
      EXPECT_EQ(fault_of_pairs(scene, every_pair(scene)), "");
    }
  }
}

// Lattices on which bodies of every kind touch by a point, an edge or a face, or by half of the reach of curved ones.
TEST(TouchingBodies, OfEveryKindAreDecidedAsPairsAre) {
  struct Placed {
    const char* body;
    double spacing;
  };
  const Placed placed[] = {{"capsule:1,0.5", 1.0},
                           {"cylinder:1,0.5", 1.0},
                           {"ellipsoid:0.5,0.5,0.5", 1.0},
                           {"ellipsoid:1,0.5,0.5", 1},
                           {"cone:1,0.5", 1.0},
                           {"frustum:1,0.5,0.25", 1.0},
                           {"hemisphere:0.5", 1.0},
                           {"disc:0.5", 1.0},
                           {"plate:1,1", 1.0},
                           {"octahedron:1", 0.5},
                           {"rounded:0.5,plate:1,1", 1.0},
                           {"needle:1", 1.0},
                           {"tetrahedron:1", 0.5},
                           {"rounded:0.25,box:1,1,1", 1.5},
                           {"sphere:0.25", 0.5}};
  std::uint64_t n_pairs = 0, n_undecided = 0;
  for (const Placed& one : placed) {
    const ConvexBody body = parse_shape(one.body);
    for (const bool is_periodic : {false, true}) {
      const int n = is_periodic ? 2 : 3;
      const EveryPair every = every_pair(lattice(body, n, one.spacing, is_periodic, {}));
      n_pairs += every.pairs.size();
      n_undecided += every.undecided.size();
      for (const BroadPhase phase : kPhases) {
        const double skin = phase == BroadPhase::grid ? 0.1 : 0.0;
        Scene scene = lattice(body, n, one.spacing, is_periodic, {.broad_phase = phase, .n_threads = 2, .skin = skin});
        EXPECT_EQ(fault_of_pairs(scene, every), "") << one.body;
        EXPECT_EQ(fault_of_single_bodies(scene, every), "") << one.body;
        EXPECT_EQ(fault_of_clusters(scene, every), "") << one.body;
      }
    }
  }
  EXPECT_GT(n_pairs, 500u);
  EXPECT_GT(n_undecided, 10u);  // curved bodies that touch: the scene says so, too
}

TEST(TouchingBodies, AreApartAndWithinADistanceToTheLastBit) {
  const ConvexBody cube = parse_shape("box:1,1,1");
  for (const BroadPhase phase : kPhases) {
    Scene scene({.broad_phase = phase, .skin = 0.0});
    const ShapeId shape = scene.add_shape(cube);
    scene.add(shape, Transformd{});
    Transformd pose;
    pose.translation.x = 1.0;
    const BodyId other = scene.add(shape, pose);
    EXPECT_EQ(scene.any_overlap().outcome, Outcome::overlap);
    pose.translation.x = std::nextafter(1.0, 2.0);
    EXPECT_EQ(scene.would_overlap(other, pose), Outcome::disjoint);
    scene.move(other, pose);
    EXPECT_EQ(scene.any_overlap().outcome, Outcome::disjoint);
    ScenePairs within;
    scene.pairs_within(0x1p-52, within);
    EXPECT_EQ(within.pairs.size(), 1u);
    scene.pairs_within(0x1p-53, within);
    EXPECT_TRUE(within.pairs.empty());
  }
}

TEST(TouchingBodies, AsFarApartAsTheDistanceAreWithinIt) {
  for (const BroadPhase phase : kPhases) {
    Scene scene = lattice(parse_shape("box:1,1,1"), 3, 2.0, true, {.broad_phase = phase, .n_threads = 2, .skin = 0.0});
    ScenePairs within;
    scene.pairs_within(1.0, within);
    EXPECT_EQ(within.pairs.size(), 3u * 27);
    EXPECT_EQ(fault_within(scene, 1.0), "");
    EXPECT_EQ(fault_of_distances(scene, 1.0), "");
    EXPECT_EQ(fault_of_manifolds(scene, 1.0), "");
    scene.pairs_within(std::nextafter(1.0, 0.0), within);
    EXPECT_TRUE(within.pairs.empty());
  }
}

}  // namespace
}  // namespace vex
