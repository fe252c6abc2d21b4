// Zonotopes against what the searches find, which know nothing of vectors.
#include "engine/query/search/zonotope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shapes/any_shape.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

struct Pair {
  const char *a, *b;
};

ConvexBody named_body(const char* text) { return parse_shape(text).body; }

DifferenceZonotope difference(const ConvexBody& a, const ConvexBody& b, const Transformd& pose) {
  return {a.generators().value(), b.generators().value(), pose};
}

std::optional<ZonotopeSeparation> nearest_of_pair(const ConvexBody& a, const ConvexBody& b, const Transformd& pose) {
  return nearest_of_segments(a.generators().value(), b.generators().value(), pose, query_error(a, b, pose));
}

// How far K reaches along a direction, and whether a point of A or of B is where it says, from the support mappings.
double reach(const ConvexBody& a, const ConvexBody& b, const Transformd& pose, const Vec3d& dir) {
  return dot(dir, a.core_support(dir) - pose(b.core_support(-pose.direction_to_b(dir))));
}
double outside(const ConvexBody& a, const Vec3d& point, const Vec3d& dir) {
  return dot(dir, point - a.core_support(dir));
}

TEST(Zonotope, HasTheNearestPointsOfSegments) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (const auto& [name_a, name_b] :
       {Pair{"sphere:1", "sphere:0.5"}, Pair{"sphere:1", "needle:2"}, Pair{"capsule:1,0.2", "needle:2"},
        Pair{"needle:2", "sphere:0.25"}, Pair{"plate:1,2", "sphere:0.5"}, Pair{"sphere:0.5", "plate:2,1"}}) {
    const ConvexBody a = named_body(name_a), b = named_body(name_b);
    const Domain domain = ball_domain(a, b);
    int n_answers = 0;
    for (int k = 0; k < 2000; ++k) {
      const Transformd pose = random_pose(random, domain, b);
      const std::optional<ZonotopeSeparation> found = nearest_of_pair(a, b, pose);
      if (!found) continue;
      ++n_answers;
      ASSERT_NEAR(norm(found->normal), 1.0, 1e-15);
      ASSERT_LE(found->bounds.lower, found->bounds.upper);
      ASSERT_LE(found->bounds.width(), 1e-13 * (a.circumradius() + b.circumradius()))
          << name_a << " " << name_b << " " << k;
      ASSERT_NEAR(-reach(a, b, pose, found->normal), found->distance, 1e-14);
      ASSERT_LE(norm((found->point_b - found->point_a) - found->distance * found->normal), 1e-14);
      ASSERT_LE(norm(pose(found->own_point_b) - found->point_b), 1e-14);
      for (int j = 0; j < 3; ++j) {
        const Vec3d dir = unit_along(Vec3d{normal(random), normal(random), normal(random)});
        ASSERT_LE(outside(a, found->point_a, dir), 1e-14);
        ASSERT_LE(outside(b, found->own_point_b, dir), 1e-14);
      }
    }
    EXPECT_GT(n_answers, 1990) << name_a << " " << name_b;
  }
}

TEST(Zonotope, LeavesSegmentsThatCrossToTheSearch) {
  const ConvexBody a = named_body("needle:2"), b = named_body("needle:2");
  Transformd pose{{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.25, 0.0, 0.5}};
  EXPECT_FALSE(nearest_of_pair(a, b, pose));
  pose.translation.y = 1e-9;
  const auto found = nearest_of_pair(a, b, pose);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance, 1e-9, 1e-24);
  EXPECT_NEAR(found->normal.y, 1.0, 1e-15);
}

TEST(Zonotope, FindsTheShortestWayOutByItsFaces) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  for (const auto& [name_a, name_b] :
       {Pair{"box:1,2,3", "box:1,1,1"}, Pair{"plate:1,2", "box:0.5,1,2"}, Pair{"plate:2,2", "plate:1,2"},
        Pair{"box:1,1,0.01", "needle:2"}, Pair{"plate:2,2", "needle:2"}, Pair{"box:1,1,1", "sphere:0.1"}}) {
    const ConvexBody a = named_body(name_a), b = named_body(name_b);
    const Domain domain = ball_domain(a, b);
    int n_deep = 0, n_apart = 0;
    for (int k = 0; k < 2000; ++k) {
      const Transformd pose = random_pose(random, domain, b);
      const std::optional<ZonotopeSeparation> found = deepest_of_faces(difference(a, b, pose), query_error(a, b, pose));
      if (!found) continue;
      ASSERT_NEAR(norm(found->normal), 1.0, 1e-14);
      ASSERT_NEAR(-reach(a, b, pose, found->normal), found->distance, 1e-14);
      if (found->bounds.lower > 0.0) {
        ++n_apart;
        continue;
      }
      ++n_deep;
      ASSERT_LT(found->bounds.upper, 0.0);
      ASSERT_LE(found->bounds.width(), 1e-10);
      ASSERT_LE(norm((found->point_b - found->point_a) - found->distance * found->normal), 1e-13);
      for (int j = 0; j < 60; ++j) {
        const Vec3d any{normal(random), normal(random), normal(random)};
        const Vec3d dir = (1.0 / norm(any)) * any;
        ASSERT_GE(reach(a, b, pose, dir), -found->bounds.upper - 1e-14) << name_a << " " << name_b << " " << k;
        ASSERT_LE(outside(a, found->point_a, dir), 1e-13);
        const Vec3d own = pose.direction_to_b(dir);
        ASSERT_LE(dot(dir, found->point_b - pose.translation) - dot(own, b.core_support(own)), 1e-13);
      }
    }
    EXPECT_GT(n_deep, 30) << name_a << " " << name_b;
    EXPECT_GT(n_apart, 100) << name_a << " " << name_b;
  }
}

TEST(Zonotope, PutsTheFeetOfParallelBoxesIntoBothFaces) {
  const ConvexBody a = named_body("box:2,2,2"), b = named_body("box:1,1,1");
  for (const double x : {0.0, 0.5, 0.9, -0.7}) {
    for (const double y : {0.0, -0.25, 1.2}) {
      const Transformd pose{.translation = {x, y, 1.4}};
      const auto found = deepest_of_faces(difference(a, b, pose), query_error(a, b, pose));
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->distance, -0.1, 1e-15);
      EXPECT_NEAR(found->normal.z, 1.0, 1e-15);
      EXPECT_NEAR(found->point_a.x, found->point_b.x, 1e-15);
      EXPECT_NEAR(found->point_a.y, found->point_b.y, 1e-15);
      EXPECT_LE(std::fabs(found->point_a.x), 1.0);
      EXPECT_LE(std::fabs(found->point_a.y), 1.0);
      EXPECT_LE(std::fabs(found->point_b.x - x), 0.5);
      EXPECT_LE(std::fabs(found->point_b.y - y), 0.5);
      EXPECT_NEAR(found->point_a.z, 1.0, 1e-15);
      EXPECT_NEAR(found->point_b.z, 0.9, 1e-15);
    }
  }
}

TEST(Zonotope, LeavesFlatOnesToTheSearch) {
  const ConvexBody a = named_body("plate:2,2");
  const Transformd pose{.translation = {0.5, 0.5, 0.0}};
  EXPECT_FALSE(deepest_of_faces(difference(a, a, pose), query_error(a, a, pose)));
}

}  // namespace
}  // namespace vex
