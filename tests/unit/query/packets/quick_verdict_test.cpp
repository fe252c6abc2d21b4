#include "engine/query/packets/quick_verdict.h"

#include <gtest/gtest.h>

#include "engine/query/overlap.h"
#include "shapes/any_shape.h"
#include "shapes/ellipsoid.h"
#include "shapes/polytope.h"
#include "shapes/sphere.h"
#include "tests/referees/polytopes.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

TEST(QuickVerdict, NeverContradictsTheQuery) {
  std::mt19937_64 random(1);
  std::vector<ConvexBody> bodies = {Sphere(1.0), Box(1, 2, 3), Ellipsoid(3, 1, 2),
                                    test_point_hull(40, {2, 1, 1}, 2).body, test_tetrahedron(1.0).body};
  for (const char* text : {"box:1e-6,1,1", "needle:3", "plate:1,2", "capsule:2,0.3", "ellipsoid:20,1,0.05",
                           "cylinder:4,0.2", "rounded:0.3,box:1,2,0.1", "rounded:0.2,tetrahedron:1"}) {
    bodies.push_back(parse_shape(text).body);
  }
  bodies.emplace_back(
      Polytope(std::vector<Vec3d>{{5, 5, 5}, {6, 5, 5}, {5, 6.5, 5}, {5.2, 5.1, 6}}, {5.3, 5.4, 5.2}, 0.1));
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

TEST(QuickVerdict, IsRightNextToContact) {
  // A ball at a point that is as far from the other body as its radius, to a relative 1e-9 on either side.
  std::mt19937_64 random(2);
  int n_answered = 0;
  for (const char* text : {"box:1,2,3", "box:1e-6,1,1", "ellipsoid:3,1,2", "ellipsoid:20,1,0.05", "capsule:2,0.3"}) {
    const ConvexBody body = parse_shape(text).body, ball = Sphere(0.4);
    for (int k = 0; k < 200; ++k) {
      Transformd pose = random_rotation(random);
      const Vec3d dir = random_direction(random);
      double inside = 0.0, outside = 0.0;
      const auto put = [&](double share) {
        pose.translation = share * dir;
        return pose;
      };
      for (const bool turned : {false, true}) {  // whether the body is B
        const ConvexBody &a = turned ? ball : body, &b = turned ? body : ball;
        const QuickVerdict quick(a, b, kDrawnRotationError);
        inside = 0.0;
        outside = 50.0 / norm(dir);
        for (int step = 0; step < 70; ++step) {
          const double middle = 0.5 * (inside + outside);
          (overlap(a, b, put(middle)).outcome == Outcome::disjoint ? outside : inside) = middle;
        }
        for (const double side : {-1e-3, -1e-9, -1e-12, -1e-14, 0.0, 1e-14, 1e-12, 1e-9, 1e-3}) {
          const Transformd placed = put(inside * (1.0 + side));
          const QuickVerdict::Answer<double> answer = quick(placed);
          if (!answer.disjoint && !answer.overlap) continue;
          ++n_answered;
          const Outcome outcome = overlap(a, b, placed).outcome;
          if (outcome == Outcome::undecided) continue;
          ASSERT_EQ(outcome, answer.overlap ? Outcome::overlap : Outcome::disjoint) << text << " " << side;
        }
      }
    }
  }
  EXPECT_GT(n_answered, 3000);
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
