// Queries of all pairs keep their memory: once a scene has answered, the same query of one thread allocates nothing. So
// do manifolds of two bodies in a caller's memory. Where memory gives out a scene is what it was, or what it was to be.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>
#include <numbers>
#include <random>

#include "engine/query/contact_manifold.h"
#include "engine/scene/scene.h"
#include "engine/support/combinators.h"
#include "shapes/box.h"
#include "shapes/cylinder.h"
#include "shapes/ellipsoid.h"
#include "shapes/polytope.h"
#include "tests/referees/random_poses.h"
#include "tests/referees/scene_judge.h"

namespace {

std::atomic<std::uint64_t> n_allocations{0};
std::atomic<std::int64_t> n_until_none{-1};  // allocations, from which on there are no more; or none ends

bool gives_out() {
  if (n_until_none < 0) return false;
  if (n_until_none == 0) return true;
  --n_until_none;
  return false;
}

}  // namespace

// Not inlined: a compiler that sees only one of them through takes them for a mismatched pair.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++n_allocations;
  if (gives_out()) throw std::bad_alloc();
  if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++n_allocations;
  return gives_out() ? nullptr : std::malloc(size == 0 ? 1 : size);
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
      SceneManifolds manifolds;
      Clusters clusters;
      EXPECT_EQ(allocations_of([&] { scene.overlapping_pairs(found); }), 0u);
      ASSERT_GT(found.pairs.size(), kBodies / 2);
      EXPECT_EQ(allocations_of([&] { scene.move_all(poses), scene.overlapping_pairs(found); }), 0u);
      EXPECT_EQ(allocations_of([&] { scene.pairs_within(0.1, found); }), 0u);
      EXPECT_EQ(allocations_of([&] { scene.pairs_within(0.1, found), scene.overlapping_pairs(found); }), 0u)
          << "in turn";
      EXPECT_EQ(allocations_of([&] { scene.distances_within(0.1, distances); }), 0u);
      EXPECT_EQ(allocations_of([&] { scene.contact_manifolds(manifolds, {.margin = 0.1, .four_at_most = true}); }), 0u);
      ASSERT_EQ(manifolds.entries.size(), distances.entries.size());
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
      // Each time a list of near pairs is made; and a tree, which is given its order in two pieces of memory.
      const std::vector<Pose> elsewhere(poses.rbegin(), poses.rend());
      EXPECT_LE(allocations_of([&] {
                  scene.move_all(elsewhere), scene.overlapping_pairs(found);
                  scene.move_all(poses), scene.overlapping_pairs(found);
                }),
                phase == BroadPhase::tree ? 4u : 0u);
    }
  }
}

// Of cylinders, too; of prisms of many sides, which are clipped in boxes, and of shallow faces. Pairs of all sizes take
// turns in one memory.
TEST(ManifoldAllocations, InACallersMemoryThereAreNoneInSteadyState) {
  std::vector<Vec3d> prism, dome;
  for (int k = 0; k < 300; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 300.0, off = std::sqrt((k + 0.5) / 300.0);
    for (const double side : {-0.5, 0.5}) {
      prism.push_back({std::cos(angle), std::sin(angle), side});
      dome.push_back({off * std::cos(2.4 * k), off * std::sin(2.4 * k), side * (1.0 - 0.002 * off * off)});
    }
  }
  const ConvexBody bodies[] = {Box(1.0, 1.0, 1.0),          Cylinder(1.0, 0.5),
                               Ellipsoid(1.0, 1.0, 0.5),    Inflated(Cylinder(0.8, 0.4), 0.1),
                               Inflated(Box(1, 1, 1), 0.0), Polytope(prism, {}, 0.4),
                               Polytope(dome, {}, 0.4)};
  ManifoldMemory memory;
  ContactManifold found;
  std::size_t n_contacts = 0;
  const auto ask_all = [&] {
    n_contacts = 0;
    for (const ConvexBody& a : bodies) {
      for (const ConvexBody& b : bodies) {
        for (const bool four_at_most : {false, true}) {
          for (const double tilt : {0.0, 0.003, 0.3}) {
            Transformd pose;
            pose.row_y = {0.0, std::cos(tilt), -std::sin(tilt)};
            pose.row_z = {0.0, std::sin(tilt), std::cos(tilt)};
            pose.translation = {0.1, 0.05, 0.99};
            contact_manifold(a, b, pose, {.margin = 0.05, .four_at_most = four_at_most}, memory, found);
            n_contacts += found.contacts.size();
          }
        }
      }
    }
  };
  EXPECT_EQ(allocations_of(ask_all), 0u);
  EXPECT_GT(n_contacts, 2000u);
}

