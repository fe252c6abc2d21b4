#include "engine/sampling/domain.h"

#include <gtest/gtest.h>

#include <numbers>

#include "engine/query/overlap.h"
#include "shapes/box.h"
#include "shapes/ellipsoid.h"
#include "shapes/sphere.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

TEST(Domain, BallHasTheSumOfCircumradii) {
  const Domain domain = ball_domain(Sphere(1.0), Sphere(2.0));
  EXPECT_NEAR(domain.radius, 3.0, 1e-11);
  EXPECT_GT(domain.radius, 3.0);
  EXPECT_NEAR(domain.volume, 4.0 / 3.0 * std::numbers::pi * 27.0, 1e-9);
}

TEST(Domain, BoxIsAsBoundingBoxWidenedByBsRadius) {
  const Domain domain = box_domain(Box(1, 2, 3), Sphere(0.5));
  EXPECT_NEAR(domain.half_extent.x, 1.0, 1e-11);
  EXPECT_NEAR(domain.half_extent.y, 1.5, 1e-11);
  EXPECT_NEAR(domain.half_extent.z, 2.0, 1e-11);
  EXPECT_NEAR(domain.volume, 24.0, 1e-9);
  EXPECT_GT(domain.volume, 24.0);
}

TEST(Domain, BestIsTheSmaller) {
  EXPECT_EQ(best_domain(Sphere(1.0), Sphere(1.0)).kind, Domain::Kind::ball);
  EXPECT_EQ(best_domain(Box(10, 1, 1), Sphere(0.1)).kind, Domain::Kind::box);
}

TEST(Domain, OutsideNothingOverlaps) {
  std::mt19937_64 random(1);
  const std::vector<ConvexBody> bodies = {Box(1, 2, 3), Ellipsoid(2, 1, 0.5), Sphere(1.0)};
  for (const ConvexBody& a : bodies) {
    for (const ConvexBody& b : bodies) {
      for (Domain domain : {ball_domain(a, b), box_domain(a, b)}) {
        for (int k = 0; k < 300; ++k) {
          Transformd pose = random_pose(random, domain, b);
          // Pushed out along x until it is just outside.
          const Vec3d from_middle = pose.translation - domain.middle;
          const double reach =
              domain.kind == Domain::Kind::ball
                  ? std::sqrt(std::max(0.0, domain.radius * domain.radius - from_middle.y * from_middle.y -
                                                from_middle.z * from_middle.z))
                  : domain.half_extent.x;
          pose.translation.x = domain.middle.x + std::copysign(reach * (1 + 1e-12) + 1e-12, from_middle.x);
          ASSERT_NE(overlap(a, b, pose).outcome, Outcome::overlap);
        }
      }
    }
  }
}

}  // namespace
}  // namespace vex
