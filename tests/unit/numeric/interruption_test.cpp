#include "engine/numeric/interruption.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <optional>
#include <thread>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/scene/compound.h"
#include "engine/scene/scene.h"
#include "engine/scene/threads.h"
#include "engine/support/validate.h"
#include "shapes/box.h"

namespace vex {
namespace {

TEST(Interruption, EndsNothingWhereThereIsNone) {
  EXPECT_EQ(Interruption::current(), nullptr);
  EXPECT_NO_THROW(end_if_interrupted());
}

TEST(Interruption, IsAskedOnItsOwnThreadAloneAndHeededOnAllThatWorkForIt) {
  const std::thread::id owner = std::this_thread::get_id();
  std::atomic<int> n_asked{0}, n_elsewhere{0}, n_ended{0};
  const Interruption interruption([&] {
    if (std::this_thread::get_id() != owner) ++n_elsewhere;
    return ++n_asked > 1000;
  });
  const auto work = [&](int) {
    try {
      while (true) end_if_interrupted();
    } catch (const Interrupted&) {
      ++n_ended;
      throw;
    }
  };
  EXPECT_THROW(on_threads(4, work), Interrupted);
  EXPECT_EQ(n_asked, 1001);
  EXPECT_EQ(n_elsewhere, 0);
  EXPECT_EQ(n_ended, 4);
  EXPECT_THROW(end_if_interrupted(), Interrupted);  // what was told once stays told
}

TEST(Interruption, LastsAsLongAsItLivesAndHidesAnOuterOne) {
  const Interruption outer([] { return true; });
  {
    const Interruption inner([] { return false; });
    EXPECT_NO_THROW(end_if_interrupted());
    Interruption::current()->end();
    EXPECT_THROW(end_if_interrupted(), Interrupted);
  }
  EXPECT_THROW(end_if_interrupted(), Interrupted);
  std::jthread([] { EXPECT_NO_THROW(end_if_interrupted()); });  // another's work
}

// Boxes in a grid, each in contact with its neighbours.
std::vector<Pose> places(int n_a_side) {
  std::vector<Pose> poses;
  for (int x = 0; x < n_a_side; ++x) {
    for (int y = 0; y < n_a_side; ++y) {
      for (int z = 0; z < n_a_side; ++z) poses.emplace_back(Transformd{.translation = {0.9 * x, 0.9 * y, 0.9 * z}});
    }
  }
  return poses;
}

TEST(Interruption, EndsQueriesOfAScene_WhichAnswersAfterThem) {
  for (const double skin : {0.0, 0.25}) {
    for (const BroadPhase phase : {BroadPhase::grid, BroadPhase::tree}) {
      Scene scene({.broad_phase = phase, .n_threads = 2, .skin = skin});
      const ShapeId shape = scene.add_shape(Box(1.0, 1.0, 1.0));
      for (const Pose& pose : places(12)) scene.add(shape, pose);
      ScenePairs pairs, again;
      SceneDistances distances;
      Clusters clusters;
      scene.overlapping_pairs(pairs);
      ASSERT_GT(pairs.pairs.size(), 1000u);
      scene.move_all(places(12));
      {
        const Interruption at_once([] { return true; });
        EXPECT_THROW(scene.overlapping_pairs(again), Interrupted);
        EXPECT_THROW(scene.pairs_within(0.05, again), Interrupted);
        EXPECT_THROW(scene.distances_within(0.05, distances), Interrupted);
        EXPECT_THROW(scene.clusters(clusters), Interrupted);
        EXPECT_THROW(scene.any_overlap(), Interrupted);
      }
      scene.overlapping_pairs(again);
      EXPECT_EQ(again.pairs, pairs.pairs);
      scene.clusters(clusters);
      EXPECT_EQ(clusters.n_clusters(), 1u);
    }
  }
}

TEST(Interruption, EndsAQueryInItsMiddle_AndMoreOfItLater) {
  Scene scene({.n_threads = 1, .skin = 0.25});
  const ShapeId shape = scene.add_shape(Box(1.0, 1.0, 1.0));
  for (const Pose& pose : places(16)) scene.add(shape, pose);
  Scene other({.n_threads = 1});
  const ShapeId same = other.add_shape(Box(1.0, 1.0, 1.0));
  for (const Pose& pose : places(16)) other.add(same, pose);
  ScenePairs expected, pairs;
  other.overlapping_pairs(expected);
  int n_ended = 0;
  for (int n = 0; n < 12; ++n) {
    int n_left = n;
    const Interruption later([&] { return n_left-- == 0; });
    try {
      scene.overlapping_pairs(pairs);
    } catch (const Interrupted&) {
      ++n_ended;
    }
  }
  EXPECT_GT(n_ended, 5);
  scene.overlapping_pairs(pairs);
  EXPECT_EQ(pairs.pairs, expected.pairs);
}

// work(), ended at its first question, its second, and so on until it is not ended; after each time is_as_before().
template <class Work, class Check>
int end_everywhere(const Work& work, const Check& is_as_before) {
  for (int n = 0;; ++n) {
    int n_left = n;
    try {
      const Interruption later([&] { return n_left-- == 0; });
      work();
      return n;
    } catch (const Interrupted&) {
      is_as_before();
    }
  }
}

// What is made for one query is there, or half of it, when the next one comes.
TEST(Interruption, EndsTheMakingOfGridsAndTrees_AndTheyAreMadeAnew) {
  constexpr int kASide = 8;
  for (const BroadPhase phase : {BroadPhase::grid, BroadPhase::tree}) {
    for (const int n_threads : {1, 2}) {
      for (const bool in_box : {false, true}) {
        const auto made = [&] {
          const SceneSettings settings{.broad_phase = phase, .n_threads = n_threads};
          Scene scene = in_box ? Scene(PeriodicBox(7.6, 7.6, 7.6), settings) : Scene(settings);
          const ShapeId shape = scene.add_shape(Box(1.0, 1.0, 1.0));
          for (const Pose& pose : places(kASide)) scene.add(shape, pose);
          return scene;
        };
        const ScenePair first{0, 1, {}};
        Scene scene = made(), other = made();
        ScenePairs touching, near, of_one, found;
        other.overlapping_pairs(touching);
        other.pairs_within(0.85, near);
        other.overlaps_of(5, of_one);
        const SceneNeighbour nearest = other.nearest(7);
        ASSERT_EQ(touching.pairs.front(), first);
        ASSERT_GT(near.pairs.size(), touching.pairs.size());
        const auto is_as_before = [&] {
          scene.pairs_within(0.85, found);
          EXPECT_EQ(found.pairs, near.pairs);
          scene.overlapping_pairs(found);
          EXPECT_EQ(found.pairs, touching.pairs);
          scene.overlaps_of(5, found);
          EXPECT_EQ(found.pairs, of_one.pairs);
          EXPECT_EQ(scene.nearest(7).body, nearest.body);
        };
        // Of what is not true any more, of what is true of another margin, and of what was never made.
        const auto move_a_little = [&] { scene.move(3, Pose(scene.pose(3))); };
        EXPECT_GT(end_everywhere([&] { scene.overlapping_pairs(found); }, is_as_before), 0);
        EXPECT_GT(end_everywhere(
                      [&] {
                        scene.move_all(places(kASide));
                        scene.pairs_within(0.85, found);
                      },
                      is_as_before),
                  3);
        EXPECT_GT(end_everywhere(
                      [&] {
                        move_a_little();
                        scene.pairs_within(0.85, found);
                        scene.overlapping_pairs(found);
                      },
                      is_as_before),
                  6);
        EXPECT_GT(end_everywhere(
                      [&] {
                        scene.move_all(places(kASide));
                        scene.overlaps_of(5, found);
                        scene.nearest(7);
                      },
                      is_as_before),
                  3);
      }
    }
  }
}

TEST(Interruption, EndsTheMakingOfACompound) {
  std::vector<std::array<Vec3d, 3>> triangles;
  for (int k = 0; k < 100'000; ++k) {
    const double x = 0.5 * k;
    triangles.push_back({{{x, 0.0, 0.0}, {x + 1.0, 0.0, 0.0}, {x, 1.0, 0.0}}});
  }
  int n_asked = 0, n_of_parts = 0;
  {
    const Interruption counts([&] {
      ++n_asked;
      return false;
    });
    static_cast<void>(compound_of_triangles(triangles));
  }
  n_of_parts = 2 * (100'000 / 256 + 1);
  EXPECT_GT(n_asked, n_of_parts + 5) << "the tree asks, too";
  int n_left = n_of_parts + 3;
  const Interruption in_the_tree([&] { return n_left-- == 0; });
  EXPECT_THROW(static_cast<void>(compound_of_triangles(triangles)), Interrupted);
}

TEST(Interruption, EndsARayThroughMillionsOfBoxes) {
  Scene scene(PeriodicBox(1.0, 1.0, 1.0));
  scene.add(Box(0.1, 0.1, 0.1), Pose());
  int n_asked = 0;
  const Interruption later([&] { return ++n_asked == 1000; });
  EXPECT_THROW(static_cast<void>(scene.cast_ray({0.5, 0.5, 0.5}, {1.0, 0.0, 0.0}, 9e5)), Interrupted);
}

TEST(Interruption, OfAThreadDoesNotHideTheFailureThatBroughtIt) {
  const auto work = [](int thread) {
    if (thread == 0) throw Interrupted();
    throw InputError("what happened");
  };
  EXPECT_THROW(on_threads(2, work), InputError);
}

TEST(Interruption, EndsAValidation) {
  const ConvexBody box = Box(1.0, 2.0, 3.0);
  int n_asked = 0;
  const Interruption later([&] { return ++n_asked == 500; });
  EXPECT_THROW(validate(box, {.n_directions = 100'000'000}), Interrupted);
}

}  // namespace
}  // namespace vex
