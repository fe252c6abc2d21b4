#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "engine/query/first_contact.h"
#include "engine/query/overlap.h"
#include "engine/query/search/rigid_sweep.h"
#include "engine/query/separation.h"
#include "shapes/any_shape.h"
#include "shapes/box.h"
#include "shapes/sphere.h"
#include "tests/referees/bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

constexpr double kPi = std::numbers::pi;

Transformd placed_at(double x, double y, double z) {
  Transformd pose;
  pose.translation = {x, y, z};
  return pose;
}

void expect_time(const FirstContact& found, double truth, double width) {
  ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
  EXPECT_LE(found.lower, truth * (1.0 + 4.0 * kUnitRoundoff));
  EXPECT_GE(found.upper, truth * (1.0 - 4.0 * kUnitRoundoff));
  EXPECT_LE(found.lower, found.time);
  EXPECT_LE(found.time, found.upper);
  EXPECT_LE(found.upper - found.lower, width);
  EXPECT_NEAR(norm(found.normal), 1.0, 1e-14);
}

TEST(PoseAt, TurnsAboutTheAxisOfTheMotionAndMovesTheOriginStraight) {
  const Transformd start = placed_at(1.0, 2.0, 3.0);
  const Transformd quarter = pose_at(start, {{0.0, 0.0, -1.0}, {0.0, 0.0, 0.5}}, kPi);
  const Vec3d x = quarter({1.0, 0.0, 0.0});
  EXPECT_NEAR(x.x, 1.0, 1e-15);
  EXPECT_NEAR(x.y, 3.0, 1e-15);
  EXPECT_NEAR(x.z, 3.0 - kPi, 1e-15);
  std::mt19937_64 random(1);
  for (int k = 0; k < 100; ++k) {
    const Transformd pose = random_rotation(random);
    const RigidMotion motion{random_direction(random), 3.0 * random_direction(random)};
    const Transformd at_once = pose_at(pose, motion, 2.0), in_two = pose_at(pose_at(pose, motion, 1.25), motion, 0.75);
    const Vec3d point = random_direction(random);
    EXPECT_LE(norm(at_once(point) - in_two(point)), 1e-14);
    EXPECT_EQ(norm(pose_at(pose, motion, 0.0)(point) - pose(point)), 0.0);
  }
}

// A point of B, moved exactly, is never nearer along the normal than the bound says: tried at many times.
TEST(RigidSweep, BoundsTheGapDuringTheWholeInterval) {
  std::mt19937_64 random(2);
  int n_near = 0, n_bounds = 0;
  for (const NamedPair& pair : unordered_pairs()) {
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    for (int k = 0; k < 4; ++k) {
      Transformd pose = random_rotation(random);
      pose.translation = 3.0 * random_direction(random);
      const RigidMotion motion{random_direction(random), 2.0 * random_direction(random)};
      RigidSweep sweep(a, b, pose, motion);
      const Vec3d dir = random_direction(random), normal = (1.0 / norm(dir)) * dir;
      const double from = random_in_unit_interval(random), duration = 0.5 * random_in_unit_interval(random);
      const double bound = sweep.gap_during(normal, from, duration);
      double least = HUGE_VAL;
      for (int s = 0; s <= 50; ++s) {
        const Transformd placed = pose_at(pose, motion, from + duration * s / 50);
        const Vec3d of_b = placed(b.core_support(-placed.direction_to_b(normal))) - b.ball_radius() * normal;
        least = std::fmin(least, dot(normal, of_b - a.support(normal)));
      }
      EXPECT_LE(bound, least + 1e-14);
      ++n_bounds;
      if (least - bound < 0.2) ++n_near;
    }
  }
  EXPECT_GT(n_near, 0.8 * n_bounds) << "of second order in the duration";
}

TEST(RigidSweep, SeesBodiesMeetOnceTheyAreInEachOtherByMoreThanRounding) {
  const ConvexBody cube = Box(1.0, 1.0, 1.0);
  RigidSweep sweep(cube, cube, placed_at(0.0, 0.0, 1.0), {{0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}});
  EXPECT_FALSE(sweep.meets_at(0.0)) << "they touch";
  EXPECT_FALSE(sweep.meets_at(16.0 * kUnitRoundoff));
  EXPECT_TRUE(sweep.meets_at(1e-12));
}

