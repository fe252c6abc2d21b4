#include "engine/support/combinators.h"

#include <gtest/gtest.h>

#include "shapes/sphere.h"
#include "tests/referees/array_lanes.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

TEST(Posed, GivesTheFarthestPlacedVertex) {
  std::mt19937_64 random(1);
  const TestPolytope hull = test_point_hull(40, {3, 2, 1}, 5);
  for (int k = 0; k < 500; ++k) {
    Transformd pose = random_rotation(random);
    pose.translation = 5.0 * random_direction(random);
    const Vec3d dir = random_direction(random);
    const Vec3d found = Posed<ConvexBody, double>(hull.body, pose).support(dir);
    double farthest = -1e300;
    bool is_a_placed_vertex = false;
    for (const Vec3d& v : hull.vertices) {
      const Vec3d p = pose(v);
      farthest = std::max(farthest, dot(p, dir));
      is_a_placed_vertex = is_a_placed_vertex || (p.x == found.x && p.y == found.y && p.z == found.z);
    }
    EXPECT_TRUE(is_a_placed_vertex) << "a support point of a polytope is a placed vertex, bit for bit";
    EXPECT_NEAR(dot(found, dir), farthest, 1e-14);
  }
}

TEST(MinkowskiDifference, HasTheSumOfSupportFunctions) {
  std::mt19937_64 random(2);
  const Sphere a(2.0);
  const Box b(1, 2, 3);
  const MinkowskiDifference difference(a, b);
  for (int k = 0; k < 100; ++k) {
    const Vec3d dir = random_direction(random);
    const double expected = 2.0 * norm(dir) + 0.5 * (std::fabs(dir.x) + 2 * std::fabs(dir.y) + 3 * std::fabs(dir.z));
    EXPECT_NEAR(dot(difference.support(dir), dir), expected, 1e-14);
  }
}

TEST(Inflated, AddsTheBallToSupportAndRadii) {
  std::mt19937_64 random(3);
  const Inflated<Box> rounded(Box(1, 2, 3), 0.5);
  for (int k = 0; k < 100; ++k) {
    const Vec3d dir = random_direction(random);
    EXPECT_NEAR(dot(rounded.support(dir), dir), dot(Box(1, 2, 3).support(dir), dir) + 0.5 * norm(dir), 1e-14);
  }
  EXPECT_NEAR(rounded.inradius(), 1.0, 1e-14);
  EXPECT_NEAR(rounded.circumradius(), std::sqrt(14.0) / 2 + 0.5, 1e-14);
  EXPECT_LE(rounded.inradius(), 1.0);
}

TEST(BallSupport, OfAZeroDirectionIsAPointNotANaN) {
  const Vec3d p = ball_support(2.0, Vec3d{});
  EXPECT_EQ(norm(p), 0.0);
}

TEST(Combinators, LanesGiveTheBitsOfOneLane) {
  constexpr int W = 4;
  using L = ArrayLanes<W>;
  std::mt19937_64 random(4);
  const Inflated<Box> rounded(Box(1, 2, 3), 0.5);
  const TestPolytope hull = test_point_hull(30, {1, 1, 1}, 6);
  const Polytope polytope(hull.vertices, {}, 0.0);
  for (int round = 0; round < 50; ++round) {
    std::array<Transformd, W> poses;
    std::array<Vec3d, W> dirs;
    Transform<L> pose;
    Vec3<L> dir;
    for (std::size_t k = 0; k < W; ++k) {
      poses[k] = random_rotation(random);
      poses[k].translation = random_direction(random);
      dirs[k] = random_direction(random);
      set_lane(pose, k, poses[k]);
      set_lane(dir, k, dirs[k]);
    }
    const Posed<Polytope, L> wide_b(polytope, pose);
    const Vec3<L> wide = MinkowskiDifference(rounded, wide_b).support(dir);
    for (std::size_t k = 0; k < W; ++k) {
      const Posed<Polytope, double> one_b(polytope, poses[k]);
      const Vec3d one = MinkowskiDifference(rounded, one_b).support(dirs[k]);
      EXPECT_EQ(bits_of(wide.x.lane[k]), bits_of(one.x));
      EXPECT_EQ(bits_of(wide.y.lane[k]), bits_of(one.y));
      EXPECT_EQ(bits_of(wide.z.lane[k]), bits_of(one.z));
    }
  }
}

}  // namespace
}  // namespace vex
