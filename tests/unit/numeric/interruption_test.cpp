#include "engine/numeric/interruption.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <thread>
#include <vector>

#include "engine/numeric/errors.h"
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