// Turned about its middle at a height h above a face, the corner of a cube's section, at sqrt(1/2), comes down to it
// when sin(angle + 45 degrees) sqrt(1/2) = h.
TEST(TimeOfImpact, OfACubeThatTurnsOverAFaceIsThatOfItsCorner) {
  const ConvexBody floor = Box(10.0, 10.0, 1.0), cube = Box(1.0, 1.0, 1.0);
  const double half_diagonal = std::sqrt(0.5);
  for (const double height : {0.5001, 0.55, 0.6, 0.7, 0.7071}) {
    const FirstContact found = time_of_impact(floor, cube, placed_at(0.0, 0.0, 0.5 + height), {{}, {0.0, 0.5, 0.0}});
    const double placed = (0.5 + height) - 0.5;  // what is left of the height after rounding
    const double angle = std::asin(placed / half_diagonal) - 0.25 * kPi;
    // What a rounding of the height is in time.
    const double slope = 0.5 * std::sqrt(half_diagonal * half_diagonal - placed * placed);
    ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
    EXPECT_LE(found.lower, angle / 0.5 + 1e-15 / slope);
    EXPECT_GE(found.upper, angle / 0.5 - 1e-15 / slope);
    EXPECT_LE(found.upper - found.lower, 1e-11 / slope);
    EXPECT_NEAR(found.normal.z, 1.0, 1e-12);
    EXPECT_NEAR(found.point_a.z, 0.5, 1e-12);
    EXPECT_LE(norm(found.point_a - found.point_b), 1e-11);
    EXPECT_LT(found.n_support_calls, 1000);
  }
}

TEST(TimeOfImpact, OfACubeThatTurnsTooHighIsNever) {
  const ConvexBody floor = Box(10.0, 10.0, 1.0), cube = Box(1.0, 1.0, 1.0);
  const FirstContact found = time_of_impact(floor, cube, placed_at(0.0, 0.0, 0.5 + 0.7072), {{}, {0.0, 0.5, 0.0}});
  EXPECT_EQ(found.verdict.outcome, Outcome::disjoint);
  EXPECT_EQ(found.lower, HUGE_VAL);
  EXPECT_LT(found.n_support_calls, 5000);
}

TEST(TimeOfImpact, OfACubeThatJustReachesTheFaceIsNotSaidToBeNever) {
  const ConvexBody floor = Box(10.0, 10.0, 1.0), cube = Box(1.0, 1.0, 1.0);
  const FirstContact found =
      time_of_impact(floor, cube, placed_at(0.0, 0.0, 0.5 + std::sqrt(0.5)), {{}, {0.0, 0.5, 0.0}});
  EXPECT_EQ(found.verdict.outcome, Outcome::undecided);
  EXPECT_LE(found.lower, 0.5 * kPi);
  EXPECT_GT(found.lower, 0.49 * kPi);
  EXPECT_EQ(found.upper, HUGE_VAL);
}

TEST(TimeOfImpact, OfABallDoesNotDependOnItsSpin) {
  const ConvexBody ball = Sphere(0.5), wall = parse_shape("ellipsoid:1,2,3").body;
  std::mt19937_64 random(3);
  int n_hits = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3d dir = random_direction(random);
    Transformd pose = random_rotation(random);
    pose.translation = 3.6 * random_direction(random) - (8.0 / norm(dir)) * dir;
    const FirstContact cast = linear_cast(wall, ball, pose, dir);
    const FirstContact found = time_of_impact(wall, ball, pose, {dir, 10.0 * random_direction(random)});
    ASSERT_EQ(found.verdict.outcome, cast.verdict.outcome);
    if (cast.verdict.outcome != Outcome::overlap) continue;
    ++n_hits;
    EXPECT_LE(found.lower, cast.upper);
    EXPECT_GE(found.upper, cast.lower);
    EXPECT_LE(found.upper - found.lower, 1e-11 / std::fabs(dot(cast.normal, dir)));
    EXPECT_LE(norm(found.normal - cast.normal), 1e-6);
  }
  EXPECT_GT(n_hits, 60);
  EXPECT_LT(n_hits, 140);
}

