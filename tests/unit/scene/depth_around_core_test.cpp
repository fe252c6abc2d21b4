#include "engine/scene/depth_around_core.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/referees/random_poses.h"

namespace vex {
namespace {

// Against all balls of the hull, as many as there are: x is in the hull as deep as in one of them.
TEST(DepthAroundCore, IsThatOfTheBallThatHoldsMost) {
  std::mt19937_64 random(1);
  constexpr int kBalls = 4000;
  int n_inside = 0, n_outside = 0;
  for (int k = 0; k < 2000; ++k) {
    const double core = 0.1 + 0.8 * random_in_unit_interval(random);
    const Vec3d tip = k % 10 == 0 ? Vec3d{} : 1.5 * random_direction(random);
    const Vec3d x = random_in_unit_interval(random) * tip + 0.7 * random_direction(random);
    double most = -HUGE_VAL;
    for (int j = 0; j <= kBalls; ++j) {
      const double part = static_cast<double>(j) / kBalls;
      most = std::max(most, (1.0 - part) * core - norm(x - part * tip));
    }
    const double depth = depth_around_core(x, tip, core);
    ASSERT_LE(depth, most + (norm(tip) + core) / kBalls);
    ASSERT_GE(depth, most - 1e-12);
    ++(depth > 0.0 ? n_inside : n_outside);
  }
  EXPECT_GT(n_inside, 500);
  EXPECT_GT(n_outside, 500);
}

TEST(DepthAroundCore, OfABallOrAWayAlongTheTipIsExact) {
  EXPECT_EQ(depth_around_core({0.5, 0.0, 0.0}, {}, 2.0), 1.5);
  EXPECT_EQ(depth_around_core({0.5, 0.0, 0.0}, {2.0, 0.0, 0.0}, 2.0), 1.5);  // the tip is on the ball
  EXPECT_EQ(depth_around_core({0.0, 0.0, 0.0}, {0.0, 4.0, 0.0}, 2.0), 2.0);
  EXPECT_NEAR(depth_around_core({0.0, 3.0, 0.0}, {0.0, 4.0, 0.0}, 2.0), 0.5, 1e-15);
  EXPECT_NEAR(depth_around_core({0.0, 4.0, 0.0}, {0.0, 4.0, 0.0}, 2.0), 0.0, 1e-15);
  EXPECT_LT(depth_around_core({0.0, 4.001, 0.0}, {0.0, 4.0, 0.0}, 2.0), 0.0);
}

}  // namespace
}  // namespace vex
