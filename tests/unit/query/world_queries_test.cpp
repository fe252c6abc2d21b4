#include "engine/query/world_queries.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "engine/numeric/errors.h"
#include "engine/numeric/rounding.h"
#include "engine/support/point_body.h"
#include "shapes/any_shape.h"
#include "tests/referees/exact_distance.h"
#include "tests/referees/polytopes.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

bool are_same(const Vec3d& a, const Vec3d& b) {
  return std::bit_cast<std::array<std::uint64_t, 3>>(a) == std::bit_cast<std::array<std::uint64_t, 3>>(b);
}

Pose random_world_pose(std::mt19937_64& random, const Vec3d& origin, double far) {
  Transformd pose = random_rotation(random);
  pose.translation = origin + far * random_direction(random);
  return pose;
}

std::vector<exact::Point> in_world_exactly(const std::vector<Vec3d>& vertices, const Pose& world_from_body) {
  const Transformd& pose = world_from_body.a_from_b();
  std::vector<exact::Point> points;
  for (const Vec3d& v : vertices) {
    exact::Point at = exact::exactly(pose.translation);
    const exact::Point own = exact::exactly(v);
    at[0] += exact::inner(exact::exactly(pose.row_x), own);
    at[1] += exact::inner(exact::exactly(pose.row_y), own);
    at[2] += exact::inner(exact::exactly(pose.row_z), own);
    points.push_back(at);
  }
  return points;
}

TEST(WorldQueries, AnswerAsTheQueriesOfTheRelativePoseToTheBit) {
  std::mt19937_64 random(291);
  const ConvexBody a = parse_shape("cylinder:1,0.5").body, b = parse_shape("rounded:0.1,tetrahedron:1").body;
  int n_overlaps = 0;
  for (int k = 0; k < 60; ++k) {
    const Vec3d origin = (k % 2 == 0 ? 1.0 : 1e6) * random_direction(random);
    const Pose at_a = random_world_pose(random, origin, 0.0), at_b = random_world_pose(random, origin, 1.5);
    const Pose pose = relative_pose(at_a, at_b);
    const Separation found = signed_distance(a, at_a, b, at_b), in_a = signed_distance(a, b, pose);
    EXPECT_EQ(found.signed_distance, in_a.signed_distance);
    EXPECT_EQ(found.lower, in_a.lower);
    EXPECT_EQ(found.upper, in_a.upper);
    EXPECT_EQ(found.verdict, in_a.verdict);
    EXPECT_TRUE(are_same(found.point_b_in_b, in_a.point_b_in_b));
    EXPECT_EQ(overlap(a, at_a, b, at_b).outcome, found.verdict.outcome);
    n_overlaps += found.verdict.outcome == Outcome::overlap ? 1 : 0;
    // Where B has the point is where the world has it.
    const double rounding = 64.0 * kUnitRoundoff * (norm_1(origin) + 8.0) + 1e-8;
    EXPECT_LT(norm(at_b.a_from_b()(found.point_b_in_b) - found.point_b), rounding);
    EXPECT_LT(norm((found.point_b - found.point_a) - found.signed_distance * found.normal), rounding);
    EXPECT_NEAR(norm(found.normal), 1.0, 4.0 * kUnitRoundoff);
    EXPECT_EQ(distance(a, at_a, b, at_b).verdict, distance(a, b, pose).verdict);
    EXPECT_EQ(penetration_depth(a, at_a, b, at_b).upper, penetration_depth(a, b, pose).upper);
    const ContactManifold manifold = contact_manifold(a, at_a, b, at_b, 0.5),
                          of_pose = contact_manifold(a, b, pose, 0.5);
    ASSERT_EQ(manifold.contacts.size(), of_pose.contacts.size());
    for (std::size_t i = 0; i < manifold.contacts.size(); ++i) {
      EXPECT_EQ(manifold.contacts[i].signed_distance, of_pose.contacts[i].signed_distance);
      EXPECT_TRUE(are_same(manifold.contacts[i].point_b, at_a.a_from_b()(of_pose.contacts[i].point_b)));
    }
  }
  EXPECT_GT(n_overlaps, 15);
  EXPECT_LT(n_overlaps, 45);
}

