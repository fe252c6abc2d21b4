#include "engine/numeric/pose_algebra.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "apps/referees/exact_overlap.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/rounding.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

using exact::Point;
using exact::Rational;

Transformd random_placement(std::mt19937_64& random, double far) {
  Transformd pose = random_rotation(random);
  pose.translation = far * random_direction(random);
  return pose;
}

Point times(const Transformd& pose, const Point& v) {
  return {exact::inner(exact::exactly(pose.row_x), v), exact::inner(exact::exactly(pose.row_y), v),
          exact::inner(exact::exactly(pose.row_z), v)};
}
Point placed(const Transformd& pose, const Point& v) {
  const Point turned = times(pose, v), t = exact::exactly(pose.translation);
  return {turned[0] + t[0], turned[1] + t[1], turned[2] + t[2]};
}
double length(const Point& v) { return std::sqrt(static_cast<double>(exact::inner(v, v))); }

// R_a^-1 (v - t_a), by Cramer's rule.
Point seen_exactly(const Transformd& a, const Point& v) {
  std::vector<std::vector<Rational>> m;
  for (const Vec3d& row : {a.row_x, a.row_y, a.row_z}) {
    const Point r = exact::exactly(row);
    m.push_back({r[0], r[1], r[2]});
  }
  const Point way = exact::minus(v, exact::exactly(a.translation));
  std::vector<Rational> x(way.begin(), way.end());
  EXPECT_TRUE(exact::solve(m, x));
  return {x[0], x[1], x[2]};
}

double largest_difference(const Transformd& a, const Transformd& b) {
  const Vec3d rows[] = {a.row_x - b.row_x, a.row_y - b.row_y, a.row_z - b.row_z, a.translation - b.translation};
  double largest = 0.0;
  for (const Vec3d& row : rows) {
    largest = std::max({largest, std::fabs(row.x), std::fabs(row.y), std::fabs(row.z)});
  }
  return largest;
}

bool are_same(const Transformd& a, const Transformd& b) { return largest_difference(a, b) == 0.0; }

TEST(PoseAlgebra, AProductPlacesAsOneAfterTheOtherToRounding) {
  std::mt19937_64 random(281);
  for (int k = 0; k < 100; ++k) {
    const Transformd first = random_placement(random, 3.0), second = random_placement(random, 5.0);
    const Transformd both = (Pose(first) * Pose(second)).a_from_b();
    const Point x = exact::exactly(random_direction(random));
    EXPECT_LT(length(exact::minus(placed(both, x), placed(first, placed(second, x)))), 32.0 * kUnitRoundoff * 9.0);
  }
}

TEST(PoseAlgebra, AProductThatIsNoRotationIsRefused) {
  Transformd stretched;
  stretched.row_x.x = 1.0 + 4.9e-7;
  const Pose once = stretched;
  EXPECT_NO_THROW(once * Pose());
  EXPECT_THROW(once * once, InputError);
  EXPECT_THROW(relative_pose(once, once), InputError);
}

TEST(PoseAlgebra, APoseTimesItsInverseIsNoMotion) {
  std::mt19937_64 random(282);
  for (int k = 0; k < 100; ++k) {
    const Pose pose = random_placement(random, 7.0);
    EXPECT_LT(largest_difference((pose * inverse(pose)).a_from_b(), Transformd{}), 64.0 * kUnitRoundoff * 8.0);
    EXPECT_LT(largest_difference((inverse(pose) * pose).a_from_b(), Transformd{}), 64.0 * kUnitRoundoff * 8.0);
  }
}

TEST(PoseAlgebra, APoseIsMadeOfItsQuaternionAndGivesItBack) {
  std::mt19937_64 random(283);
  for (int k = 0; k < 200; ++k) {
    const Transformd pose = random_placement(random, 2.0);
    const std::array<double, 4> q = quaternion_of(pose);
    EXPECT_LT(largest_difference(pose_of(q, pose.translation).a_from_b(), pose), 16.0 * kUnitRoundoff);
  }
  // Half turns, at which one component or three are 0.
  for (const std::array<double, 4>& q :
       {std::array{0.0, 1.0, 0.0, 0.0}, std::array{0.0, 0.0, 1.0, 0.0}, std::array{0.0, 0.0, 0.0, 1.0}}) {
    EXPECT_EQ(quaternion_of(pose_of(q, {}).a_from_b()), q);
  }
  EXPECT_THROW(pose_of({0.0, 0.0, 0.0, 0.0}, {}), InputError);
  EXPECT_THROW(pose_of({1.0, 0.0, 0.0, 0.0}, {0.0, HUGE_VAL, 0.0}), InputError);
}