TEST(TimeOfImpact, WithoutSpinIsTheLinearCastAndWithHardlyAnyNearlyThat) {
  const ConvexBody a = parse_shape("dodecahedron:0.5").body, b = parse_shape("box:0.2,1,3").body;
  std::mt19937_64 random(4);
  int n_hits = 0;
  for (int k = 0; k < 100; ++k) {
    const Vec3d dir = random_direction(random);
    Transformd pose = random_rotation(random);
    pose.translation = 1.5 * random_direction(random) - (6.0 / norm(dir)) * dir;
    const FirstContact cast = linear_cast(a, b, pose, dir);
    const FirstContact without = time_of_impact(a, b, pose, {dir, {}});
    EXPECT_EQ(without.lower, cast.lower);
    EXPECT_EQ(without.upper, cast.upper);
    const FirstContact hardly = time_of_impact(a, b, pose, {dir, 1e-20 * random_direction(random)});
    if (cast.verdict.outcome != Outcome::overlap) continue;
    ++n_hits;
    ASSERT_EQ(hardly.verdict.outcome, Outcome::overlap);
    EXPECT_LE(hardly.lower, cast.upper);
    EXPECT_GE(hardly.upper, cast.lower);
  }
  EXPECT_GT(n_hits, 30);
}

TEST(TimeOfImpact, WhereTheBodiesMeetAtOnceIsNought) {
  const ConvexBody cube = Box(1.0, 1.0, 1.0);
  const FirstContact found = time_of_impact(cube, cube, placed_at(0.0, 0.0, 0.75), {{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}});
  expect_time(found, 0.0, 0.0);
  EXPECT_NEAR(found.normal.z, 1.0, 1e-12);
}

TEST(TimeOfImpact, WithoutAnyMotionIsNever) {
  const ConvexBody cube = Box(1.0, 1.0, 1.0);
  EXPECT_EQ(time_of_impact(cube, cube, placed_at(0.0, 0.0, 1.25), {}).verdict.outcome, Outcome::disjoint);
}

TEST(TimeOfImpact, OfABodyThatLeavesOrPassesFarOffIsNeverWithoutASearch) {
  const ConvexBody a = parse_shape("cone:1,0.5").body, b = parse_shape("needle:2").body;
  const RigidMotion leaving{{1.0, 0.0, 0.0}, {3.0, 2.0, 1.0}};
  for (const Vec3d& start : {Vec3d{5.0, 0.0, 0.0}, Vec3d{-50.0, 5.0, 0.0}}) {
    const FirstContact found = time_of_impact(a, b, placed_at(start.x, start.y, start.z), leaving);
    EXPECT_EQ(found.verdict.outcome, Outcome::disjoint);
    EXPECT_LT(found.n_support_calls, 50);
  }
}

TEST(TimeOfImpact, OfABodyThatSpinsFastAndComesSlowlyIsThatOfItsLongestReach) {
  const ConvexBody floor = Box(10.0, 10.0, 1.0), needle = parse_shape("needle:2").body;
  // Turned about x, its ends come down to 1 below its middle every half a turn.
  const RigidMotion motion{{0.0, 0.0, -0.01}, {5.0, 0.0, 0.0}};
  const FirstContact found = time_of_impact(floor, needle, placed_at(0.0, 0.0, 1.75), motion);
  ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
  EXPECT_GE(found.lower, 25.0 - 1.0);
  EXPECT_LE(found.upper, 25.0 + kPi / 5.0);
  EXPECT_LE(found.upper - found.lower, 1e-9);
  // Within the half turn in which the height falls short of 1 the first time.
  const double before = found.lower - 1e-6;
  EXPECT_EQ(overlap(floor, needle, pose_at(placed_at(0.0, 0.0, 1.75), motion, before)).outcome, Outcome::disjoint);
}

struct Fall {
  Transformd pose;
  RigidMotion motion;
};
// Towards each other from a little way off, or turning in place; slowly, or a few radians on the way, or many.
Fall random_fall(std::mt19937_64& random, const ConvexBody& a, const ConvexBody& b, int k) {
  Fall fall{random_rotation(random), {random_direction(random), {}}};
  const double reach = a.reach() + b.reach();
  const double speed = norm(fall.motion.velocity);
  fall.pose.translation = (1.3 * reach) * random_direction(random) - (1.2 * reach / speed) * fall.motion.velocity;
  fall.motion.angular_velocity = ((k % 4 == 0   ? 0.2
                                   : k % 4 == 1 ? 2.0
                                                : 8.0) *
                                  speed / reach) *
                                 random_direction(random);
  if (k % 4 == 3) {
    fall.pose.translation = reach * random_direction(random);
    fall.motion.velocity = {};
  }
  return fall;
}

