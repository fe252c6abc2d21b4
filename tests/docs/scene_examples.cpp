// The examples of docs/scenes.md, compiled and run: the test below holds the guide to this file, block by block.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <string>
#include <vector>

// [headers]
#include "engine/scene/scene.h"
#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/sphere.h"
// [end]
#include "engine/numeric/quaternion.h"
#include "tests/docs/example_guide.h"

namespace {

std::vector<vex::Transformd> random_poses(int n) {
  std::mt19937_64 draw(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-6.0, 6.0);
  std::vector<vex::Transformd> poses;
  for (int k = 0; k < n; ++k) {
    vex::Transformd pose = vex::rotation_from_quaternion(normal(draw), normal(draw), normal(draw), normal(draw));
    pose.translation = {uniform(draw), uniform(draw), uniform(draw)};
    poses.push_back(pose);
  }
  return poses;
}

vex::Pose pushed(const vex::Pose& pose) {
  vex::Transformd next = pose.a_from_b();
  next.translation.x += 0.01;
  return next;
}

TEST(SceneExamples, InTheOrderOfTheGuide) {
  const std::vector<vex::Transformd> poses = random_poses(60);
  testing::internal::CaptureStdout();
  // [pairs]
  vex::Scene scene(vex::PeriodicBox::cube(12.0), {.n_threads = 2});  // or vex::Scene scene; for open space
  const vex::ShapeId rod = scene.add_shape(vex::Capsule(4.0, 0.5));
  for (const vex::Transformd& pose : poses) scene.add(rod, pose);  // numbers 0, 1, 2, ...
  vex::ScenePairs found;                                           // your buffer: it keeps its memory
  scene.overlapping_pairs(found);
  for (const vex::ScenePair& pair : found.pairs) std::printf("%u %u\n", pair.a, pair.b);
  // [end]
  EXPECT_FALSE(found.pairs.empty());
  EXPECT_TRUE(found.undecided.empty());
  const std::size_t n_overlapping = found.pairs.size();

  // [within]
  scene.pairs_within(0.1, found);  // proven, and no distance is computed
  vex::SceneDistances near;
  scene.distances_within(0.1, near);  // with bounds, points and normal of each, in a's frame
  vex::SceneManifolds touching;
  scene.contact_manifolds(touching);                                           // where faces touch, on lines, at points
  const bool is_free = scene.any_overlap().outcome == vex::Outcome::disjoint;  // ends at the first overlap
  // [end]
  EXPECT_GE(found.pairs.size(), n_overlapping);
  EXPECT_EQ(near.entries.size(), found.pairs.size());
  EXPECT_EQ(touching.entries.size(), n_overlapping);
  EXPECT_FALSE(is_free);

  const vex::Transformd pose = poses[3];
  // [one]
  scene.overlaps_of(7, found);                                                   // the pairs of body 7
  const bool may_move = scene.would_overlap(7, pose) == vex::Outcome::disjoint;  // a trial move of Monte Carlo
  if (may_move) scene.move(7, pose);
  const vex::SceneNeighbour next = scene.nearest(7);        // which, which copy of it, and how far
  scene.overlaps_of(vex::Box(1.0, 1.0, 1.0), pose, found);  // of what is not in the scene
  // [end]
  EXPECT_FALSE(may_move);
  EXPECT_NE(next.body, vex::kNoBody);
  EXPECT_FALSE(found.pairs.empty());

  // [added]
  vex::Scene growing(vex::PeriodicBox::cube(12.0));
  const vex::ShapeId stick = growing.add_shape(vex::Capsule(4.0, 0.5));
  vex::Clusters joined;
  joined.reset(0);  // of no bodies yet
  const std::vector<vex::Pose> many(poses.begin(), poses.end());
  growing.add(stick, many);  // all of them, or none where one is refused
  joined.add(many.size());
  growing.overlaps_of_added(0, found, &joined);  // joined knows the pairs now; found.pairs are those that changed it
  growing.clear();                               // its bodies: shapes and memory stay
  // [end]
  EXPECT_FALSE(found.pairs.empty());
  EXPECT_EQ(growing.size(), 0u);

  // [rays]
  const vex::SceneHit hit = scene.cast_ray({0.0, 0.0, 6.0}, {0.0, 0.0, -1.0}, 12.0);
  if (hit.body != vex::kNoBody) std::printf("body %u at t = %.17g\n", hit.body, hit.contact.time);
  const vex::SceneHit swept = scene.linear_cast(vex::Sphere(0.5), pose, {1.0, 0.0, 0.0}, 3.0);
  // [end]
  EXPECT_EQ(swept.contact.time, 0.0);

  std::vector<vex::Pose> moved(poses.begin(), poses.end());
  // [steps]
  scene.set({.n_threads = 2, .skin = 0.2});
  for (int step = 0; step < 10; ++step) {
    for (vex::Pose& at : moved) at = pushed(at);  // your own dynamics
    scene.move_all(moved);
    scene.overlapping_pairs(found);
  }
  const auto& unmoved = found.counts[vex::SceneStage::unmoved];  // seen, settled
  // [end]
  EXPECT_GT(unmoved.settled, 0u);
  EXPECT_EQ(found.pairs.size(), n_overlapping);

  // [clusters]
  vex::Clusters clusters;
  scene.clusters(clusters);
  const std::vector<std::uint32_t> label = clusters.labels();  // of each body, 0, 1, 2, ...
  const bool percolates_along_x = clusters.wraps(0)[0];        // whether body 0's cluster goes around the box
  // [end]
  EXPECT_EQ(label.size(), poses.size());
  EXPECT_EQ(label[0], 0u);
  EXPECT_EQ(percolates_along_x, clusters.wraps(clusters.root(0))[0]);
  EXPECT_FALSE(testing::internal::GetCapturedStdout().empty());
}

TEST(SceneGuide, HasOnlyExamplesThatAreCompiledAndAllOfThem) {
  const std::vector<std::string> compiled = vex::test::compiled_examples("tests/docs/scene_examples.cpp");
  EXPECT_EQ(compiled.size(), 8u);
  EXPECT_EQ(vex::test::shown_examples("docs/scenes.md"), compiled);
}

}  // namespace
