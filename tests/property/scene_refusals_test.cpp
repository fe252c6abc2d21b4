// What a scene refuses, by typed exceptions; it is as it was before then.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/numeric/errors.h"
#include "shapes/any_shape.h"
#include "tests/referees/random_poses.h"
#include "tests/referees/scene_judge.h"

namespace vex {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const ConvexBody kRefusedCube = parse_shape("box:1,1,1");

Transformd at(double x, double y, double z) {
  Transformd pose;
  pose.translation = {x, y, z};
  return pose;
}
// Good enough for a pair (1e-6), but not for a scene (2e-7).
Transformd rough_pose() {
  Transformd pose;
  pose.row_x.x += 3e-7;
  return pose;
}

class SceneRefuses : public testing::Test {
 protected:
  SceneRefuses() : scene_(PeriodicBox(4.0, 5.0, 6.0)) {
    for (int k = 0; k < 3; ++k) scene_.add(kRefusedCube, at(0.6 * k, 0.0, 0.0));
    before_ = every_pair(scene_);
  }
  void TearDown() override {
    EXPECT_EQ(scene_.size(), 3u);
    EXPECT_EQ(scene_.end(), 3u);
    EXPECT_EQ(fault_of_pairs(scene_, before_), "");
    EXPECT_EQ(fault_of_single_bodies(scene_, before_), "");
  }
  Scene scene_;
  EveryPair before_;
};

TEST_F(SceneRefuses, PosesThatAreNone) {
  Transformd mirrored;
  mirrored.row_z.z = -1.0;
  for (const Transformd& pose : {at(kNan, 0, 0), at(0, HUGE_VAL, 0), mirrored, rough_pose()}) {
    EXPECT_THROW(scene_.add(kRefusedCube, pose), InputError);
    EXPECT_THROW(scene_.move(0, pose), InputError);
    EXPECT_THROW((void)scene_.would_overlap(0, pose), InputError);
  }
  // Of many none is added where one is refused, also where a number is free.
  const ShapeId cube = scene_.add_shape(kRefusedCube);
  for (const bool has_gap : {false, true}) {
    const Transformd first = scene_.pose(0);
    if (has_gap) scene_.remove(0);
    for (const Transformd& pose : {at(kNan, 0, 0), rough_pose()}) {
      std::vector<Pose> poses(4);
      poses[2] = Pose::unchecked(pose);
      EXPECT_THROW(scene_.add(cube, poses), InputError);
      EXPECT_EQ(scene_.size(), has_gap ? 2u : 3u);
      EXPECT_EQ(scene_.end(), 3u);
      EXPECT_EQ(fault_of_pairs(scene_, every_pair(scene_)), "");
    }
    if (has_gap) scene_.add(kRefusedCube, first);
  }
  scene_.add(cube, std::span<const Pose>());
  Transformd rotated = at(0, 0, 0);
  rotated.row_x.x = kNan;
  EXPECT_THROW(scene_.add(kRefusedCube, rotated), InputError);
  EXPECT_THROW(scene_.add(kRefusedCube, at(1e300, 0, 0)), InputError);
  Scene open;
  EXPECT_THROW(open.add(kRefusedCube, at(1e101, 0, 0)), InputError);
}

TEST_F(SceneRefuses, NumbersThatNoBodyHas) {
  ScenePairs out;
  for (const BodyId body : {BodyId{3}, BodyId{1000000}, kNoBody}) {
    EXPECT_FALSE(scene_.has(body));
    EXPECT_THROW(scene_.remove(body), UsageError);
    EXPECT_THROW(scene_.move(body, Pose()), UsageError);
    EXPECT_THROW((void)scene_.pose(body), UsageError);
    EXPECT_THROW((void)scene_.image(body), UsageError);
    EXPECT_THROW((void)scene_.shape_of(body), UsageError);
    EXPECT_THROW((void)scene_.relative_pose({0, body, {}}), UsageError);
    EXPECT_THROW((void)scene_.relative_pose({body, 0, {}}), UsageError);
    EXPECT_THROW(scene_.overlaps_of(body, out), UsageError);
    EXPECT_THROW((void)scene_.would_overlap(body, Pose()), UsageError);
    EXPECT_THROW((void)scene_.shape(body), UsageError);
    EXPECT_THROW(scene_.add(ShapeId{body}, Pose()), UsageError);
    EXPECT_THROW(scene_.add(ShapeId{body}, std::vector<Pose>(2)), UsageError);
  }
  Scene other;
  const BodyId removed = other.add(kRefusedCube, Pose());
  other.add(kRefusedCube, Pose());
  other.remove(removed);
  EXPECT_THROW(other.remove(removed), UsageError);
  EXPECT_THROW(other.overlaps_of(removed, out), UsageError);
}

TEST_F(SceneRefuses, DistancesThatAreNone) {
  ScenePairs pairs;
  SceneDistances distances;
  SceneManifolds manifolds;
  for (const double distance : {-1.0, -1e-300, kNan, HUGE_VAL, -HUGE_VAL}) {
    EXPECT_THROW(scene_.pairs_within(distance, pairs), UsageError);
    EXPECT_THROW(scene_.distances_within(distance, distances), UsageError);
    EXPECT_THROW(scene_.contact_manifolds(manifolds, distance), UsageError);
  }
  EXPECT_THROW(scene_.pairs_within(4.0 * Scene::kMostImages + 1.0, pairs), InputError);
}

TEST_F(SceneRefuses, SettingsThatMakeNoSense) {
  for (const int n_threads : {0, -1, 1000000}) {
    EXPECT_THROW(scene_.set({.n_threads = n_threads}), UsageError);
    EXPECT_THROW(Scene({.n_threads = n_threads}), UsageError);
  }
  for (const double skin : {-1.0, kNan, HUGE_VAL}) {
    EXPECT_THROW(scene_.set({.skin = skin}), UsageError);
    EXPECT_THROW(Scene(PeriodicBox::cube(1.0), {.skin = skin}), UsageError);
  }
}

TEST_F(SceneRefuses, BodiesThatReachOverTooManyCopiesOfTheBox) {
  const std::string length = std::to_string(4.0 * Scene::kMostImages + 1.0);
  const ConvexBody needle = parse_shape("box:0.1,0.1," + length);
  EXPECT_THROW(scene_.add(needle, Pose()), InputError);
  EXPECT_THROW(scene_.add_shape(needle), InputError);
  EXPECT_EQ(scene_.n_shapes(), 1u);
}

TEST_F(SceneRefuses, PosesOfAnotherNumberOfBodies) {
  for (const std::size_t n : {0u, 2u, 4u}) {
    EXPECT_THROW(scene_.move_all(std::vector<Pose>(n)), UsageError);
  }
  Scene gaps;
  for (int k = 0; k < 3; ++k) gaps.add(kRefusedCube, Pose());
  gaps.remove(1);
  EXPECT_THROW(gaps.move_all(std::vector<Pose>(2)), UsageError);
  EXPECT_THROW(gaps.move_all(std::vector<Pose>(3)), UsageError);
}

// One of the poses is too rough: it is refused by whichever thread comes to it, and the scene is about what is in it.
TEST(SceneRefusesPoses, AmongThoseOfAllBodies) {
  std::mt19937_64 random(3);
  const RandomScene made = random_scene(SceneStratum::one_kind, random);
  for (const int n_threads : {1, 3}) {
    for (const double skin : {0.0, 0.2}) {
      Scene scene = made.scene({.n_threads = n_threads, .skin = skin});
      ASSERT_EQ(fault_of_pairs(scene, every_pair(scene)), "");
      std::vector<Pose> poses;
      for (std::size_t k = 0; k < made.bodies.size(); ++k) poses.emplace_back(random_place(made, random));
      poses[poses.size() / 2] = Pose(rough_pose());
      EXPECT_THROW(scene.move_all(poses), InputError);
      EXPECT_EQ(fault_of_scene(scene, made, every_pair(scene), random), "");
    }
  }
}

TEST(PeriodicBoxRefuses, EdgesAndTiltsThatAreNone) {
  for (const double edge : {0.0, -1.0, kNan, HUGE_VAL, 1e101, 1e-101}) {
    EXPECT_THROW(PeriodicBox::cube(edge), InputError);
    EXPECT_THROW(PeriodicBox(1.0, edge, 1.0), InputError);
    EXPECT_THROW(PeriodicBox(1.0, 1.0, edge), InputError);
  }
  for (const double tilt : {kNan, HUGE_VAL, 1000.0, -1000.0}) {
    EXPECT_THROW(PeriodicBox(1, 1, 1, tilt), InputError);
    EXPECT_THROW(PeriodicBox(1, 1, 1, 0, tilt), InputError);
    EXPECT_THROW(PeriodicBox(1, 1, 1, 0, 0, tilt), InputError);
  }
}

}  // namespace
}  // namespace vex
