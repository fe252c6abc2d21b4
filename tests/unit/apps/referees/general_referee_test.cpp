// The referee of every pair of kinds, against cases that can be settled by hand and against the referees of one kind.
#include "apps/referees/general_referee.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "apps/referees/exact_referee.h"
#include "engine/query/overlap.h"
#include "shapes/any_shape.h"
#include "shapes/cylinder.h"
#include "shapes/ellipsoid.h"
#include "tests/referees/bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

Transformd moved_to(double x, double y, double z) { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {x, y, z}}; }

Outcome judged(const char* a, const char* b, const Transformd& pose, const Vec3d& hint = {}) {
  const ConvexBody body_a = parse_shape(a).body, body_b = parse_shape(b).body;
  return GeneralReferee(body_a, body_b).judge(pose, hint);
}

// Along a coordinate axis, unturned: touching at `distance`; beyond it by one bit they are apart.
void expect_contact_at(const char* a, const char* b, double distance, const Vec3d& axis) {
  SCOPED_TRACE(std::string(a) + " " + b);
  const auto outcome = [&](double d) { return judged(a, b, moved_to(d * axis.x, d * axis.y, d * axis.z), axis); };
  EXPECT_EQ(outcome(distance), Outcome::overlap);
  EXPECT_EQ(outcome(std::nextafter(distance, 0.0)), Outcome::overlap);
  EXPECT_EQ(outcome(std::nextafter(distance, 9e9)), Outcome::disjoint);
}

TEST(GeneralReferee, TellsContactToTheLastBit) {
  const Vec3d x{1, 0, 0}, z{0, 0, 1};
  expect_contact_at("box:1,2,3", "box:1,2,3", 3.0, z);
  expect_contact_at("sphere:0.5", "sphere:0.75", 1.25, x);
  expect_contact_at("cylinder:1,0.5", "cylinder:2,0.25", 1.5, z);  // face on face
  expect_contact_at("cylinder:1,0.5", "box:1,1,1", 1.0, z);
  expect_contact_at("cylinder:1,0.5", "cylinder:1,0.5", 1.0, x);  // side on side
  expect_contact_at("cone:1,0.5", "box:1,1,1", 1.0, z);           // the apex on a face
  expect_contact_at("frustum:1,0.5,0.25", "disc:0.7", 0.5, z);
  expect_contact_at("disc:0.75", "disc:0.5", 1.25, x);  // in one plane, rim on rim
  expect_contact_at("capsule:1,0.25", "capsule:2,0.5", 2.25, z);
  expect_contact_at("ellipsoid:1,2,3", "ellipsoid:0.5,0.25,4", 7.0, z);
  expect_contact_at("hemisphere:0.5", "box:1,1,1", 1.0, z);  // the dome's pole on a face
  expect_contact_at("rounded:0.25,box:1,1,1", "cylinder:1,0.5", 1.25, z);
  expect_contact_at("plate:1,1", "needle:2", 1.0, z);
}

TEST(GeneralReferee, OfAHemisphereOnlyTheDomeIsThere) {
  EXPECT_EQ(judged("hemisphere:1", "box:1,1,1", moved_to(0.0, 0.0, -0.51)), Outcome::disjoint);
  EXPECT_EQ(judged("hemisphere:1", "box:1,1,1", moved_to(0.0, 0.0, -0.5)), Outcome::overlap);
  EXPECT_EQ(judged("hemisphere:1", "box:1,1,1", moved_to(0.0, 0.0, 1.49)), Outcome::overlap);
}

TEST(GeneralReferee, ABodyAndItselfOverlap) {
  for (const char* const text : kTestBodies) EXPECT_EQ(judged(text, text, {}), Outcome::overlap) << text;
}

// B's surface beyond A's by `distance` along a random direction, from support points: true contact to about 1e-16.
Transformd near_contact(const ConvexBody& a, const ConvexBody& b, const Vec3d& unit_normal, double distance,
                        std::mt19937_64& random) {
  Transformd pose = random_rotation(random);
  const Vec3d q = pose(b.support(pose.direction_to_b(-unit_normal)));
  pose.translation = (a.support(unit_normal) - q) + distance * unit_normal;
  return pose;
}

