#include "engine/sampling/domain.h"

#include <gtest/gtest.h>

#include <numbers>

#include "engine/query/overlap.h"
#include "engine/sampling/poses/fitted_domain.h"
#include "shapes/any_shape.h"
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

bool is_flat(const char* a, const char* b, const OrientationLaw& law) {
  return difference_is_flat(parse_shape(a).body, parse_shape(b).body, law);
}

TEST(DifferenceIsFlat, OfParallelPlatesUnderTheLawsThatKeepThemParallel) {
  const OrientationLaw about_normal = OrientationLaw::fixed(1, 0, 0, 0.7);
  const OrientationLaw upside_down = OrientationLaw::fixed(0, 1, 0.3, 0);
  for (const OrientationLaw& law : {OrientationLaw::aligned(), OrientationLaw::fixed(1, 0, 0, 0), about_normal,
                                    upside_down, OrientationLaw::cone(0)}) {
    EXPECT_TRUE(is_flat("plate:1,2", "plate:1,2", law)) << law.name();
    EXPECT_TRUE(is_flat("plate:1,2", "disc:1", law)) << law.name();
    EXPECT_FALSE(is_flat("plate:1,2", "box:1,1,1e-6", law)) << law.name();
    EXPECT_FALSE(is_flat("box:1,1,1", "plate:1,2", law)) << law.name();
  }
  for (const OrientationLaw& law : {OrientationLaw::isotropic(), OrientationLaw::cone(10), OrientationLaw::cone(1e-3),
                                    OrientationLaw::onsager(1e6), OrientationLaw::fixed(1, 0.1, 0, 0)}) {
    EXPECT_FALSE(is_flat("plate:1,2", "disc:1", law)) << law.name();
  }
}

TEST(DifferenceIsFlat, OfANeedleInAPlatesPlane) {
  const OrientationLaw lying = OrientationLaw::fixed(1, 1, 0, 0);     // z to -y
  const OrientationLaw turned = OrientationLaw::fixed(1, 0.4, 1, 0);  // neither along nor across
  EXPECT_TRUE(is_flat("plate:1,2", "needle:2", lying));
  EXPECT_TRUE(is_flat("needle:2", "plate:1,2", lying)) << "whichever comes first";
  EXPECT_FALSE(is_flat("plate:1,2", "needle:2", OrientationLaw::aligned())) << "it sticks through";
  EXPECT_FALSE(is_flat("plate:1,2", "needle:2", OrientationLaw::cone(0)));
  EXPECT_FALSE(is_flat("plate:1,2", "needle:2", turned));
  EXPECT_TRUE(is_flat("needle:1", "needle:2", OrientationLaw::aligned()));
  EXPECT_TRUE(is_flat("needle:1", "needle:2", OrientationLaw::cone(0)));
}

TEST(Domain, FittedSaysSoAndIsNamed) {
  const Domain domain = fitted_domain(Box(1, 2, 3), Sphere(0.5));
  EXPECT_EQ(name_of(domain.kind), "fitted");
  EXPECT_NEAR(domain.volume, 24.0, 1e-9);
  EXPECT_GT(domain.volume, 24.0);
}

}  // namespace
}  // namespace vex
