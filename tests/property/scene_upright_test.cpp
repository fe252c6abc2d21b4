// Law: a scene none of whose bodies is turned, which looks for pairs by boxes (E26), answers as brute force does, as
// one does whose bodies come to be turned, or of another shape; and it looks at fewer pairs.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "shapes/any_shape.h"
#include "tests/referees/random_poses.h"
#include "tests/referees/random_scenes.h"
#include "tests/referees/scene_judge.h"

namespace vex {
namespace {

struct Region {
  const char* name;
  std::optional<PeriodicBox> box;  // its edges are some 4, 6 and 3 of the body's size
};

class UprightScene {
 public:
  UprightScene(const ConvexBody& body, const Region& region, InstructionSet set, std::uint64_t seed)
      : random_(seed), body_(body), settings_{.instruction_set = set, .skin = 0.0} {
    const double size = body.circumradius();
    if (region.box) {
      const PeriodicBox& unit = *region.box;
      const Vec3d edges = size * unit.edges();
      box_.emplace(edges.x, edges.y, edges.z, unit.xy(), unit.xz(), unit.yz());
    }
    scene_.emplace(empty());
  }

  Scene& scene() { return *scene_; }
  std::mt19937_64& random() { return random_; }

  // At random, or where its box touches that of one that is there, along one axis or more; to within a last bit.
  Transformd place() {
    std::uniform_real_distribution<double> along(-0.5, 0.5);
    const double size = body_.circumradius();
    Transformd pose;
    pose.translation = {4.0 * size * along(random_), 6.0 * size * along(random_), 3.0 * size * along(random_)};
    const BodyId other = scene_->end() == 0 ? 0 : static_cast<BodyId>(random_() % scene_->end());
    if (!scene_->has(other) || random_() % 2 == 0) return pose;
    const Vec3d there = scene_->pose(other).translation;
    const auto extent = [this](const Vec3d& axis) {
      return dot(axis, body_.support(axis)) + dot(-axis, body_.support(-axis));
    };
    const Vec3d reach{extent({1, 0, 0}), extent({0, 1, 0}), extent({0, 0, 1})};
    const std::array<double*, 3> to = {&pose.translation.x, &pose.translation.y, &pose.translation.z};
    const std::array<double, 3> from = {there.x, there.y, there.z}, by = {reach.x, reach.y, reach.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double sign = random_() % 2 == 0 ? 1.0 : -1.0;
      if (random_() % 4 == 0) {
        *to[axis] = from[axis] + sign * by[axis] * std::fabs(along(random_));
        continue;
      }
      *to[axis] = from[axis] + sign * by[axis];
      if (random_() % 3 == 0) *to[axis] = std::nextafter(*to[axis], from[axis]);
    }
    return pose;
  }

  void fill(std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) scene_->add(body_, place());
  }
  // A turned one among upright ones, which are added together.
  void fill_turned() {
    std::vector<Pose> poses;
    for (int k = 0; k < 8; ++k) poses.emplace_back(place());
    const Transformd turned = random_rotation(random_);
    poses[random_() % 8] = Transformd{turned.row_x, turned.row_y, turned.row_z, place().translation};
    scene_->add(scene_->add_shape(body_), poses);
  }

  void judge(const std::string& what) {
    SCOPED_TRACE(what);
    const EveryPair every = every_pair(*scene_);
    n_pairs_ += every.pairs.size();
    EXPECT_EQ(fault_of_pairs(*scene_, every), "");
    EXPECT_EQ(fault_of_single_bodies(*scene_, every), "");
    EXPECT_EQ(fault_of_added(*scene_, every, static_cast<BodyId>(scene_->size() / 2)), "");
    for (const bool is_turned : {false, true, false}) {
      Transformd pose = place();
      if (is_turned) {
        const Transformd turned = random_rotation(random_);
        pose = {turned.row_x, turned.row_y, turned.row_z, pose.translation};
      }
      BodyId body = 0;
      while (!scene_->has(body)) ++body;
      EXPECT_EQ(fault_of_trial_move(*scene_, body, Pose(pose)), "");
    }
  }
  std::size_t n_pairs() const { return n_pairs_; }

 private:
  Scene empty() const { return box_ ? Scene(*box_, settings_) : Scene(settings_); }