TEST(GeneralReferee, AgreesWithTheRefereesOfOneKind) {
  std::mt19937_64 random(3);
  int n_compared = 0, n_overlap = 0;
  for (const auto& [text_a, text_b] : {std::pair{"box:1,1,1", "box:0.2,1,3"},
                                       {"sphere:1", "box:1,2,0.5"},
                                       {"box:1,2,0.5", "sphere:1"},
                                       {"capsule:1,0.25", "capsule:2,0.1"},
                                       {"ellipsoid:1,2,3", "ellipsoid:0.5,0.5,4"},
                                       {"sphere:1", "ellipsoid:1,2,3"}}) {
    const ConvexBody a = parse_shape(text_a).body, b = parse_shape(text_b).body;
    const GeneralReferee referee(a, b);
    ASSERT_TRUE(has_exact_outcome(a, b));
    for (int digits = 1; digits <= 17; ++digits) {
      for (const double sign : {-1.0, 1.0}) {
        const Vec3d d = random_direction(random), n = (1.0 / norm(d)) * d;
        const Transformd pose = near_contact(a, b, n, sign * std::pow(10.0, -digits), random);
        const Outcome truth = exact_outcome(a, b, pose);
        // With the hint and without, and with one that is no help.
        EXPECT_EQ(referee.judge(pose, n), truth) << text_a << " " << text_b << " 1e-" << digits;
        EXPECT_EQ(referee.judge(pose, {}), truth) << text_a << " " << text_b << " 1e-" << digits;
        EXPECT_EQ(referee.judge(pose, {n.z, n.x, -n.y}), truth) << text_a << " " << text_b << " 1e-" << digits;
        ++n_compared;
        n_overlap += truth == Outcome::overlap ? 1 : 0;
      }
    }
  }
  EXPECT_GT(n_overlap, 3 * n_compared / 10);
  EXPECT_LT(n_overlap, 7 * n_compared / 10);
}

TEST(GeneralReferee, DecidesEveryPairOfKindsNearContact) {
  std::mt19937_64 random(4);
  int n = 0, n_undecided = 0, n_without_hint = 0, n_overlap = 0;
  for (const NamedPair& pair : unordered_pairs()) {
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    const GeneralReferee referee(a, b);
    for (const double distance : {1e-3, 1e-8, 1e-13, -1e-3, -1e-8, -1e-13, 1e-16, -1e-16}) {
      SCOPED_TRACE(pair.a + " " + pair.b + " " + std::to_string(std::log10(std::fabs(distance))));
      const Vec3d d = random_direction(random), normal = (1.0 / norm(d)) * d;
      const Transformd pose = near_contact(a, b, normal, distance, random);
      const Outcome outcome = referee.judge(pose, normal), without_hint = referee.judge(pose, {});
      ++n;
      n_overlap += outcome == Outcome::overlap ? 1 : 0;
      n_undecided += outcome == Outcome::undecided ? 1 : 0;
      n_without_hint += without_hint == Outcome::undecided ? 1 : 0;
      if (without_hint != Outcome::undecided) {
        EXPECT_EQ(without_hint, outcome);
      }
      if (distance >= 1e-13) {
        EXPECT_EQ(outcome, Outcome::disjoint);  // by construction: the normal separates
      }
      const Outcome proven = overlap(a, b, pose).outcome;
      if (proven != Outcome::undecided) {
        EXPECT_EQ(outcome, proven);
      }
    }
  }
  EXPECT_EQ(n_undecided, 0) << "of " << n;
  EXPECT_LT(n_without_hint, n / 100) << "of " << n;
  EXPECT_GT(n_overlap, 3 * n / 10);
}

TEST(GeneralReferee, KnowsHowFarContactIs) {
  const ConvexBody a = parse_shape("cylinder:1,0.5").body, b = parse_shape("box:1,1,1").body;
  const GeneralReferee referee(a, b);
  EXPECT_NEAR(referee.gap_bound(moved_to(0.0, 0.0, 1.25), {}), 0.25, 1e-14);
  EXPECT_NEAR(referee.gap_bound(moved_to(0.0, 0.0, 0.75), {0.0, 0.0, 1.0}), 0.25, 1e-14);
  EXPECT_NEAR(referee.gap_bound(moved_to(1.0 + 0x1p-40, 0.0, 0.0), {1.0, 0.0, 0.0}), 0x1p-40, 1e-15);
}

TEST(GeneralReferee, HoldsFromTheSmallestSizesToTheLargest) {
  for (const int exponent : {-480, -100, 0, 100, 480}) {
    const double s = std::ldexp(1.0, exponent);
    const ConvexBody a = Ellipsoid(s, 2.0 * s, 3.0 * s), b = Cylinder(s, s);
    const GeneralReferee referee(a, b);
    EXPECT_EQ(referee.judge(moved_to(0.0, 0.0, 3.5 * s), {}), Outcome::overlap) << exponent;
    EXPECT_EQ(referee.judge(moved_to(0.0, 0.0, 3.5 * s * (1.0 + 0x1p-50)), {}), Outcome::disjoint) << exponent;
    EXPECT_EQ(referee.judge(moved_to(0.0, 0.0, 3.5 * s * (1.0 - 0x1p-50)), {}), Outcome::overlap) << exponent;
  }
}

}  // namespace
}  // namespace vex