// A body that was added while memory gave out was there without a pose, and a shape that was not there was found again.
TEST(SceneAllocations, WhereMemoryGivesOutTheSceneIsWhatItSaysItIs) {
  std::mt19937_64 random(3);
  std::size_t n_refused = 0, n_pairs = 0;
  for (const BroadPhase phase : {BroadPhase::grid, BroadPhase::tree}) {
    for (const double skin : {0.0, 0.2}) {
      Scene scene(PeriodicBox::cube(6.0), {.broad_phase = phase, .skin = skin});
      const auto place = [&random] {
        Transformd pose = random() % 2 == 0 ? random_rotation(random) : Transformd{};
        for (double* x : {&pose.translation.x, &pose.translation.y, &pose.translation.z}) {
          *x = 6.0 * (random_in_unit_interval(random) - 0.5);
        }
        return Pose(pose);
      };
      std::vector<ConvexBody> bodies;
      for (int k = 0; k < 40; ++k) bodies.emplace_back(Box(0.5 + 0.02 * k, 1.0, 0.7));
      ScenePairs found;
      for (int step = 0; step < 800; ++step) {
        const BodyId body = scene.end() == 0 ? 0 : static_cast<BodyId>(random() % scene.end());
        const Pose pose = place();
        const std::size_t n_before = scene.size();
        const std::uint64_t choice = scene.size() > 30 ? 0 : random() % 5;
        const std::vector<Pose> poses = {pose, place()};
        const bool is_many = step % 2 == 0;
        n_until_none = step % 3 == 0 ? -1 : static_cast<std::int64_t>(random() % (choice == 4 ? 40 : 6));
        bool is_refused = false;
        try {
          if (choice == 0 && scene.has(body)) scene.remove(body);
          if (choice == 1 && scene.has(body)) scene.move(body, pose);
          if (choice == 2 && scene.has(body)) scene.overlaps_of(body, found);
          if (choice == 3) scene.overlapping_pairs(found);
          const ConvexBody& added = bodies[static_cast<std::size_t>(step) % bodies.size()];
          if (choice == 4 && is_many) scene.add(scene.add_shape(added), poses);
          if (choice == 4 && !is_many) scene.add(added, pose);
        } catch (const std::bad_alloc&) {
          is_refused = true;
        }
        n_until_none = -1;
        n_refused += is_refused ? 1 : 0;
        if (choice == 4) {
          EXPECT_EQ(scene.size(), n_before + (is_refused ? 0 : is_many ? 2 : 1));
        }
        if (choice == 0 && is_refused) {
          EXPECT_EQ(scene.size(), n_before);
        }
        if (!is_refused && step % 50 != 0) continue;
        const EveryPair every = every_pair(scene);
        n_pairs += every.pairs.size();
        ASSERT_EQ(fault_of_pairs(scene, every), "") << step;
        ASSERT_EQ(fault_of_single_bodies(scene, every), "") << step;
      }
    }
  }
  EXPECT_GT(n_refused, 200u);
  EXPECT_GT(n_pairs, 1000u);
}

}  // namespace
}  // namespace vex
