// Bodies that turn while they move, onto planes, held against heights in a hundred digits.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "engine/numeric/errors.h"
#include "engine/query/half_space.h"
#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/exact_distance.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

using exact::Float;
using exact::Point;
using FloatVector = std::array<Float, 3>;

FloatVector in_digits(const Vec3d& v) { return {Float(v.x), Float(v.y), Float(v.z)}; }
Float inner_of(const FloatVector& p, const FloatVector& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
FloatVector cross_of(const FloatVector& p, const FloatVector& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

// The least height of B over the plane at a time, times the length of its normal, term by term from the exact form: by
// the normal turned back (O. Rodrigues, 1840).
Float height_at(const HalfSpace& a, const ExactForm& form, const Transformd& pose, const RigidMotion& motion,
                double time) {
  const FloatVector n = in_digits(a.dir_normal()), w = in_digits(motion.angular_velocity);
  const Float spin = sqrt(inner_of(w, w)), angle = -Float(time) * spin;
  FloatVector back = n;
  if (spin > 0) {
    const FloatVector k{w[0] / spin, w[1] / spin, w[2] / spin}, kn = cross_of(k, n), kkn = cross_of(k, kn);
    for (std::size_t i = 0; i < 3; ++i) back[i] = n[i] + sin(angle) * kn[i] + (1 - cos(angle)) * kkn[i];
  }
  FloatVector up{};  // in B's frame
  const FloatVector rows[] = {in_digits(pose.row_x), in_digits(pose.row_y), in_digits(pose.row_z)};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) up[j] += rows[i][j] * back[i];
  }
  Float least = std::numeric_limits<double>::infinity();
  for (const Vec3d& p : form.points) least = std::min(least, inner_of(up, in_digits(p)));
  for (const ExactForm::Piece& piece : form.pieces) {
    FloatVector across = up;
    if (piece.is_dome && across[2] > 0) across[2] = 0;
    const FloatVector semi = in_digits(piece.semi_axes);
    for (std::size_t j = 0; j < 3; ++j) across[j] *= semi[j];
    least = std::min(least, Float(inner_of(up, in_digits(piece.centre)) - sqrt(inner_of(across, across))));
  }
  const Float origin = inner_of(n, in_digits(pose.translation)) + Float(time) * inner_of(n, in_digits(motion.velocity));
  return origin + least - Float(form.ball_radius) * sqrt(inner_of(n, n)) - Float(a.offset());
}

void expect_proven(const HalfSpace& a, const ConvexBody& b, const Transformd& pose, const RigidMotion& motion,
                   double until, const FirstContact& found) {
  const ExactForm form = b.exact_form().value();
  const bool meets = found.verdict.outcome == Outcome::overlap;
  const bool is_free = found.verdict.outcome == Outcome::disjoint;
  const double free_until = is_free ? std::fmin(until, 8.0) : found.lower;
  for (int k = 1; k < 60; ++k) {
    const double time = free_until * k / 60.0;
    ASSERT_GT(height_at(a, form, pose, motion, time), 0) << time;
  }
  if (!meets || found.upper == 0.0) return;
  EXPECT_LE(height_at(a, form, pose, motion, found.upper), 0);
  EXPECT_LE(found.lower, found.time);
  EXPECT_LE(found.time, found.upper);
  EXPECT_LE(found.upper, until);
  if (found.lower > 0.0) {
    EXPECT_GE(height_at(a, form, pose, motion, found.lower * (1.0 - 1e-15)), 0);
  }
  const Transformd then = pose_at(pose, motion, found.time);
  const double size = b.reach() + norm(then.translation) + 1.0;
  EXPECT_LT(norm(then(found.point_b_in_b) - found.point_b), 1e-12 * size);
  EXPECT_LT(norm(found.point_b - found.point_a), 1e-9 * size);
  EXPECT_LT(std::fabs(dot(a.unit_normal(), found.point_a) - a.offset() / a.length()), 1e-12 * size);
  EXPECT_LE(distance(b, parse_shape("sphere:1e-9").body, Transformd{.translation = found.point_b_in_b}).signed_distance,
            1e-12);
}

TEST(HalfSpaceImpact, TimesOfEveryBodyAreThoseOfAHundredDigits) {
  std::mt19937_64 random(321);
  int n_met = 0, n_never = 0, n_near = 0, n = 0;
  for (const char* name : kTestBodies) {
    SCOPED_TRACE(name);
    const ConvexBody b = parse_shape(name).body;
    for (int k = 0; k < 12; ++k) {
      const HalfSpace a(std::ldexp(1.0, k % 5) * random_direction(random), random_in_unit_interval(random));
      Transformd pose = random_rotation(random);
      const Vec3d along = cross(a.unit_normal(), random_direction(random));
      pose.translation = 3.0 * along;
      const double height = (k % 3 == 0 ? 0.05 : 0.6) * b.circumradius();
      for (int step = 0; step < 2; ++step) {
        const double now = signed_distance(a, b, pose).signed_distance;
        pose.translation = pose.translation - (now - height) * a.unit_normal();
      }
      RigidMotion motion{random_direction(random), 2.0 * random_direction(random)};
      if (k % 4 == 1) motion.velocity = {};
      const double until = k % 2 == 0 ? 5.0 : HUGE_VAL;
      const FirstContact found = time_of_impact(a, b, pose, motion, until);
      ASSERT_NE(found.verdict.outcome, Outcome::undecided);
      expect_proven(a, b, pose, motion, until, found);
      ++n;
      if (found.verdict.outcome == Outcome::disjoint) {
        ++n_never;
        continue;
      }
      ++n_met;
      n_near += found.upper - found.lower < 1e-6 ? 1 : 0;
      EXPECT_EQ(time_of_impact(a, b, pose, motion, 0.99 * found.lower).verdict.outcome, Outcome::disjoint);
    }
  }
  EXPECT_GT(n_met, n / 4);
  EXPECT_GT(n_never, n / 10);
  EXPECT_GT(n_near, n_met * 9 / 10);
}