// The referee is the proven verdict: none at any of many times before the lower bound, a contact at the upper one.
TEST(TimeOfImpact, OfAllPairsIsWhereProvenVerdictsChange) {
  std::mt19937_64 random(5);
  int n_hits = 0, n_falls = 0, n_undecided = 0;
  long n_support_calls = 0;
  for (const NamedPair& pair : ordered_pairs()) {
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    for (int k = 0; k < 4; ++k) {
      const Fall fall = random_fall(random, a, b, k);
      const double reach = a.reach() + b.reach();
      if (overlap(a, b, fall.pose).outcome == Outcome::overlap) continue;
      const FirstContact found = time_of_impact(a, b, fall.pose, fall.motion);
      const auto outcome_at = [&](double t) { return overlap(a, b, pose_at(fall.pose, fall.motion, t)).outcome; };
      ++n_falls;
      n_support_calls += found.n_support_calls;
      const double speed = norm(fall.motion.velocity) + reach * norm(fall.motion.angular_velocity);
      double until = found.lower;
      if (found.verdict.outcome == Outcome::disjoint) {
        until = norm_1(fall.motion.velocity) > 0.0 ? 4.0 * reach / norm(fall.motion.velocity)
                                                   : 2.0 * kPi / norm(fall.motion.angular_velocity);
      }
      for (int s = 0; s < 100; ++s) {
        EXPECT_NE(outcome_at(until * s / 100), Outcome::overlap) << pair.a << " " << pair.b << " " << k;
      }
      if (found.verdict.outcome == Outcome::undecided) ++n_undecided;
      if (found.verdict.outcome != Outcome::overlap) continue;
      ++n_hits;
      EXPECT_NE(outcome_at(found.lower - 1e-12 * reach / speed), Outcome::overlap) << pair.a << " " << pair.b;
      EXPECT_EQ(outcome_at(found.upper), Outcome::overlap) << pair.a << " " << pair.b;
      EXPECT_LE(found.upper - found.lower, 1e-9 * reach / speed) << pair.a << " " << pair.b << " " << k;
      EXPECT_LE(norm(found.point_a - found.point_b), 1e-6 * reach) << pair.a << " " << pair.b;
      EXPECT_NEAR(norm(found.normal), 1.0, 1e-14);
    }
  }
  EXPECT_GT(n_hits, 0.3 * n_falls);
  EXPECT_LT(n_hits, 0.8 * n_falls);
  EXPECT_LE(n_undecided, 0.002 * n_falls);
  EXPECT_LT(n_support_calls, 1000L * n_falls);
}

TEST(TimeOfImpact, IsSoonerByThatOfAMotionThatIsFaster) {
  const ConvexBody a = parse_shape("frustum:1,0.7,0.3").body, b = parse_shape("octahedron:1").body;
  std::mt19937_64 random(6);
  int n_hits = 0;
  for (int k = 0; k < 60; ++k) {
    const Fall fall = random_fall(random, a, b, k);
    const RigidMotion faster{3.0 * fall.motion.velocity, 3.0 * fall.motion.angular_velocity};
    const FirstContact found = time_of_impact(a, b, fall.pose, fall.motion);
    const FirstContact sooner = time_of_impact(a, b, fall.pose, faster);
    ASSERT_EQ(found.verdict.outcome, sooner.verdict.outcome);
    if (found.verdict.outcome != Outcome::overlap) continue;
    ++n_hits;
    EXPECT_LE(3.0 * sooner.lower, found.upper * (1.0 + 1e-14));
    EXPECT_GE(3.0 * sooner.upper, found.lower * (1.0 - 1e-14));
  }
  EXPECT_GT(n_hits, 20);
}

TEST(TimeOfImpact, OfSmallAndLargeBodiesIsThatOfTheirShape) {
  for (const double size : {0x1p-30, 1.0, 0x1p30}) {
    const ConvexBody floor = Box(10.0 * size, 10.0 * size, size), cube = Box(size, size, size);
    const FirstContact found = time_of_impact(floor, cube, placed_at(0.0, 0.0, 1.0625 * size), {{}, {0.0, 0.5, 0.0}});
    expect_time(found, (std::asin(0.5625 * std::numbers::sqrt2) - 0.25 * kPi) / 0.5, 1e-10);
  }
}

