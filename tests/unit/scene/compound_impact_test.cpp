// Compounds that move and turn, held against their distance at many times, every part among all.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "engine/numeric/errors.h"
#include "engine/query/world_queries.h"
#include "engine/scene/compound.h"
#include "shapes/any_shape.h"
#include "shapes/disc.h"
#include "shapes/sphere.h"
#include "tests/referees/random_compound.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

// At one time, with both poses in the frame that is A's at first.
double least_distance(const Compound& a, const Compound& b, const Transformd& pose, const RigidMotion& of_a,
                      const RigidMotion& of_b, double time) {
  const Pose a_then = Pose::unchecked(pose_at({}, of_a, time)), b_then = Pose::unchecked(pose_at(pose, of_b, time));
  double least = HUGE_VAL;
  for (std::uint32_t i = 0; i < a.size(); ++i) {
    for (std::uint32_t j = 0; j < b.size(); ++j) {
      const Pose part = relative_pose(a_then * a.compound_from_part(i), b_then * b.compound_from_part(j));
      least = std::fmin(least, distance(a.body(i), b.body(j), part, {.relative_gap = 1e-6}).upper);
    }
  }
  return least;
}

void expect_first(const Compound& a, const Compound& b, const Transformd& pose, const RigidMotion& of_a,
                  const RigidMotion& of_b, double until, const CompoundContact& found) {
  const FirstContact& contact = found.contact;
  const bool meets = contact.verdict.outcome == Outcome::overlap;
  const double free_until = meets ? contact.lower : until;
  for (int k = 0; k < 40; ++k) {
    EXPECT_GT(least_distance(a, b, pose, of_a, of_b, free_until * k / 40.0), 0.0) << k;
  }
  if (!meets) return;
  EXPECT_LT(least_distance(a, b, pose, of_a, of_b, contact.upper), 1e-9);
  EXPECT_LE(contact.upper, until);
  EXPECT_LT(norm(contact.point_a - contact.point_b), 1e-6);
  // The points are of the parts that are told, as those are then.
  const Transformd b_part =
      (Pose::unchecked(pose_at(pose, of_b, contact.time)) * b.compound_from_part(found.part_b)).a_from_b();
  EXPECT_LT(norm(b_part(contact.point_b_in_b) - contact.point_b), 1e-8);
}

TEST(CompoundImpact, BothMayMoveAndTurnAndTheFirstPartsThatMeetAreTold) {
  std::mt19937_64 random(331);
  int n_met = 0, n = 0;
  for (int k = 0; k < 30; ++k) {
    const Compound a = random_compound(random, 6, 4.0), b = random_compound(random, 5, 4.0);
    Transformd pose = random_rotation(random);
    pose.translation = 11.0 * random_direction(random);
    RigidMotion of_a{random_direction(random), 0.8 * random_direction(random)};
    RigidMotion of_b{of_a.velocity - 0.7 * pose.translation + random_direction(random), 0.8 * random_direction(random)};
    if (k % 5 == 1) of_a.angular_velocity = {};
    if (k % 5 == 2) of_b.angular_velocity = {};
    if (k % 5 == 3) of_a.velocity = of_b.velocity = {};
    if (k % 5 == 4) of_a.angular_velocity = of_b.angular_velocity = {};
    if (overlap(a, b, pose).verdict.outcome != Outcome::disjoint) continue;
    const double until = 3.0;
    const CompoundContact found = time_of_impact(a, b, pose, of_a, of_b, until);
    ASSERT_NE(found.contact.verdict.outcome, Outcome::undecided);
    expect_first(a, b, pose, of_a, of_b, until, found);
    n_met += found.contact.verdict.outcome == Outcome::overlap ? 1 : 0;
    ++n;
    if (found.contact.verdict.outcome == Outcome::overlap && found.contact.lower > 0.0) {
      EXPECT_EQ(time_of_impact(a, b, pose, of_a, of_b, 0.99 * found.contact.lower).contact.verdict.outcome,
                Outcome::disjoint);
    }
  }
  EXPECT_GT(n, 15);
  EXPECT_GT(n_met, n / 4);
  EXPECT_LT(n_met, n);
}

TEST(CompoundImpact, AnArmThatTurnsMeetsABallWhereTheCircleSaysSo) {
  // A ball on an arm's end, and a ball that waits on the circle, a quarter turn on.
  const ConvexBody ball = parse_shape("sphere:0.5").body;
  const Compound arm({{ball, Transformd{.translation = {3.0, 0.0, 0.0}}}, {parse_shape("capsule:1,0.1").body, Pose()}});
  const Compound waiting({{ball, Transformd{.translation = {0.0, 3.0, 0.0}}}});
  const double when = std::numbers::pi / 2.0 - 2.0 * std::asin(1.0 / 6.0);
  const RigidMotion turning{{}, {0.0, 0.0, 1.0}}, back{{}, {0.0, 0.0, -1.0}};
  for (const CompoundContact& found : {time_of_impact(arm, waiting, Pose(), turning, RigidMotion{}),
                                       time_of_impact(waiting, arm, Pose(), RigidMotion{}, turning),
                                       time_of_impact(arm, waiting, Pose(), RigidMotion{}, back)}) {
    ASSERT_EQ(found.contact.verdict.outcome, Outcome::overlap);
    EXPECT_NEAR(found.contact.time, when, 1e-9);
    EXPECT_LE(found.contact.lower, when + 1e-15);
    EXPECT_GE(found.contact.upper, when - 1e-15);
  }
  EXPECT_EQ(time_of_impact(arm, waiting, Pose(), turning, RigidMotion{}, 1.2).contact.verdict.outcome,
            Outcome::disjoint);
  // Both turning towards each other meet half way; alike, never.
  const CompoundContact half = time_of_impact(arm, waiting, Pose(), turning, back, 10.0);
  EXPECT_NEAR(half.contact.time, 0.5 * when, 1e-9);
  // And without an end.
  EXPECT_NEAR(time_of_impact(arm, waiting, Pose(), turning, back).contact.time, 0.5 * when, 1e-9);
  EXPECT_EQ(time_of_impact(arm, waiting, Pose(), turning, turning, 2.0).contact.verdict.outcome, Outcome::disjoint);
  // A short time asks of no more than what is near.
  std::vector<CompoundPart> many;
  for (int k = 0; k < 64; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 64.0;
    many.push_back({parse_shape("sphere:0.1").body,
                    Transformd{.translation = {5.0 * std::cos(angle), 5.0 * std::sin(angle), 0.0}}});
  }
  const Compound ring(many);
  const Pose above = Transformd{.translation = {5.0, 0.0, 0.61}};
  const CompoundContact brief = time_of_impact(ring, ball, above, turning, RigidMotion{}, 0.01);
  EXPECT_EQ(brief.contact.verdict.outcome, Outcome::disjoint);
  EXPECT_GT(brief.n_pairs, 0u);
  EXPECT_LT(brief.n_pairs, 8u);
}

