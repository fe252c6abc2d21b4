// Searches of a tree of boxes for what meets, is near to or lies on the way of something, held against all boxes.
#include "engine/scene/aabb_tree_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "tests/unit/scene/box_scenes.h"

namespace vex {
namespace {

TEST(AabbTree, FindsWhatMeetsABox) {
  Random random(9);
  for (const BoxScene& scene : box_scenes()) {
    SCOPED_TRACE(scene.name);
    AabbTree tree;
    tree.build(scene.boxes);
    for (int k = 0; k < 60; ++k) {
      const Aabb box = k % 2 == 1 && !scene.boxes.empty()
                           ? scene.boxes[random() % scene.boxes.size()]
                           : random_box(random, scene.edge, 0.01 * scene.edge, scene.edge);
      std::set<std::uint32_t> found;
      tree.meeting(box, [&](std::uint32_t leaf) { ASSERT_TRUE(found.insert(leaf).second) << "twice"; });
      for (std::uint32_t leaf = 0; leaf < scene.boxes.size(); ++leaf) {
        const Aabb& other = scene.boxes[leaf];
        const bool is_found = found.contains(leaf);
        ASSERT_TRUE(is_found || !box.meets(other)) << "missed";
        ASSERT_TRUE(!is_found || widened(box, step(box)).meets(widened(other, step(other)))) << "apart";
      }
    }
  }
}

double gap(double low, double up, double other_low, double other_up) {
  return std::fmax(0.0, std::fmax(other_low - up, low - other_up));
}
double distance(const Aabb& a, const Aabb& b) {
  return safe_norm({gap(a.lower.x, a.upper.x, b.lower.x, b.upper.x), gap(a.lower.y, a.upper.y, b.lower.y, b.upper.y),
                    gap(a.lower.z, a.upper.z, b.lower.z, b.upper.z)});
}

TEST(AabbTree, FindsWhatIsWithinADistance) {
  Random random(10);
  for (const BoxScene& scene : box_scenes()) {
    SCOPED_TRACE(scene.name);
    AabbTree tree;
    tree.build(scene.boxes);
    for (int k = 0; k < 60; ++k) {
      const Aabb box = random_box(random, scene.edge, 0.001 * scene.edge, 0.1 * scene.edge);
      const double bound = k % 3 == 0 ? 0.0 : scene.edge * between(random, 0, 0.5);
      std::set<std::uint32_t> found;
      tree.by_distance(box, bound, [&](std::uint32_t leaf, double so_far) {
        EXPECT_EQ(so_far, bound);
        EXPECT_TRUE(found.insert(leaf).second) << "twice";
        return so_far;
      });
      for (std::uint32_t leaf = 0; leaf < scene.boxes.size(); ++leaf) {
        const double d = distance(box, scene.boxes[leaf]);
        ASSERT_TRUE(found.contains(leaf) || d > bound) << "missed";
        ASSERT_TRUE(!found.contains(leaf) || d <= bound * (1 + 1e-14) + 4 * step(scene.boxes[leaf])) << "far";
      }
      bool is_asked = false;
      tree.by_distance(box, -1.0, [&](std::uint32_t, double so_far) {
        is_asked = true;
        return so_far;
      });
      EXPECT_FALSE(is_asked);
    }
  }
}

TEST(AabbTree, FindsTheNearestBoxAndLooksAtFew) {
  Random random(11);
  std::size_t n_visits = 0, n_queries = 0;
  for (const BoxScene& scene : box_scenes()) {
    SCOPED_TRACE(scene.name);
    AabbTree tree;
    tree.build(scene.boxes);
    for (int k = 0; k < 60; ++k) {
      const Aabb box = random_box(random, scene.edge, 0.0001 * scene.edge, 0.001 * scene.edge);
      double nearest = HUGE_VAL, expected = HUGE_VAL;
      std::size_t n = 0;
      tree.by_distance(box, HUGE_VAL, [&](std::uint32_t leaf, double) {
        ++n;
        return nearest = std::fmin(nearest, distance(box, scene.boxes[leaf]));
      });
      for (const Aabb& other : scene.boxes) expected = std::fmin(expected, distance(box, other));
      ASSERT_EQ(nearest, expected);
      if (std::string(scene.name) == "alike") {
        n_visits += n;
        ++n_queries;
      }
    }
  }
  EXPECT_LT(n_visits, 60 * n_queries);
}

// Whether the ray meets the box: in long double, whose error is that of 2^-11 of a double's.
enum class Meets { no, hardly, yes };
Meets ray_meets(const Vec3d& origin, const Vec3d& dir, const Vec3d& margin, double until, const Aabb& box,
                double widening) {
  const auto meets = [&](long double wide) {
    long double enters = 0, leaves = until;
    const double o[3] = {origin.x, origin.y, origin.z}, d[3] = {dir.x, dir.y, dir.z},
                 m[3] = {margin.x, margin.y, margin.z};
    const double lower[3] = {box.lower.x, box.lower.y, box.lower.z}, upper[3] = {box.upper.x, box.upper.y, box.upper.z};
    for (int k = 0; k < 3; ++k) {
      const long double low = static_cast<long double>(lower[k]) - m[k] - wide - o[k];
      const long double up = static_cast<long double>(upper[k]) + m[k] + wide - o[k];
      if (d[k] == 0.0) {
        if (low > 0 || up < 0) return false;
        continue;
      }
      enters = std::max(enters, std::min(low / d[k], up / d[k]));
      leaves = std::min(leaves, std::max(low / d[k], up / d[k]));
    }
    return enters <= leaves;
  };
  return meets(0) ? Meets::yes : meets(widening) ? Meets::hardly : Meets::no;
}

TEST(AabbTree, FindsWhatARayMeets) {
  Random random(12);
  std::size_t n_met = 0;
  for (const BoxScene& scene : box_scenes()) {
    SCOPED_TRACE(scene.name);
    AabbTree tree;
    tree.build(scene.boxes);
    for (int k = 0; k < 200; ++k) {
      const double edge = scene.edge;
      Vec3d origin{between(random, -edge, 2 * edge), between(random, -edge, 2 * edge),
                   between(random, -edge, 2 * edge)};
      // From a corner of a box or from anywhere; along an axis, along a face, or anywhere.
      if (k % 4 == 0 && !scene.boxes.empty()) origin = scene.boxes[random() % scene.boxes.size()].upper;
      Vec3d dir = random_direction(random);
      if (k % 3 == 1) dir.x = 0.0;
      if (k % 6 == 1) dir.z = -0.0;
      if (k % 7 == 1) dir.y = 1e-300;
      dir = (k % 5 == 0 ? 1e-200 : k % 5 == 1 ? 1e100 : 1.0) * dir;
      const Vec3d margin = (k % 2 == 0 ? 0.0 : 0.05 * edge) * Vec3d{1.0, 0.5, 2.0};
      const double until = k % 3 == 0 ? HUGE_VAL : between(random, 0, 2) * edge / norm(scaled_to_unit_exponent(dir));
      std::set<std::uint32_t> found;
      tree.along_ray(origin, dir, margin, until, [&](std::uint32_t leaf, double so_far) {
        EXPECT_EQ(so_far, until);
        EXPECT_TRUE(found.insert(leaf).second) << "twice";
        return so_far;
      });
      const auto largest = [](const Vec3d& p) {
        return std::fmax(std::fabs(p.x), std::fmax(std::fabs(p.y), std::fabs(p.z)));
      };
      for (std::uint32_t leaf = 0; leaf < scene.boxes.size(); ++leaf) {
        const Aabb& box = scene.boxes[leaf];
        const double widening = 4 * step(box) + 1e-13 * (largest(origin) + largest(margin));
        const Meets meets = ray_meets(origin, dir, margin, until, box, widening);
        n_met += meets == Meets::yes ? 1 : 0;
        ASSERT_TRUE(meets != Meets::yes || found.contains(leaf)) << "missed by ray " << k;
        ASSERT_TRUE(meets != Meets::no || !found.contains(leaf)) << "not met by ray " << k;
      }
    }
  }
  EXPECT_GT(n_met, 10000u);
}

TEST(AabbTree, FollowsARayToTheFirstBox) {
  Random random(13);
  AabbTree tree;
  const std::vector<Aabb> boxes = random_boxes(random, 3000, 20.0, 0.2, 0.6);
  tree.build(boxes);
  std::size_t n_visits = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3d origin{-5, between(random, 0, 20), between(random, 0, 20)}, dir{1, between(random, -0.2, 0.2), 0.1};
    const auto entry = [&](const Aabb& box) {
      double enters = 0, leaves = HUGE_VAL;
      const double o[3] = {origin.x, origin.y, origin.z}, d[3] = {dir.x, dir.y, dir.z};
      const double lower[3] = {box.lower.x, box.lower.y, box.lower.z},
                   upper[3] = {box.upper.x, box.upper.y, box.upper.z};
      for (int axis = 0; axis < 3; ++axis) {
        enters = std::fmax(enters, std::fmin((lower[axis] - o[axis]) / d[axis], (upper[axis] - o[axis]) / d[axis]));
        leaves = std::fmin(leaves, std::fmax((lower[axis] - o[axis]) / d[axis], (upper[axis] - o[axis]) / d[axis]));
      }
      return enters <= leaves ? enters : HUGE_VAL;
    };
    double first = HUGE_VAL, expected = HUGE_VAL;
    tree.along_ray(origin, dir, {}, HUGE_VAL, [&](std::uint32_t leaf, double) {
      ++n_visits;
      return first = std::fmin(first, entry(boxes[leaf]));
    });
    for (const Aabb& box : boxes) expected = std::fmin(expected, entry(box));
    ASSERT_EQ(first, expected);
  }
  EXPECT_LT(n_visits, 200u * 5u);
}

}  // namespace
}  // namespace vex