// Bodies that touch at the start, to within rounding, and go into each other: at once, or as the square of the time, or
// for so short a time that a step of a thousandth of a turn passes it by.
TEST(TimeOfImpact, OfBodiesThatTouchAtTheStartIsFoundSoonAfterIt) {
  struct Start {
    const char *a, *b;
    Vec3d at, angular_velocity, normal;
    double latest;
  };
  const Start starts[] = {
      {"ellipsoid:1,1,0.01", "box:1,1,1", {1.5, 0.0, 0.5}, {0.0, 0.5 * kPi, 0.0}, {1.0, 0.0, 0.0}, 1e-9},
      {"cylinder:1,0.5", "box:1,1,1", {1.0, 0.0, 0.0}, {0.0, 0.5 * kPi, 0.0}, {1.0, 0.0, 0.0}, 1e-9},
      {"box:1,2,0.1", "ellipsoid:0.5,0.7,1", {-1.0, 1.0, 0.0}, {0.0, 0.0, -0.5 * kPi}, {-1.0, 0.0, 0.0}, 1e-5},
  };
  for (const Start& start : starts) {
    const ConvexBody a = parse_shape(start.a).body, b = parse_shape(start.b).body;
    const Transformd pose = placed_at(start.at.x, start.at.y, start.at.z);
    const FirstContact found = time_of_impact(a, b, pose, {{}, start.angular_velocity});
    expect_time(found, 0.0, start.latest);
    EXPECT_EQ(overlap(a, b, pose_at(pose, {{}, start.angular_velocity}, found.upper)).outcome, Outcome::overlap);
    EXPECT_LE(norm(found.normal - start.normal), 1e-4) << start.a;
    EXPECT_LE(norm(found.point_a - found.point_b), 1e-8) << start.a;
  }
}

// The plate's edge touches the cylinder and leaves it; a third of a turn later its corner comes back to it.
TEST(TimeOfImpact, IsTheTimeAtWhichNormalAndPointsAreWhereTheBoundsAreWide) {
  const ConvexBody a = parse_shape("cylinder:1,0.5").body, b = parse_shape("plate:1,1").body;
  const FirstContact found = time_of_impact(a, b, placed_at(0.5, -1.0, 0.25), {{}, {0.0, 0.0, 2.0 * kPi / 3.0}});
  ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
  EXPECT_EQ(found.lower, 0.0);
  EXPECT_EQ(found.time, 0.0);
  EXPECT_LE(norm(found.normal - Vec3d{0.0, -1.0, 0.0}), 1e-4);
  EXPECT_LE(norm(found.point_a - Vec3d{0.0, -0.5, 0.25}), 1e-4);
  EXPECT_LE(norm(found.point_a - found.point_b), 1e-8);
}

TEST(TimeOfImpact, OfHugeAndTinySpeedsIsThatOfTheMotionInAnotherUnitOfTime) {
  const ConvexBody a = parse_shape("frustum:1,0.7,0.3").body, b = parse_shape("octahedron:1").body;
  std::mt19937_64 random(7);
  int n_hits = 0;
  for (int k = 0; k < 40; ++k) {
    const Fall fall = random_fall(random, a, b, k);
    const FirstContact found = time_of_impact(a, b, fall.pose, fall.motion);
    for (const int exponent : {-900, -400, 300, 700, 1000}) {
      const RigidMotion scaled{times_power_of_two(fall.motion.velocity, exponent),
                               times_power_of_two(fall.motion.angular_velocity, exponent)};
      const FirstContact other = time_of_impact(a, b, fall.pose, scaled);
      ASSERT_EQ(other.verdict.outcome, found.verdict.outcome) << exponent;
      if (found.verdict.outcome != Outcome::overlap) continue;
      ++n_hits;
      EXPECT_LE(std::ldexp(other.lower, exponent), found.upper);
      EXPECT_GE(std::ldexp(other.upper, exponent), found.lower);
      EXPECT_LE(std::ldexp(other.upper - other.lower, exponent), 1e-9);
      EXPECT_EQ(overlap(a, b, pose_at(fall.pose, scaled, other.upper)).outcome, Outcome::overlap);
    }
  }
  EXPECT_GT(n_hits, 60);
}