// Rodrigues' formula: what an interpolated turn must be, without a quaternion.
Transformd turned_about(const Vec3d& axis, double angle_rad) {
  const double length = norm(axis), c = std::cos(angle_rad), s = std::sin(angle_rad);
  const Vec3d n = (1.0 / length) * axis;
  return {{c + n.x * n.x * (1 - c), n.x * n.y * (1 - c) - n.z * s, n.x * n.z * (1 - c) + n.y * s},
          {n.y * n.x * (1 - c) + n.z * s, c + n.y * n.y * (1 - c), n.y * n.z * (1 - c) - n.x * s},
          {n.z * n.x * (1 - c) - n.y * s, n.z * n.y * (1 - c) + n.x * s, c + n.z * n.z * (1 - c)},
          {}};
}

TEST(PoseAlgebra, InterpolationTurnsEvenlyByTheShorterArc) {
  std::mt19937_64 random(284);
  double worst = 0.0;
  for (int k = 0; k < 400; ++k) {
    const Transformd from = random_placement(random, 2.0);
    const Vec3d axis = random_direction(random);
    // From 1e-9 to nearly half a turn, where the other arc becomes the shorter one.
    const double angle = (k % 4 == 0 ? 1e-9 : 0.25 * (k % 4) + 2.2 * random_in_unit_interval(random));
    ASSERT_LT(angle, std::numbers::pi);
    Transformd to = (Pose(from) * Pose(turned_about(axis, angle))).a_from_b();
    to.translation = from.translation + random_direction(random);
    const double part = random_in_unit_interval(random);
    const Transformd at = interpolated(from, to, part).a_from_b();
    Transformd expected = (Pose(from) * Pose(turned_about(axis, part * angle))).a_from_b();
    expected.translation = from.translation + part * (to.translation - from.translation);
    worst = std::max(worst, largest_difference(at, expected));
  }
  EXPECT_LT(worst, 2e-15);
  EXPECT_GT(worst, 0.0) << "nothing was compared";
}

TEST(PoseAlgebra, InterpolationEndsAtTheGivenPoses) {
  std::mt19937_64 random(285);
  const Pose from = random_placement(random, 1.0), to = random_placement(random, 1.0);
  EXPECT_TRUE(are_same(interpolated(from, to, 0.0).a_from_b(), from.a_from_b()));
  EXPECT_TRUE(are_same(interpolated(from, to, 1.0).a_from_b(), to.a_from_b()));
  EXPECT_LT(largest_difference(interpolated(from, from, 0.3).a_from_b(), from.a_from_b()), 1e-15);
  const Pose half_turn = pose_of({0.0, 0.0, 0.0, 1.0}, {});
  EXPECT_TRUE(is_rotation(interpolated(Pose(), half_turn, 0.5).a_from_b()));
  for (const double part : {-0.1, 1.1, std::nan("")}) EXPECT_THROW(interpolated(from, to, part), UsageError);
}

TEST(PoseAlgebra, APointOfBIsWhereTheTwoPosesHaveItToTheErrorTold) {
  std::mt19937_64 random(286);
  double largest_part = 0.0;
  for (const double far : {0.0, 1.0, 1e6, 1e12}) {
    for (int k = 0; k < 100; ++k) {
      Transformd a = random_placement(random, 0.0), b = random_placement(random, 3.0);
      if (k % 3 == 0) a.row_x.x *= 1.0 + 1e-7;  // within what a pose may be off
      const Vec3d origin = far * random_direction(random);
      a.translation = a.translation + origin;
      b.translation = b.translation + origin;
      const Vec3d x = 2.0 * random_direction(random);
      const double error = relative_pose_error(a, b, norm(x));
      const Point had = exact::exactly(relative_pose(Pose(a), Pose(b)).a_from_b()(x));
      const double off = length(exact::minus(had, seen_exactly(a, placed(b, exact::exactly(x)))));
      ASSERT_LE(off, error) << far;
      largest_part = std::max(largest_part, off / error);
      // Of rotations to the last digits it is some roundings of what the bodies are apart, wherever they are.
      if (k % 3 != 0) {
        ASSERT_LT(error, 128.0 * kUnitRoundoff * 12.0);
      }
    }
  }
  EXPECT_GT(largest_part, 0.05) << "the bound is far from what happens";
}

}  // namespace
}  // namespace vex