  std::mt19937_64 random_;
  ConvexBody body_;
  SceneSettings settings_;
  std::optional<PeriodicBox> box_;
  std::optional<Scene> scene_;
  std::size_t n_pairs_ = 0;
};

TEST(UprightBodies, AreFoundAsByBruteForce) {
  std::mt19937_64 random(11);
  const ConvexBody bodies[] = {parse_shape("box:1,1,1"),
                               parse_shape("box:3,0.2,1"),
                               parse_shape("plate:1,2"),
                               parse_shape("needle:1"),
                               parse_shape("cone:1,0.5"),
                               parse_shape("superball:3,1"),
                               parse_shape("capsule:2,0.3"),
                               displaced_hull(20, 1.0, {0.3, -0.2, 0.1}, random),
                               displaced_hull(12, 1.0, {1e4, -3e3, 2e4}, random)};
  const Region regions[] = {{"open", {}},
                            {"box", PeriodicBox(4, 6, 3)},
                            {"small box", PeriodicBox(0.7, 1.5, 2.5)},
                            {"triclinic box", PeriodicBox(4, 6, 3, 0.4, 0.1, -0.3)}};
  std::size_t n_pairs = 0;
  std::uint64_t seed = 0;
  for (const ConvexBody& body : bodies) {
    for (const Region& region : regions) {
      const std::span<const InstructionSet> sets = instruction_sets();
      UprightScene made(body, region, sets[seed % sets.size()], seed);
      ++seed;
      SCOPED_TRACE(region.name + std::string(", of radius ") + std::to_string(body.circumradius()) + " number " +
                   std::to_string(seed));
      const std::size_t n = region.box && region.box->edges().x < 1.0 ? 3 : 16;
      made.fill(n);
      made.judge("from nothing");
      Scene& scene = made.scene();
      scene.move(0, made.place());
      scene.remove(1);
      made.fill(n / 2);
      made.judge("moved and added");
      // One that is turned, and one of another shape.
      Transformd turned = random_rotation(made.random());
      turned.translation = made.place().translation;
      const BodyId last = scene.add(body, turned);
      made.judge("one is turned");
      scene.remove(last);
      made.judge("and gone");
      scene.clear();
      made.fill(n);
      std::vector<Pose> poses;
      for (BodyId k = 0; k < scene.end(); ++k) poses.emplace_back(k == 2 ? turned : scene.pose(k));
      scene.move_all(poses);
      made.judge("one is turned by a move of all");
      scene.clear();
      made.fill_turned();
      made.judge("one of many is turned");
      scene.clear();
      made.fill(n);
      scene.add(parse_shape("sphere:0.5"), made.place());
      made.judge("one of another shape");
      n_pairs += made.n_pairs();
      scene.clear();
      made.fill(n);
      made.judge("from nothing again");
    }
  }
  EXPECT_GT(n_pairs, 2500u);
}

// Corner by corner unit cubes 1.05 apart along one axis are apart, and their balls of radius .87 meet.
TEST(UprightBodies, AreLookedForByBoxes) {
  const ConvexBody cube = parse_shape("box:1,1,1");
  for (const bool is_turned : {false, true}) {
    Scene scene(PeriodicBox::cube(8.0));
    for (int k = 0; k < 27; ++k) {
      Transformd pose;
      pose.translation = {1.05 * (k % 3), 1.05 * (k / 3 % 3), 1.05 * (k / 9)};
      if (is_turned && k == 5) {
        pose.row_x = {0.0, -1.0, 0.0};
        pose.row_y = {1.0, 0.0, 0.0};
      }
      scene.add(cube, pose);
    }
    for (const bool at_once : {false, true}) {
      ScenePairs found;
      if (at_once) {
        scene.set({.broad_phase = BroadPhase::grid});
        scene.overlapping_pairs(found);
      } else {
        scene.overlaps_of_added(0, found);
      }
      EXPECT_TRUE(found.pairs.empty());
      const SceneCounts::Stage& balls = found.counts[SceneStage::balls];
      if (is_turned) {
        EXPECT_GT(balls.seen, balls.settled + 50);
      } else {
        EXPECT_EQ(balls.seen, balls.settled);
      }
    }
  }
}

// Of spheres the box tells less than the ball.
TEST(UprightBodies, ThatAreBallsAreLookedForByBalls) {
  const ConvexBody sphere = parse_shape("sphere:0.5");
  Scene scene(PeriodicBox::cube(8.0));
  for (int k = 0; k < 8; ++k) {
    Transformd pose;
    pose.translation = {0.9 * (k % 2), 0.9 * (k / 2 % 2), 0.9 * (k / 4)};
    scene.add(sphere, pose);
  }
  ScenePairs found;
  scene.overlaps_of_added(0, found);
  EXPECT_EQ(found.pairs.size(), 12u);  // along the edges, .9 apart, and not across, 1.27 apart
  const SceneCounts::Stage& balls = found.counts[SceneStage::balls];
  EXPECT_EQ(balls.seen - balls.settled, 12u);
}

}  // namespace
}  // namespace vex
