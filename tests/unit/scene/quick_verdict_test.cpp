#include "engine/scene/quick_verdict.h"

#include <gtest/gtest.h>

#include "engine/query/overlap.h"
#include "shapes/ellipsoid.h"
#include "shapes/sphere.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

TEST(QuickVerdict, NeverContradictsTheQuery) {
  std::mt19937_64 random(1);
  const std::vector<ConvexBody> bodies = {Sphere(1.0), Box(1, 2, 3), Ellipsoid(3, 1, 2),
                                          test_point_hull(40, {2, 1, 1}, 2).body, test_tetrahedron(1.0).body};
  int n_outer = 0, n_inner = 0;
  for (const ConvexBody& a : bodies) {
    for (const ConvexBody& b : bodies) {
      const QuickVerdict quick(a, b, kDrawnRotationError);
      const Domain domain = box_domain(a, b);
      for (int k = 0; k < 400; ++k) {
        const Transformd pose = random_pose(random, domain, b);
        const QuickVerdict::Answer<double> answer = quick(pose);
        ASSERT_FALSE(answer.disjoint && answer.overlap);
        if (!answer.disjoint && !answer.overlap) continue;
        (answer.disjoint ? n_outer : n_inner) += 1;
        const Outcome outcome = overlap(a, b, pose).outcome;
        if (outcome == Outcome::undecided) continue;
        ASSERT_EQ(outcome, answer.overlap ? Outcome::overlap : Outcome::disjoint);
      }
    }
  }
  EXPECT_GT(n_outer, 500);
  EXPECT_GT(n_inner, 500);
}

TEST(QuickVerdict, LeavesWhatTouchesToTheQuery) {
  const Sphere a(1.0), b(2.0);
  const QuickVerdict quick(a, b, kDrawnRotationError);
  for (const double distance : {3.0, std::nextafter(3.0, 4.0), std::nextafter(3.0, 2.0)}) {
    Transformd pose;
    pose.translation = {distance, 0, 0};
    EXPECT_FALSE(quick(pose).disjoint);
    EXPECT_FALSE(quick(pose).overlap);
  }
  Transformd pose;
  pose.translation = {3.0 + 1e-10, 0, 0};
  EXPECT_TRUE(quick(pose).disjoint);
  pose.translation = {3.0 - 1e-10, 0, 0};
  EXPECT_TRUE(quick(pose).overlap);
}

TEST(QuickVerdict, CountsTheRoundingOfAFarAwayCentre) {
  // Two unit balls a hair apart, but at 10^9 from their origins, where the distance itself is only known to 1e-7.
  const std::vector<Vec3d> far = {{1e9 - 1, 0, 0}, {1e9 + 1, 0, 0}, {1e9, 1, 0},
                                  {1e9, -1, 0},    {1e9, 0, 1},     {1e9, 0, -1}};
  const ConvexBody a = Polytope(far, {1e9, 0, 0}, 0.57);
  const QuickVerdict quick(a, a, kDrawnRotationError);
  Transformd pose;
  pose.translation = {2.0 + 1e-9, 0, 0};
  EXPECT_FALSE(quick(pose).disjoint);
}

}  // namespace
}  // namespace vex