// The boxes of times that are looked at in one were as wide as exact numbers would have them, and left gaps between
// them where places and times round: balls went through discs.
TEST(CompoundImpact, NothingSlipsBetweenTimesThatRound) {
  std::mt19937_64 random(353);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  struct Size {
    double disc, ball, from, speed;
  };
  for (const Size& size : {Size{0.1, 1e-6, 1e12, 1.0}, Size{0.1, 1e-4, 1e14, 7.0}, Size{1e-14, 1e-16, 1e-12, 1.7e308},
                           Size{1e-15, 1e-17, 1e-13, 1e307}}) {
    for (int k = 0; k < 200; ++k) {
      const double x = (size.from < 1.0 ? 10.0 * size.disc : 1.0) * unit(random);
      Transformd flat;
      flat.row_x = {0, 0, 1};
      flat.row_y = {0, 1, 0};
      flat.row_z = {-1, 0, 0};
      flat.translation = {x, 0, 0};
      Transformd aside;
      aside.translation = {0, 0, 10.0 * size.disc};
      const Compound a(std::vector<CompoundPart>{{ConvexBody(Disc(size.disc)), Pose(flat)},
                                                 {ConvexBody(Sphere(0.01 * size.disc)), Pose(aside)}});
      Transformd far;
      far.translation = {size.from, 0, 0};
      for (const double turn : {1e-100, 1e-20, 1e-6}) {
        const CompoundContact found = time_of_impact(a, ConvexBody(Sphere(size.ball)), Pose(far), {{}, {turn, 0, 0}},
                                                     {{-size.speed, 0, 0}, {}}, HUGE_VAL);
        ASSERT_NE(found.contact.verdict.outcome, Outcome::disjoint) << size.from << " " << x << " " << turn;
      }
    }
  }
}

TEST(CompoundImpact, OntoAFloorTheFirstPartIsTold) {
  const HalfSpace floor({0.0, 0.0, 1.0}, 0.0);
  const ConvexBody ball = parse_shape("sphere:0.5").body;
  const Compound dumbbell(
      {{ball, Transformd{.translation = {2.0, 0.0, 0.0}}}, {ball, Transformd{.translation = {-2.0, 0.0, 0.0}}}});
  const Pose above = Transformd{.translation = {0.0, 0.0, 1.5}};
  // About y the part at +x goes down: 1.5 - 2 sin t = 0.5.
  const CompoundContact found = time_of_impact(floor, dumbbell, above, {{}, {0.0, 1.0, 0.0}});
  ASSERT_EQ(found.contact.verdict.outcome, Outcome::overlap);
  EXPECT_EQ(found.part_b, 0u);
  EXPECT_NEAR(found.contact.time, std::numbers::pi / 6.0, 1e-12);
  EXPECT_LE(found.contact.upper - found.contact.lower, 1e-11);
  EXPECT_NEAR(norm(found.contact.point_b_in_b), 0.5, 1e-12);  // of the part, in its own frame
  EXPECT_EQ(time_of_impact(floor, dumbbell, above, {{}, {0.0, -1.0, 0.0}}).part_b, 1u);
  EXPECT_EQ(time_of_impact(floor, dumbbell, above, {{0.0, 0.0, 9.0}, {0.0, 1.0, 0.0}}).contact.verdict.outcome,
            Outcome::disjoint);
  const CompoundContact cast = linear_cast(floor, dumbbell, above, {1.0, 0.0, -2.0});
  ASSERT_EQ(cast.contact.verdict.outcome, Outcome::overlap);
  EXPECT_NEAR(cast.contact.time, 0.5, 1e-15);
  EXPECT_EQ(linear_cast(floor, dumbbell, above, {1.0, 0.0, 2.0}).contact.verdict.outcome, Outcome::disjoint);
}

TEST(CompoundImpact, MotionsThatAreNoneAreRefused) {
  const Compound a({{parse_shape("sphere:0.5").body, Pose()}});
  const RigidMotion none{{std::nan(""), 0.0, 0.0}, {}};
  EXPECT_THROW(time_of_impact(a, a, Pose(), none, RigidMotion{}), InputError);
  EXPECT_THROW(time_of_impact(a, a, Pose(), RigidMotion{}, none), InputError);
  EXPECT_THROW(time_of_impact(a, a, Pose(), RigidMotion{}, RigidMotion{}, -1.0), UsageError);
  EXPECT_THROW(time_of_impact(HalfSpace({0, 0, 1}, 0), a, Pose(), none), InputError);
}

}  // namespace
}  // namespace vex
