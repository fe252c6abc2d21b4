// Law: bodies that exactly touch are decided as `overlap` decides them, in open space and across the faces of a box.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "engine/query/overlap.h"
#include "shapes/any_shape.h"
#include "shapes/scaled.h"
#include "tests/referees/random_poses.h"
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

// Cells hold centres as floats, about a body of the cell: whatever the size, however far out, and whatever lies in the
// outermost cells, what touches is found.
TEST(TouchingBodies, OfAnySizeAndPlaceAreFoundOneByOne) {
  std::mt19937_64 random(5);
  std::size_t n_pairs = 0;
  for (const double size : {1e-90, 1.0, 1e70}) {
    for (const double out : {0.0, 1e13}) {
      for (const double spread : {3.0, 1e6}) {
        for (const char* const shape : {"sphere:1", "box:1,2,3", "capsule:2,0.3"}) {
          SCOPED_TRACE(shape + (" " + std::to_string(size)) + ' ' + std::to_string(out) + ' ' + std::to_string(spread));
          const ConvexBody body = scaled(parse_shape(shape), size);
          Scene scene;
          const ShapeId id = scene.add_shape(body);
          // Each second one touches the one before, of balls to within two last places, or is near it.
          const auto place = [&](BodyId k) {
            Transformd pose;
            if (shape[0] != 'b') pose = random_rotation(random);
            const double last_places = static_cast<double>(static_cast<int>(random() % 5) - 2) * 0x1p-52;
            const double apart =
                shape[0] == 's' ? 2.0 * (1.0 + last_places) : 0.8 + 0.1 * static_cast<double>(random() % 4);
            pose.translation = k % 2 == 1 ? scene.pose(k - 1).translation + (size * apart) * random_direction(random)
                                          : (size * spread) * random_direction(random) + Vec3d{out * size, 0.0, 0.0};
            return pose;
          };
          for (BodyId k = 0; k < 40; ++k) scene.add(id, place(k));
          const EveryPair every = every_pair(scene);
          n_pairs += every.pairs.size();
          EXPECT_EQ(fault_of_single_bodies(scene, every), "");
          EXPECT_EQ(fault_of_pairs(scene, every), "");
          // Two that are farther out than the outermost cells, and one that takes another one's place in its cell.
          for (const BodyId k : {8u, 9u}) {
            Transformd pose = place(k);
            if (k == 8) pose.translation = 1e9 * pose.translation;
            scene.move(k, pose);
          }
          scene.remove(3);
          scene.move(30, scene.pose(7));
          scene.add(id, scene.pose(20));
          EXPECT_EQ(fault_of_single_bodies(scene, every_pair(scene)), "");
        }
      }
    }
  }
  EXPECT_GT(n_pairs, 400u);
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