TEST(HalfSpaceImpact, ANeedleThatTurnsMeetsTheFloorWithItsTip) {
  const HalfSpace floor({0.0, 0.0, 3.0}, 0.0);
  const ConvexBody needle = parse_shape("needle:2").body;  // along z, half its length is 1
  const Transformd lying{{0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {1e6, -1e6, 0.5}};
  for (const double spin : {1.0, -2.0, 0x1p-220, 0x1p220}) {
    const FirstContact found = time_of_impact(floor, needle, lying, {{}, {0.0, spin, 0.0}});
    ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
    const double sixth = std::numbers::pi / 6.0 / std::fabs(spin);
    EXPECT_NEAR(found.time / sixth, 1.0, 1e-12);
    EXPECT_LT((found.upper - found.lower) / sixth, 1e-11);
    EXPECT_NEAR(std::fabs(found.point_b.x - 1e6), std::sqrt(0.75), 1e-9);
  }
  // Higher than it reaches, it never comes down; and with an end before it does, it has not.
  Transformd high = lying;
  high.translation.z = 1.0 + 1e-9;
  EXPECT_EQ(time_of_impact(floor, needle, high, {{}, {0.0, 1.0, 0.0}}).verdict.outcome, Outcome::disjoint);
  high.translation.z = 1.0 - 1e-9;
  EXPECT_EQ(time_of_impact(floor, needle, high, {{}, {0.0, 1.0, 0.0}}).verdict.outcome, Outcome::overlap);
  EXPECT_EQ(time_of_impact(floor, needle, lying, {{}, {0.0, 1.0, 0.0}}, 0.5).verdict.outcome, Outcome::disjoint);
}

TEST(HalfSpaceImpact, ABodyThatIsApartByLittleLeavesAndOneThatTouchesIsInContact) {
  const HalfSpace floor({0.0, 0.0, 1.0}, 0.0);
  const double up = 0x1p-52;
  for (const char* name : {"box:1,1,1", "cylinder:1,0.5", "capsule:0.5,0.25"}) {
    SCOPED_TRACE(name);
    const ConvexBody b = parse_shape(name).body;
    const Transformd on{.translation = {0.0, 0.0, 0.5}}, above{.translation = {0.0, 0.0, 0.5 + up}};
    const RigidMotion leaving{{0.0, 0.0, 2.0}, {0.5, 0.5, 0.0}};
    const FirstContact at_once = time_of_impact(floor, b, on, leaving);
    EXPECT_EQ(at_once.verdict.outcome, Outcome::overlap);
    EXPECT_EQ(at_once.upper, 0.0);
    EXPECT_NEAR(at_once.point_b.z, 0.0, 1e-15);
    EXPECT_EQ(time_of_impact(floor, b, above, leaving).verdict.outcome, Outcome::disjoint);
    const FirstContact falling = time_of_impact(floor, b, above, {{0.0, 0.0, -1.0}, {0.5, 0.5, 0.0}});
    ASSERT_EQ(falling.verdict.outcome, Outcome::overlap);
    EXPECT_LT(falling.upper, 1e-12);
    expect_proven(floor, b, above, {{0.0, 0.0, -1.0}, {0.5, 0.5, 0.0}}, HUGE_VAL, falling);
  }
}

TEST(HalfSpaceImpact, WithoutATurnItIsACast) {
  const HalfSpace floor({0.0, 1.0, 1.0}, 0.0);
  const ConvexBody b = parse_shape("cone:1,0.5").body;
  const Transformd above{.translation = {0.0, 0.0, 3.0}};
  const FirstContact cast = linear_cast(floor, b, above, {0.0, 0.0, -1.0});
  const FirstContact impact = time_of_impact(floor, b, above, {{0.0, 0.0, -1.0}, {}});
  EXPECT_EQ(cast.lower, impact.lower);
  EXPECT_EQ(cast.upper, impact.upper);
  EXPECT_EQ(time_of_impact(floor, b, above, RigidMotion{}).verdict.outcome, Outcome::disjoint);
}

TEST(HalfSpaceImpact, ABodyWithoutExactFormAndMotionsThatAreNone) {
  const HalfSpace floor({0.0, 0.0, 1.0}, 0.0);
  const ConvexBody lens = parse_shape("lens:0.9,0.7").body;
  const FirstContact found =
      time_of_impact(floor, lens, Transformd{.translation = {0.0, 0.0, 2.0}}, {{0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}});
  ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
  EXPECT_LT(found.upper - found.lower, 1e-9);
  EXPECT_NEAR(signed_distance(
                  floor, lens,
                  pose_at(Transformd{.translation = {0.0, 0.0, 2.0}}, {{0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}}, found.time))
                  .signed_distance,
              0.0, 1e-9);
  EXPECT_THROW(time_of_impact(floor, lens, Pose(), {{std::nan(""), 0, 0}, {}}), InputError);
  EXPECT_THROW(time_of_impact(floor, lens, Pose(), {{}, {1, 0, 0}}, -1.0), UsageError);
  // So far that no double tells.
  EXPECT_EQ(time_of_impact(floor, lens, Transformd{.translation = {0.0, 0.0, 1e200}}, {{0, 0, -1.0}, {1.0, 0.0, 0.0}})
                .verdict.outcome,
            Outcome::undecided);
}

}  // namespace
}  // namespace vex
