// Law: a scene that moves in small steps and remembers its pairs (SceneSettings::skin) answers at every step as one
// that remembers nothing, and as one made from nothing; also where bodies cross the faces of the box, turn, jump, or
// stand still.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>

#include "engine/numeric/transform.h"
#include "shapes/box.h"
#include "shapes/sphere.h"
#include "tests/referees/random_poses.h"
#include "tests/referees/scene_judge.h"

namespace vex {
namespace {

constexpr int kSteps = 1000;

Transformd product(const Transformd& a, const Transformd& b) {
  const auto row = [&](const Vec3d& r) { return (r.x * b.row_x + r.y * b.row_y) + r.z * b.row_z; };
  return {row(a.row_x), row(a.row_y), row(a.row_z), b.translation};
}

// A turn by about so many radians. Products of many turns stay rotations well within what a scene asks for.
Transformd small_turn(double angle, std::mt19937_64& random) {
  const Vec3d dir = random_direction(random);
  const Vec3d axis = (1.0 / norm(dir)) * dir;
  const double c = std::cos(angle), s = std::sin(angle), d = 1.0 - c;
  return {{c + d * axis.x * axis.x, d * axis.x * axis.y - s * axis.z, d * axis.x * axis.z + s * axis.y},
          {d * axis.x * axis.y + s * axis.z, c + d * axis.y * axis.y, d * axis.y * axis.z - s * axis.x},
          {d * axis.x * axis.z - s * axis.y, d * axis.y * axis.z + s * axis.x, c + d * axis.z * axis.z},
          {}};
}

struct Motion {
  std::vector<Transformd> poses;
  std::vector<Vec3d> drifts;
};

// Some bodies rest, some drift and turn, and once in a while one jumps.
void step(Motion& motion, double size, std::mt19937_64& random) {
  for (std::size_t k = 0; k < motion.poses.size(); ++k) {
    if (random() % 3 == 0) continue;
    Transformd& pose = motion.poses[k];
    pose = product(small_turn(0.01, random), pose);
    pose.translation = pose.translation + motion.drifts[k];
    if (random() % 2000 == 0) pose.translation.x += 0.3 * size;
  }
}

class Steps : public testing::TestWithParam<std::tuple<SceneStratum, double>> {};

TEST_P(Steps, GiveWhatASceneFromNothingGives) {
  const auto [stratum, share] = GetParam();
  std::mt19937_64 random(11);
  RandomScene made = random_scene(stratum, random);
  while (made.bodies.size() < 3 || (stratum != SceneStratum::one_kind && !made.box)) {
    made = random_scene(stratum, random);
  }
  if (made.bodies.size() > 30) {
    made.bodies.erase(made.bodies.begin() + 30, made.bodies.end());
    made.poses.resize(30);
  }
  Motion motion{made.poses, {}};
  // In 1000 steps every drifting body crosses the box several times.
  for (std::size_t k = 0; k < made.poses.size(); ++k) {
    motion.drifts.push_back((0.008 * made.size) * random_direction(random));
  }
  SceneSettings settings = random_settings(random), others = random_settings(random);
  settings.skin = share * made.size;
  Scene scene = made.scene(settings), forgetful = made.scene(others);
  ScenePairs found, fresh;
  SceneCounts counts;
  std::size_t n_pairs = 0;
  ImageOffset crossings{};
  for (int k = 0; k < kSteps; ++k) {
    step(motion, made.size, random);
    made.poses = motion.poses;
    const std::vector<Pose> poses(motion.poses.begin(), motion.poses.end());
    if (k % 10 == 9) {
      for (BodyId body = 0; body < scene.end(); ++body) scene.move(body, poses[body]);
    } else {
      scene.move_all(poses);
    }
    scene.overlapping_pairs(found);
    if (k % 25 == 24) {
      forgetful = made.scene(others);
    } else {
      forgetful.move_all(poses);
    }
    forgetful.overlapping_pairs(fresh);
    ASSERT_EQ(found.pairs, fresh.pairs) << "step " << k;
    ASSERT_EQ(found.undecided, fresh.undecided) << "step " << k;
    if (k % 100 == 99) {
      ASSERT_EQ(fault_of_pairs(scene, every_pair(scene)), "") << "step " << k;
    }
    counts += found.counts;
    n_pairs += found.pairs.size();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (BodyId body = 0; body < scene.end(); ++body) crossings[axis] += std::abs(scene.image(body)[axis]);
    }
  }
  EXPECT_GT(n_pairs, 100u);
  // The balls of needles all meet: of them the list is remembered, but nothing that their balls prove.
  EXPECT_GT(counts[SceneStage::unmoved].seen, n_pairs);
  if (stratum != SceneStratum::needles) {
    EXPECT_GT(counts[SceneStage::unmoved].settled, 0u);
  }
  if (made.box) {
    for (const int n : crossings) EXPECT_GT(n, kSteps);
  }
}

INSTANTIATE_TEST_SUITE_P(Strata, Steps, testing::Combine(testing::ValuesIn(kSceneStrata), testing::Values(0.03, 0.3)),
                         [](const auto& tested) {
                           return std::string(name_of(std::get<0>(tested.param))) +
                                  (std::get<1>(tested.param) > 0.1 ? "_wide_skin" : "_narrow_skin");
                         });

// Of these scenes nothing is found by chance: what is remembered must end when it does, neither sooner nor later.
std::size_t check_steps(RandomScene made, const SceneSettings& settings, int n_steps,
                        const std::function<void(std::vector<Transformd>&)>& move,
                        const std::function<void(int step, const SceneCounts&)>& see = {}) {
  Scene scene = made.scene(settings), forgetful = made.scene({.broad_phase = BroadPhase::grid, .skin = 0.0});
  ScenePairs found, fresh;
  std::size_t n_changes = 0, n_before = 0;
  for (int k = 0; k < n_steps; ++k) {
    move(made.poses);
    const std::vector<Pose> poses(made.poses.begin(), made.poses.end());
    scene.move_all(poses);
    forgetful.move_all(poses);
    scene.overlapping_pairs(found);
    forgetful.overlapping_pairs(fresh);
    EXPECT_EQ(found.pairs, fresh.pairs) << "step " << k;
    if (found.pairs != fresh.pairs) break;
    if (see) see(k, found.counts);
    n_changes += k > 0 && n_before != found.pairs.size() ? 1u : 0u;
    n_before = found.pairs.size();
  }
  return n_changes;
}

// Head on: all that the bodies travel brings them nearer to each other, and a ball is all of the body.
void expect_spheres_to_meet_in_time(double (*speed)(std::size_t body, int step)) {
  std::mt19937_64 random(13);
  RandomScene made;
  made.box.emplace(6.0, 5.0, 5.0);
  made.size = 6.0;
  const ConvexBody sphere = Sphere(0.2);
  for (int k = 0; k < 150; ++k) {
    made.bodies.push_back(sphere);
    Transformd pose;
    pose.translation = 3.0 * random_direction(random);
    made.poses.push_back(pose);
  }
  int step = 0;
  const std::size_t n_changes = check_steps(made, {.skin = 0.6}, 600, [&](std::vector<Transformd>& poses) {
    for (std::size_t k = 0; k < poses.size(); ++k) poses[k].translation.x += speed(k, step);
    ++step;
  });
  EXPECT_GT(n_changes, 100u);
}

TEST(Steps, SpheresMeetWhenTheirClearanceEnds) {
  expect_spheres_to_meet_in_time([](std::size_t body, int) { return body % 2 == 0 ? 0.01 : -0.01; });
}

// What pairs wait for is how far the fastest body moves, which is another one at each step.
TEST(Steps, SpheresOfUnlikeSpeedsMeetWhenTheirClearanceEnds) {
  expect_spheres_to_meet_in_time([](std::size_t body, int step) {
    const double fast = body % 10 == static_cast<std::size_t>(step) % 10 ? 0.05 : 0.002;
    return body % 2 == 0 ? fast : -fast;
  });
}

// The bodies' places never change: whether they meet is a matter of how they have turned.
TEST(Steps, NeedlesMeetByTurning) {
  std::mt19937_64 random(14);
  RandomScene made;
  made.box.emplace(6.0, 6.0, 6.0);
  made.size = 6.0;
  const ConvexBody needle = Box(0.05, 0.05, 3.0);
  for (int k = 0; k < 150; ++k) {
    made.bodies.push_back(needle);
    Transformd pose = random_rotation(random);
    pose.translation = 3.0 * random_direction(random);
    made.poses.push_back(pose);
  }
  std::vector<Transformd> turns;
  for (int k = 0; k < 150; ++k) turns.push_back(small_turn(0.01, random));
  const auto turn = [&](std::vector<Transformd>& poses) {
    for (std::size_t k = 0; k < poses.size(); ++k) poses[k] = product(turns[k], poses[k]);
  };
  EXPECT_GT(check_steps(made, {.broad_phase = BroadPhase::tree, .skin = 0.5}, 400, turn), 100u);
  EXPECT_GT(check_steps(made, {.broad_phase = BroadPhase::grid, .skin = 0.5}, 100, turn), 30u);
}

// Bodies that stay near their places keep their list, however far they go to and fro and turn: a list that were made
// anew would have other pairs.
TEST(Steps, BodiesThatRattleKeepTheirList) {
  std::mt19937_64 random(16);
  constexpr double kSkin = 0.3;
  for (const bool is_in_a_box : {false, true}) {
    RandomScene made;
    if (is_in_a_box) made.box.emplace(5.0, 6.0, 5.5, 0.4, -0.2, 0.1);
    made.size = 5.0;
    std::vector<Vec3d> places;
    for (std::size_t k = 0; k < 200; ++k) {
      made.bodies.push_back(displaced_hull(12, 0.4, {0.2, 0.1, 0.0}, random));
      Transformd pose = random_rotation(random);
      pose.translation = 2.5 * random_direction(random);
      made.poses.push_back(pose);
      places.push_back(pose.translation);
    }
    // The list is of the places themselves.
    int n_moves = 0;
    const auto rattle = [&](std::vector<Transformd>& poses) {
      if (n_moves++ == 0) return;
      for (std::size_t k = 0; k < places.size(); ++k) {
        poses[k] = product(small_turn(0.02, random), poses[k]);
        const Vec3d dir = random_direction(random);
        poses[k].translation = places[k] + (0.2 * kSkin / norm(dir)) * dir;
      }
    };
    // By way and turn a body has come farther than half of the skin from the second or third step on.
    std::uint64_t n_listed = 0;
    const auto see = [&](int step, const SceneCounts& counts) {
      if (step == 0) n_listed = counts[SceneStage::unmoved].seen;
      if (step <= 40) {
        EXPECT_EQ(counts[SceneStage::unmoved].seen, n_listed) << "step " << step;
      }
    };
    EXPECT_GT(check_steps(made, {.skin = kSkin}, 61, rattle, see), 30u);
  }
}

// What overlaps goes apart again, through the faces, edges and corners of its Minkowski difference: along straight
// lines, in turns on the spot, and both.
TEST(Steps, OverlapsEndWhenTheirClearanceEnds) {
  std::mt19937_64 random(15);
  const ConvexBody kinds[] = {Box(0.6, 0.6, 0.6), Box(0.3, 0.5, 1.0), displaced_hull(12, 0.5, {0.3, 0.1, 0.0}, random)};
  for (const double turning : {0.0, 0.03}) {
    for (const double pace : {0.0, 0.02}) {
      if (turning == 0.0 && pace == 0.0) continue;
      RandomScene made;
      made.box.emplace(4.0, 3.5, 3.0);
      made.size = 4.0;
      std::vector<Vec3d> drifts;
      std::vector<Transformd> turns;
      for (std::size_t k = 0; k < 90; ++k) {
        made.bodies.push_back(kinds[k % 3]);
        Transformd pose = random_rotation(random);
        pose.translation = 2.0 * random_direction(random);
        made.poses.push_back(pose);
        drifts.push_back(pace * random_direction(random));
        turns.push_back(small_turn(turning, random));
      }
      const auto move = [&](std::vector<Transformd>& poses) {
        for (std::size_t k = 0; k < poses.size(); ++k) {
          if (turning > 0.0) poses[k] = product(turns[k], poses[k]);
          poses[k].translation = poses[k].translation + drifts[k];
        }
      };
      for (const int n_threads : {1, 2, 8}) {
        EXPECT_GT(check_steps(made, {.n_threads = n_threads, .skin = 0.4}, 200, move), 60u);
      }
    }
  }
}

// Without a skin, by a tree that is fitted to the moved bodies again and again.
TEST(Steps, OfAFittedTreeGiveWhatAGridFromNothingGives) {
  std::mt19937_64 random(12);
  RandomScene made = random_scene(SceneStratum::needles, random);
  made.box.emplace(6.0, 5.0, 7.0, 0.3, 0.0, -0.2);
  made.size = 6.0;
  const std::vector<ConvexBody> kinds = made.bodies;
  made.bodies.clear();
  made.poses.clear();
  Motion motion;
  for (std::size_t k = 0; k < 120; ++k) {
    made.bodies.push_back(kinds[k % kinds.size()]);
    motion.poses.push_back(random_place(made, random));
    motion.drifts.push_back(0.05 * random_direction(random));
  }
  made.poses = motion.poses;
  Scene scene = made.scene({.broad_phase = BroadPhase::tree, .n_threads = 2, .skin = 0.0});
  ScenePairs found, fresh;
  for (int k = 0; k < 300; ++k) {
    step(motion, made.size, random);
    made.poses = motion.poses;
    scene.move_all(std::vector<Pose>(motion.poses.begin(), motion.poses.end()));
    scene.overlapping_pairs(found);
    Scene from_nothing = made.scene({.broad_phase = BroadPhase::grid, .skin = 0.0});
    from_nothing.overlapping_pairs(fresh);
    ASSERT_EQ(found.pairs, fresh.pairs) << "step " << k;
    ASSERT_EQ(found.undecided, fresh.undecided) << "step " << k;
  }
}

}  // namespace
}  // namespace vex
