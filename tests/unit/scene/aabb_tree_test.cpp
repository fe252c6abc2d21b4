#include "engine/scene/aabb_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "tests/unit/scene/box_scenes.h"

namespace vex {
namespace {

using Found = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;

std::vector<Found> found_pairs(const AabbTree& tree, const std::vector<Vec3d>& shifts, std::size_t n_wanted) {
  std::vector<AabbTree::PairTask> tasks;
  tree.pair_tasks(shifts, n_wanted, tasks);
  std::vector<Found> found;
  for (const AabbTree::PairTask& task : tasks) {
    tree.pairs(task, shifts[task.shift], [&](std::uint32_t i, std::uint32_t j) {
      if (task.shift == 0 && i > j) std::swap(i, j);
      found.emplace_back(task.shift, i, j);
    });
  }
  std::sort(found.begin(), found.end());
  return found;
}

// Every pair that meets is among the found, each once; what is found besides nearly meets.
void expect_every_pair(const std::vector<Aabb>& boxes, const std::vector<Vec3d>& shifts,
                       const std::vector<Found>& found) {
  ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end()) << "twice";
  std::vector<Found> meeting;
  for (std::uint32_t s = 0; s < shifts.size(); ++s) {
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      for (std::uint32_t j = s == 0 ? i + 1 : 0; j < boxes.size(); ++j) {
        if (boxes[i].meets({boxes[j].lower + shifts[s], boxes[j].upper + shifts[s]})) meeting.emplace_back(s, i, j);
      }
    }
  }
  ASSERT_TRUE(std::includes(found.begin(), found.end(), meeting.begin(), meeting.end())) << "missed";
  for (const auto& [s, i, j] : found) {
    ASSERT_TRUE(s != 0 || i < j);
    const Aabb a = widened(boxes[i], step(boxes[i])), b = widened(boxes[j], step(boxes[j]));
    const Vec3d shift = shifts[s];
    const Aabb image = widened({b.lower + shift, b.upper + shift}, step({shift, shift}));
    ASSERT_TRUE(a.meets(image)) << i << " " << j << ": apart";
  }
}

TEST(AabbTree, FindsEveryPairThatMeetsOnce) {
  for (const BoxScene& scene : box_scenes()) {
    SCOPED_TRACE(scene.name);
    AabbTree tree;
    tree.build(scene.boxes);
    EXPECT_EQ(tree.size(), scene.boxes.size());
    const std::vector<Found> found = found_pairs(tree, {Vec3d{}}, 1);
    ASSERT_NO_FATAL_FAILURE(expect_every_pair(scene.boxes, {Vec3d{}}, found));
    for (const std::size_t n_wanted : {0u, 2u, 5u, 60u, 1000u, 100000u}) {
      ASSERT_EQ(found_pairs(tree, {Vec3d{}}, n_wanted), found) << n_wanted;
    }
  }
}

TEST(AabbTree, FindsThePairsWithCopiesThatAreMoved) {
  for (const BoxScene& scene : box_scenes()) {
    SCOPED_TRACE(scene.name);
    AabbTree tree;
    tree.build(scene.boxes);
    std::vector<Vec3d> shifts = {Vec3d{}};
    for (const double by : {1.0, 0.1, 0.001, 0x1p-3}) {
      const double d = by * scene.edge;
      shifts.insert(shifts.end(), {{d, 0, 0}, {0, d, -d}, {0.3 * d, -d, d}});
    }
    const std::vector<Found> found = found_pairs(tree, shifts, 1);
    ASSERT_NO_FATAL_FAILURE(expect_every_pair(scene.boxes, shifts, found));
    ASSERT_EQ(found_pairs(tree, shifts, 300), found);
  }
}

TEST(AabbTree, GivesAboutAsManyTasksAsAreWanted) {
  Random random(5);
  AabbTree tree;
  tree.build(random_boxes(random, 20000, 30.0, 0.8, 1.2));
  std::vector<AabbTree::PairTask> tasks;
  const std::vector<Vec3d> shifts = {{}, {30, 0, 0}};
  for (const std::size_t n_wanted : {2u, 10u, 100u, 1000u}) {
    tree.pair_tasks(shifts, n_wanted, tasks);
    EXPECT_GE(tasks.size(), n_wanted);
    EXPECT_LE(tasks.size(), n_wanted + 72);
  }
}