// The two poses as given, in rational numbers: two polytopes of the world, whose signed distance is known exactly.
TEST(WorldQueries, AreRightAboutTheGivenPosesButForTheErrorTold) {
  std::mt19937_64 random(292);
  const TestPolytope a = test_box(1.0, 0.8, 0.6), b = test_tetrahedron(0.5);
  int n_told = 0, n_overlaps = 0, n_near = 0;
  for (const double far : {1.0, 1e4, 1e8}) {
    for (int k = 0; k < 12; ++k) {
      const Vec3d origin = far * random_direction(random);
      const Pose at_a = random_world_pose(random, origin, 0.0);
      Transformd at_b = random_world_pose(random, origin, 1.5).a_from_b();
      // To contact, and then by less and less; coordinates of the world are as coarse as they are there.
      for (int step = 0; step < 2; ++step) {
        const Separation found = signed_distance(a.body, at_a, b.body, at_b);
        at_b.translation = at_b.translation - found.signed_distance * found.normal;
      }
      at_b.translation = at_b.translation + std::ldexp(k % 2 == 0 ? 1.0 : -1.0, -20 - k) * random_direction(random);
      const double error = relative_pose_error(at_a, at_b, b.body.reach());
      EXPECT_LT(error, 1e-13);
      const auto truth = static_cast<double>(
          exact::deepest(in_world_exactly(a.vertices, at_a), in_world_exactly(b.vertices, at_b)).signed_distance);
      const Separation found = signed_distance(a.body, at_a, b.body, at_b);
      EXPECT_LE(found.lower - error, truth);
      EXPECT_LE(truth, found.upper + error);
      ASSERT_NE(found.verdict.outcome, Outcome::undecided);
      n_near += std::fabs(truth) < 1e-5 ? 1 : 0;
      n_overlaps += truth <= 0.0 ? 1 : 0;
      if (std::fabs(truth) <= 2.0 * error) continue;
      ++n_told;
      EXPECT_EQ(found.verdict.outcome, truth <= 0.0 ? Outcome::overlap : Outcome::disjoint) << truth;
    }
  }
  EXPECT_GE(n_near, 30);
  EXPECT_GE(n_told, 30);
  EXPECT_GE(n_overlaps, 8);
}

TEST(WorldQueries, FarFromTheOriginAGapOfTheLastPlaceIsAGap) {
  // At 1e9 coordinates are 2^-23 apart.
  const ConvexBody box = test_box(1.0, 1.0, 1.0).body;
  const Pose at_a = Transformd{.translation = {1e9, 1e9, 1e9}};
  for (const double gap : {0x1p-23, -0x1p-23, 0.0}) {
    const Pose at_b = Transformd{.translation = {1e9, 1e9, 1e9 + (1.0 + gap)}};
    EXPECT_EQ(overlap(box, at_a, box, at_b).outcome, gap > 0.0 ? Outcome::disjoint : Outcome::overlap);
    const Separation found = signed_distance(box, at_a, box, at_b);
    EXPECT_EQ(found.signed_distance, gap);
  }
}

