// Law: a scene that bodies were added to, removed from and moved in, in any order and with queries of all kinds
// between, answers as brute force does of what is in it now, and as a scene made of that from nothing.
#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "tests/referees/random_poses.h"
#include "tests/referees/scene_judge.h"

namespace vex {
namespace {

class ChangingScene {
 public:
  ChangingScene(SceneStratum stratum, double skin, std::uint64_t seed)
      : random_(seed), made_(random_scene(stratum, random_)), skin_(skin) {
    made_.settings.skin = skin;
    scene_.emplace(made_.scene());
  }

  void change() {
    const BodyId end = scene_->end();
    const BodyId body = end == 0 ? 0 : static_cast<BodyId>(random_() % end);
    const bool is_there = scene_->has(body);
    switch (random_() % 8) {
      case 0: add(); break;
      case 1: add_some(); break;
      case 2:
        if (is_there && scene_->size() > 2) scene_->remove(body);
        break;
      case 3:
        if (is_there) scene_->move(body, random_place(made_, random_));
        break;
      case 4:
      case 5:
        if (is_there) nudge(body);
        break;
      case 6:
        if (scene_->size() == end) move_all();
        break;
      default: {
        SceneSettings settings = random_settings(random_);
        settings.skin = random_() % 4 == 0 ? 0.5 * skin_ : skin_;
        scene_->set(settings);
      }
    }
  }

  // One of the questions, or all of them.
  std::string ask(bool all) {
    const EveryPair every = every_pair(*scene_);
    n_pairs_ += every.pairs.size();
    if (all) return fault_of_scene(*scene_, made_, every, random_);
    switch (random_() % 4) {
      case 0: return fault_of_clusters(*scene_, every);
      case 1: return fault_of_single_bodies(*scene_, every);
      case 2: return fault_within(*scene_, 0.02 * made_.size);
      default: return fault_of_pairs(*scene_, every);
    }
  }
  std::size_t n_pairs() const { return n_pairs_; }

 private:
  void add() {
    const BodyId free = lowest_free();
    const BodyId got = scene_->add(made_.bodies[random_() % made_.bodies.size()], random_place(made_, random_));
    EXPECT_EQ(got, free);
  }
  // At once, and where they are is what they would be one by one.
  void add_some() {
    const ConvexBody& body = made_.bodies[random_() % made_.bodies.size()];
    std::vector<Pose> poses;
    for (std::uint64_t k = random_() % 4; k > 0; --k) poses.emplace_back(random_place(made_, random_));
    std::vector<BodyId> numbers;
    for (BodyId number = 0; numbers.size() < poses.size(); ++number) {
      if (!scene_->has(number)) numbers.push_back(number);
    }
    scene_->add(scene_->add_shape(body), poses);
    Scene alone = made_.box ? Scene(*made_.box) : Scene();
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const BodyId one = alone.add(body, poses[k]);
      EXPECT_EQ(scene_->shape_of(numbers[k]), scene_->add_shape(body));
      EXPECT_EQ(scene_->image(numbers[k]), alone.image(one));
      const Transformd its = scene_->pose(numbers[k]), wanted = alone.pose(one);
      EXPECT_EQ(std::memcmp(&its, &wanted, sizeof(its)), 0);
    }
  }
  BodyId lowest_free() const {
    BodyId free = 0;
    while (scene_->has(free)) ++free;
    return free;
  }
  Transformd nudged(BodyId body) {
    Transformd pose = scene_->pose(body);
    pose.translation = pose.translation + (1e-3 * made_.size) * random_direction(random_);
    return pose;
  }
  void nudge(BodyId body) { scene_->move(body, nudged(body)); }
  void move_all() {
    std::vector<Pose> poses;
    for (BodyId body = 0; body < scene_->end(); ++body) poses.push_back(nudged(body));
    scene_->move_all(poses);
  }

  std::mt19937_64 random_;
  RandomScene made_;
  double skin_;
  std::optional<Scene> scene_;
  std::size_t n_pairs_ = 0;
};

class Changes : public testing::TestWithParam<std::tuple<SceneStratum, bool>> {};

TEST_P(Changes, LeaveNothingBehind) {
  const auto [stratum, has_skin] = GetParam();
  std::size_t n_pairs = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    ChangingScene scene(stratum, has_skin ? 0.2 : 0.0, seed);
    for (int k = 0; k < 40; ++k) {
      scene.change();
      ASSERT_EQ(scene.ask(k % 20 == 19), "") << "seed " << seed << ", change " << k;
    }
    n_pairs += scene.n_pairs();
  }
  EXPECT_GT(n_pairs, 100u);
}

INSTANTIATE_TEST_SUITE_P(Strata, Changes, testing::Combine(testing::ValuesIn(kSceneStrata), testing::Bool()),
                         [](const auto& tested) {
                           return std::string(name_of(std::get<0>(tested.param))) +
                                  (std::get<1>(tested.param) ? "_with_skin" : "");
                         });

// A body that comes after the scene has begun to remember its pairs, and then moves.
TEST(Changes, ABodyThatComesLaterIsRememberedToo) {
  std::mt19937_64 random(1);
  const ConvexBody body = displaced_hull(20, 0.5, {}, random);
  Scene scene(PeriodicBox::cube(8.0), {.skin = 0.3});
  ScenePairs found;
  for (int k = 0; k < 200; ++k) {
    Transformd pose = random_rotation(random);
    pose.translation = 4.0 * random_direction(random);
    const BodyId added = scene.add(body, pose);
    pose.translation = pose.translation + 0.01 * random_direction(random);
    scene.move(added, pose);
    if (k % 10 == 0) scene.overlapping_pairs(found);
  }
  EXPECT_EQ(fault_of_pairs(scene, every_pair(scene)), "");
}

TEST(Changes, AMovedFromSceneGoesOn) {
  std::mt19937_64 random(2);
  const RandomScene made = random_scene(SceneStratum::mixed, random);
  Scene first = made.scene();
  const EveryPair every = every_pair(first);
  ASSERT_EQ(fault_of_pairs(first, every), "");
  Scene second = std::move(first);
  EXPECT_EQ(fault_of_pairs(second, every), "");
  first = made.scene();
  EXPECT_EQ(fault_of_pairs(first, every), "");
}

TEST(Changes, AnEmptySceneAnswersToo) {
  for (const bool is_periodic : {false, true}) {
    Scene scene = is_periodic ? Scene(PeriodicBox::cube(2.0)) : Scene();
    EXPECT_EQ(fault_of_pairs(scene, {}), "");
    EXPECT_EQ(fault_within(scene, 1.0), "");
    EXPECT_EQ(fault_of_clusters(scene, {}), "");
    scene.move_all({});
    EXPECT_EQ(fault_of_pairs(scene, {}), "");
  }
}

}  // namespace
}  // namespace vex
