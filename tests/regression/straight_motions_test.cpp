// Found 2026-11 by a hostile referee: impacts of two moving bodies that do not turn, proven to be later than they are,
// by a third of the time, or proven to be none before an end after which they had long happened.
//
// Cause. B of a straight motion is its vertices as they are placed and rounded at the start (docs/queries.md). Where
// the difference of two velocities is rounded the motion is no linear cast, and until when the bodies stay apart from
// the start on was shown in twice the precision of B's vertices without rounding: of another body, by some 1e-16 of its
// coordinates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "engine/query/contact_certificate.h"
#include "engine/query/overlap.h"
#include "shapes/any_shape.h"
#include "shapes/polytope.h"

namespace vex {
namespace {

// Of which A's is lost in the difference.
const RigidMotion kHardly{{0.0, 1e-30, 0.0}, {}}, kAlong{{1.0, 1.0, 0.0}, {}};

std::vector<Vec3d> corners_of_cube(double x) {
  std::vector<Vec3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({x + ((i & 1) != 0 ? 0.5 : -0.5), (i & 2) != 0 ? 0.5 : -0.5, (i & 4) != 0 ? 0.5 : -0.5});
  }
  return corners;
}

// About the z axis, at x.
Transformd turned_at(double angle, double x) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}, {x, 0.0, 0.0}};
}

// Before it reaches the face at `face`, at a speed of 1: exact, as the difference of two numbers near each other.
double way_to(double face, const Transformd& pose) {
  double farthest = -HUGE_VAL;
  for (const Vec3d& p : corners_of_cube(0.0)) farthest = std::max(farthest, pose(p).x);
  return face - farthest;
}

bool is_proven(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const FirstContact& found,
               double until = HUGE_VAL) {
  const CertificateCheck check =
      check_certificate(a, b, pose, kHardly, kAlong, found, certify(a, b, pose, kHardly, kAlong, found, until), until);
  EXPECT_TRUE(check.is_proven) << check.fault;
  return check.is_proven;
}

TEST(StraightMotions, OfTwoBodiesAreThoseOfTheRoundedVertices) {
  const ConvexBody box = parse_shape("box:1,1,1").body;
  const Transformd pose{{0x1.dec63d8609ceep-1, -0x1.6adf564fb3fcfp-2, 0.0},
                        {0x1.6adf564fb3fcfp-2, 0x1.dec63d8609ceep-1, 0.0},
                        {0.0, 0.0, 1.0},
                        {-0x1.250d7a2b78f37p+0, 0.0, 0.0}};
  const FirstContact found = time_of_impact(box, box, pose, kHardly, kAlong);
  EXPECT_EQ(way_to(-0.5, pose), 0x1.8p-52);
  EXPECT_LE(found.lower, 0x1.8p-52);
  EXPECT_GE(found.upper, 0x1.8p-52);
  EXPECT_TRUE(is_proven(box, box, pose, found));
}

TEST(StraightMotions, OfTwoBodiesAreNeverLateByTheRoundingOfAPose) {
  const ConvexBody box = parse_shape("box:1,1,1").body;
  std::mt19937_64 random(1);
  int n_apart = 0;
  for (int k = 0; k < 500; ++k) {
    const double angle = std::uniform_real_distribution(0.3, 1.2)(random);
    const double half = 0.5 * (std::cos(angle) + std::sin(angle));
    const Transformd pose = turned_at(angle, -0.5 - half - std::ldexp(1.0, -52 + k % 3));
    if (overlap(box, box, pose).outcome != Outcome::disjoint) continue;
    ++n_apart;
    const FirstContact found = time_of_impact(box, box, pose, kHardly, kAlong);
    EXPECT_LE(found.lower, way_to(-0.5, pose));
    EXPECT_TRUE(is_proven(box, box, pose, found));
  }
  EXPECT_GT(n_apart, 100);
}

// Where coordinates are 1e10 as large as the bodies, roundings are as large as what is between them.
TEST(StraightMotions, OfTwoBodiesFarFromTheirOriginsAreThoseOfTheRoundedVertices) {
  const double far = 0x1p33;
  const ConvexBody hull = Polytope(corners_of_cube(far), {far, 0.0, 0.0}, 0.5), box = parse_shape("box:1,1,1").body;
  std::mt19937_64 random(1);
  int n_apart = 0;
  for (int k = 0; k < 300; ++k) {
    const double angle = std::uniform_real_distribution(0.3, 1.2)(random);
    const double half = 0.5 * (std::cos(angle) + std::sin(angle));
    const double gap = std::uniform_real_distribution(2e-6, 2e-5)(random);
    const Transformd pose = turned_at(angle, far - 0.5 - half - gap);
    if (overlap(hull, box, pose).outcome != Outcome::disjoint) continue;
    ++n_apart;
    const double truth = way_to(far - 0.5, pose);
    const FirstContact found = time_of_impact(hull, box, pose, kHardly, kAlong);
    EXPECT_LE(found.lower, truth);
    EXPECT_TRUE(is_proven(hull, box, pose, found));
    for (const double until : {truth, 1.01 * truth, 0x1.41806e057affep-18}) {
      const FirstContact before = time_of_impact(hull, box, pose, kHardly, kAlong, until);
      EXPECT_TRUE(until < truth || before.verdict.outcome != Outcome::disjoint) << until;
      EXPECT_TRUE(is_proven(hull, box, pose, before, until));
    }
  }
  EXPECT_GT(n_apart, 100);
}

}  // namespace
}  // namespace vex