TEST(AabbTree, IsTheSameForAnyNumberOfThreads) {
  Random random(6);
  const std::vector<Aabb> boxes =
      joined(random_boxes(random, 60000, 60.0, 0.5, 2.0), random_boxes(random, 3000, 60.0, 5, 20));
  AabbTree one;
  one.build(boxes, 1);
  for (const int n_threads : {2, 3, 8}) {
    AabbTree many;
    many.build(boxes, n_threads);
    ASSERT_TRUE(std::equal(one.order().begin(), one.order().end(), many.order().begin(), many.order().end()));
    std::vector<std::uint32_t> order(many.order().begin(), many.order().end());
    std::sort(order.begin(), order.end());
    for (std::uint32_t k = 0; k < order.size(); ++k) ASSERT_EQ(order[k], k);
  }
}

TEST(AabbTree, FitsItselfToBoxesThatMoved) {
  Random random(7);
  for (const BoxScene& scene : box_scenes()) {
    SCOPED_TRACE(scene.name);
    std::vector<Aabb> boxes = scene.boxes;
    AabbTree tree;
    tree.build(boxes);
    EXPECT_FALSE(tree.is_worn());
    for (const double far : {0.01, 1.0}) {
      for (Aabb& box : boxes) box = moved({box}, (far * scene.edge) * random_direction(random))[0];
      tree.refit(boxes, far < 1 ? 1 : 2);
      ASSERT_NO_FATAL_FAILURE(expect_every_pair(boxes, {Vec3d{}}, found_pairs(tree, {Vec3d{}}, 20)));
    }
    for (int k = 0; k < 50 && !boxes.empty(); ++k) {
      const auto leaf = static_cast<std::uint32_t>(random() % boxes.size());
      boxes[leaf] = random_box(random, scene.edge, 0.01 * scene.edge, 0.1 * scene.edge);
      tree.move(leaf, boxes[leaf]);
    }
    ASSERT_NO_FATAL_FAILURE(expect_every_pair(boxes, {Vec3d{}}, found_pairs(tree, {Vec3d{}}, 20)));
    const std::vector<Found> after_moves = found_pairs(tree, {Vec3d{}}, 1);
    tree.refit(boxes);
    EXPECT_EQ(found_pairs(tree, {Vec3d{}}, 1), after_moves) << "moves leave boxes that are not fitted";
  }
}

TEST(AabbTree, WearsWhenBoxesMixAndNotWhenTheyTremble) {
  Random random(8);
  std::vector<Aabb> boxes = random_boxes(random, 5000, 20.0, 0.9, 1.0);
  AabbTree tree;
  tree.build(boxes);
  for (Aabb& box : boxes) box = moved({box}, 0.05 * random_direction(random))[0];
  tree.refit(boxes);
  EXPECT_FALSE(tree.is_worn());
  for (Aabb& box : boxes) box = moved({box}, 5.0 * random_direction(random))[0];
  tree.refit(boxes);
  EXPECT_TRUE(tree.is_worn());
  tree.build(boxes);
  EXPECT_FALSE(tree.is_worn());
}

TEST(AabbTree, ThatWasNotBuiltHoldsNothing) {
  const AabbTree tree;
  EXPECT_EQ(tree.size(), 0u);
  EXPECT_FALSE(tree.is_worn());
  EXPECT_GT(tree.bounds().lower.x, tree.bounds().upper.x);
  EXPECT_TRUE(found_pairs(tree, {Vec3d{}, Vec3d{1, 0, 0}}, 10).empty());
  tree.meeting({{-1, -1, -1}, {1, 1, 1}}, [](std::uint32_t) { ADD_FAILURE(); });
}

TEST(AabbTree, BoundsHoldAllBoxes) {
  for (const BoxScene& scene : box_scenes()) {
    SCOPED_TRACE(scene.name);
    AabbTree tree;
    tree.build(scene.boxes);
    for (const Aabb& box : scene.boxes) {
      EXPECT_TRUE(tree.bounds().contains(box.lower) && tree.bounds().contains(box.upper));
    }
    if (scene.boxes.empty()) {
      EXPECT_GT(tree.bounds().lower.x, tree.bounds().upper.x);
    }
  }
}

}  // namespace
}  // namespace vex