TEST(WorldQueries, RaysAndCastsMeetWhereTheWorldHasThem) {
  std::mt19937_64 random(293);
  const ConvexBody ball = parse_shape("sphere:0.5").body, box = parse_shape("box:1,1,1").body;
  for (int k = 0; k < 50; ++k) {
    const Vec3d centre = 3.0 * random_direction(random);
    const Pose at = random_world_pose(random, centre, 0.0);
    const Vec3d way = random_direction(random), unit = (1.0 / norm(way)) * way;
    const FirstContact hit = cast_ray(ball, at, centre - 2.0 * unit, unit);
    ASSERT_EQ(hit.verdict.outcome, Outcome::overlap);
    EXPECT_NEAR(hit.time, 1.5, 1e-12);
    EXPECT_LT(norm(hit.normal + unit), 1e-7);
    EXPECT_LT(norm(hit.point_a - (centre - 0.5 * unit)), 1e-7);
    // Behind the ball there is nothing.
    const FirstContact none = cast_ray(ball, at, centre + 2.0 * unit, unit);
    EXPECT_EQ(none.verdict.outcome, Outcome::disjoint);
    EXPECT_EQ(none.time, HUGE_VAL);
    // A ball that goes straight to another one.
    const Pose other = random_world_pose(random, centre - 4.0 * unit, 0.0);
    const FirstContact met = linear_cast(ball, at, ball, other, 2.0 * unit);
    EXPECT_NEAR(met.time, 1.5, 1e-12);
    EXPECT_LT(norm(met.normal + unit), 1e-7);
    EXPECT_EQ(linear_cast(ball, at, ball, other, 2.0 * unit, 1.4).verdict.outcome, Outcome::disjoint);
  }
  // Of a box that moves and one that flees, in the world.
  const Pose at_a = Transformd{.translation = {10.0, 0.0, 0.0}}, at_b = Transformd{.translation = {14.0, 0.0, 0.0}};
  const FirstContact met = time_of_impact(box, at_a, {{1.0, 0.0, 0.0}, {}}, box, at_b, {{0.5, 0.0, 0.0}, {}});
  EXPECT_NEAR(met.time, 6.0, 1e-9);
  EXPECT_NEAR(met.point_a.x, 16.5, 1e-8);
  EXPECT_NEAR(met.normal.x, 1.0, 1e-9);
}

TEST(WorldQueries, TurningMotionsAreSeenFromA) {
  // A bar turns about z beside a box, the whole of it turned into another direction of the world.
  std::mt19937_64 random(294);
  const ConvexBody box = parse_shape("box:1,1,1").body, bar = parse_shape("box:4,0.1,0.1").body;
  const Transformd start{.translation = {0.0, 1.5, 0.0}};
  const RigidMotion turning{{}, {0.0, 0.0, 1.0}};
  const double time = time_of_impact(box, bar, start, turning).time;
  for (int k = 0; k < 10; ++k) {
    const Pose world = random_world_pose(random, {100.0, 0.0, 0.0}, 1.0);
    const RigidMotion in_world_frame{{}, direction_to_a(world.a_from_b(), turning.angular_velocity)};
    const FirstContact hit = time_of_impact(box, world, {}, bar, world * Pose(start), in_world_frame);
    EXPECT_EQ(hit.verdict.outcome, Outcome::overlap);
    EXPECT_NEAR(hit.time, time, 1e-8);
  }
}

TEST(WorldQueries, TheErrorToldHasTheBallOfABodyWhoseRotationIsOff) {
  const ConvexBody a = with_margin(PointBody{{1.0 + 1.1e-6, 0.0, 0.0}}, 1.0), b = parse_shape("sphere:1e-9").body;
  const double shrunk = 1.0 - 4e-7;
  const Pose at_a = Transformd{{shrunk, 0.0, 0.0}, {0.0, shrunk, 0.0}, {0.0, 0.0, shrunk}, {}};
  const Pose at_b = Transformd{.translation = {0.9e-6, 0.0, 0.0}};
  const Separation one = signed_distance(a, at_a, b, at_b), other = signed_distance(b, at_b, a, at_a);
  EXPECT_NE(one.verdict.outcome, other.verdict.outcome);
  EXPECT_LT(one.lower, relative_pose_error(at_a, at_b, b.reach(), a.ball_radius()));
}

TEST(WorldQueries, RefuseMotionsThatTurningWouldChange) {
  const ConvexBody box = parse_shape("box:1,1,1").body;
  const Pose turned = pose_of({0.9, 0.1, 0.2, 0.3}, {});
  for (const double tiny : {5e-324, 1e-320, 1e-291}) {
    EXPECT_THROW(cast_ray(box, turned, {5.0, 0.0, 0.0}, {-tiny, 0.0, 0.0}), InputError);
    EXPECT_THROW(linear_cast(box, turned, box, Transformd{.translation = {5.0, 0.0, 0.0}}, {-tiny, 0.0, 0.0}),
                 InputError);
  }
}

TEST(WorldQueries, RefuseRotationsWhoseProductIsNone) {
  Transformd stretched;
  stretched.row_x.x = 1.0 + 4.9e-7;
  const ConvexBody box = parse_shape("box:1,1,1").body;
  EXPECT_THROW(overlap(box, stretched, box, stretched), InputError);
}

}  // namespace
}  // namespace vex