// Subnormal speeds have few digits; the directions of such motions are still those of their coordinates.
TEST(TimeOfImpact, OfSubnormalSpeedsIsNotSaidToBeNeverWhereItIsLate) {
  const ConvexBody ball = Sphere(1.0), cube = Box(1.0, 1.0, 1.0);
  const FirstContact late =
      time_of_impact(ball, ball, placed_at(3.0, 3.0, 0.0), {{-5e-324, -5e-324, 0.0}, {0.0, 0.0, 1e-310}});
  EXPECT_NE(late.verdict.outcome, Outcome::disjoint);
  EXPECT_EQ(late.upper, HUGE_VAL);
  // Its corner, at sqrt(1/2), does not reach so far.
  const FirstContact never = time_of_impact(cube, cube, placed_at(1.25, 0.0, 0.0), {{}, {0.0, 0.0, 5e-324}});
  EXPECT_EQ(never.verdict.outcome, Outcome::disjoint);
  const Transformd near = placed_at(1.125, 0.0, 0.0);
  const double angle = std::asin(0.625 * std::numbers::sqrt2) - 0.25 * kPi;
  const FirstContact found = time_of_impact(cube, cube, near, {{}, {0.0, 0.0, 0x1p-1020}});
  ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
  EXPECT_NEAR(std::ldexp(found.lower, -1020), angle, 1e-9);
  EXPECT_NEAR(std::ldexp(found.upper, -1020), angle, 1e-9);
}

TEST(TimeOfImpact, OfSpeedsOfVeryDifferentSizesIsNotGuessed) {
  const ConvexBody cube = Box(1.0, 1.0, 1.0);
  const Transformd pose = placed_at(3.0, 0.25, 0.0);
  // It turns as fast as one likes, and comes: never is wrong, and so is a bound after the time of its balls' touch.
  for (const double slow : {1e-300, 1e-310, 5e-324}) {
    const FirstContact found = time_of_impact(cube, cube, pose, {{-slow, 0.0, 0.0}, {0.0, 0.0, 9e300}});
    EXPECT_EQ(found.verdict.outcome, Outcome::undecided);
    EXPECT_LE(found.lower, 2.0 / slow);
  }
  // As good as straight.
  const FirstContact found = time_of_impact(cube, cube, pose, {{-1e300, 0.0, 0.0}, {0.0, 0.0, 9e-300}});
  ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
  EXPECT_NEAR(found.lower, 2e-300, 1e-311);
  EXPECT_NEAR(found.upper, 2e-300, 1e-311);
}

TEST(TimeOfImpact, OfBodiesFartherOffThanSumsAreFiniteIsUndecided) {
  const ConvexBody ball = Sphere(1.0);
  for (const Vec3d& spin : {Vec3d{}, Vec3d{0.0, 0.0, 1.0}}) {
    const FirstContact found =
        time_of_impact(ball, ball, placed_at(1e308, 1.5e308, 0.0), {{-1e308, -1.5e308, 0.0}, spin});
    EXPECT_EQ(found.verdict.outcome, Outcome::undecided);
    EXPECT_EQ(found.lower, 0.0);
    EXPECT_EQ(found.upper, HUGE_VAL);
  }
}

// Of bodies that are proven to be apart by next to nothing: how far is asked in twice the precision, though the verdict
// is known, for a gap of 0 lets no time pass.
TEST(TimeOfImpact, OfBodiesApartByLessThanRoundingGetsAwayFromTheStart) {
  const auto impact = [](const char* a, const char* b, const Vec3d& at, const RigidMotion& motion) {
    Transformd pose;
    pose.translation = at;
    return time_of_impact(parse_shape(a).body, parse_shape(b).body, pose, motion, 3.0);
  };
  const FirstContact none =
      impact("tetrahedron:1", "box:2,1,0.01", {-1.3535533905932775, 0.59256012708064276, -0.35855339059329078},
             {{-0.43621900947907233, -0.65333611553519033, 0.61876077437607946},
              {0.30773957888559367, 0.55428669788350216, 0.46404798230494837}});
  EXPECT_EQ(none.verdict.outcome, Outcome::disjoint);
  const FirstContact late = impact("rounded:1e-4,octahedron:1", "tetrahedron:1",
                                   {1.0092797815615218, -0.24117977755967174, 0.29273337285872847},
                                   {{-0.62148643008007898, 0.74222148313163572, 0.25072272973185739},
                                    {-0.59429547207944444, 0.39919869776552996, -0.7018514139282015}});
  ASSERT_EQ(late.verdict.outcome, Outcome::overlap);
  EXPECT_NEAR(late.lower, 0.64455253724936545, 1e-9);
  EXPECT_NEAR(late.upper, 0.64455253724936545, 1e-9);
}

}  // namespace
}  // namespace vex
