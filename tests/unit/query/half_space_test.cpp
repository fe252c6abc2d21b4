#include "engine/query/half_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "engine/numeric/errors.h"
#include "engine/numeric/rounding.h"
#include "engine/query/plane_contacts.h"
#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/exact_distance.h"
#include "tests/referees/exact_truth.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

using exact::Float;
using exact::Point;

// The least height of a body's exact form over a plane, times the length of its normal, in a hundred digits: term by
// term from what an exact form is, with square roots, where the query compares squares.
Float true_height(const HalfSpace& a, const ExactForm& form, const Transformd& pose,
                  const exact::Rational& raised = 0) {
  const Point n = exact::exactly(a.dir_normal());
  const Float length = sqrt(Float(exact::inner(n, n)));
  Float least = std::numeric_limits<double>::infinity();
  for (const Point& p : exactly_placed(form, pose)) least = std::min(least, Float(exact::inner(n, p)));
  for (const ExactForm::Piece& piece : form.pieces) {
    const Point c = exact::exactly(piece.centre), t = exact::exactly(pose.translation);
    const Point rows[] = {exact::exactly(pose.row_x), exact::exactly(pose.row_y), exact::exactly(pose.row_z)};
    exact::Rational centre = 0;
    Point up{};
    for (std::size_t i = 0; i < 3; ++i) {
      centre += n[i] * (exact::inner(rows[i], c) + t[i]);
      for (std::size_t j = 0; j < 3; ++j) up[j] += rows[i][j] * n[i];
    }
    const Point semi = exact::exactly(piece.semi_axes);
    if (piece.is_dome && up[2] > 0) up[2] = 0;
    exact::Rational spread = 0;
    for (std::size_t j = 0; j < 3; ++j) spread += semi[j] * up[j] * semi[j] * up[j];
    least = std::min(least, Float(Float(centre) - sqrt(Float(spread))));
  }
  return least - Float(form.ball_radius) * length + Float(raised) - Float(a.offset());
}

double true_distance(const HalfSpace& a, const ExactForm& form, const Transformd& pose) {
  const Point n = exact::exactly(a.dir_normal());
  return static_cast<double>(true_height(a, form, pose) / sqrt(Float(exact::inner(n, n))));
}

// The body turned at random, with its lowest point so far over the plane, to rounding; far from the origin across it.
Transformd placed_over(const HalfSpace& a, const ConvexBody& b, std::mt19937_64& random, double height, double far) {
  Transformd pose = random_rotation(random);
  const Vec3d some = random_direction(random), across = cross(a.unit_normal(), some);
  pose.translation = far * across;
  for (int step = 0; step < 3; ++step) {
    const double now = signed_distance(a, b, pose).signed_distance;
    pose.translation = pose.translation - (now - height) * a.unit_normal();
  }
  return pose;
}

HalfSpace random_half_space(std::mt19937_64& random, int k) {
  if (k % 3 == 0) return {{0.0, 0.0, 1.0}, 0.25};
  return {std::ldexp(1.0, k % 7) * random_direction(random), 2.0 * random_in_unit_interval(random) - 1.0};
}

TEST(HalfSpace, BoundsOfEveryBodyHoldTheTruthAndAreNear) {
  std::mt19937_64 random(301);
  for (const char* name : kTestBodies) {
    SCOPED_TRACE(name);
    const ConvexBody b = parse_shape(name).body;
    const ExactForm form = b.exact_form().value();
    for (int k = 0; k < 12; ++k) {
      const HalfSpace a = random_half_space(random, k);
      const double height = (k % 4 - 1) * 0.3;
      const Transformd pose = placed_over(a, b, random, height, k % 2 == 0 ? 1.0 : 100.0);
      const Separation found = signed_distance(a, b, pose);
      const double truth = true_distance(a, form, pose);
      EXPECT_LE(found.lower, truth);
      EXPECT_LE(truth, found.upper);
      const Vec3d &n = a.unit_normal(), &t = pose.translation;
      const double along = std::fabs(n.x * t.x) + std::fabs(n.y * t.y) + std::fabs(n.z * t.z);
      const double size = 3.0 * b.reach() + along + std::fabs(a.offset()) / a.length();
      EXPECT_LT(found.upper - found.lower, 100.0 * kUnitRoundoff * size + 4.0 * b.core_support_error());
      EXPECT_FALSE(found.is_rough);
      EXPECT_EQ(found.verdict.outcome == Outcome::overlap, truth <= 0.0);
      // The points: of the body, and opposite each other along the normal.
      EXPECT_LT(norm((found.point_b - found.point_a) - found.signed_distance * found.normal), 1e-12);
      EXPECT_LT(norm(pose(found.point_b_in_b) - found.point_b), 1e-12);
      EXPECT_LT(std::fabs(dot(a.dir_normal(), found.point_a) - a.offset()), 1e-11);
      EXPECT_LE(
          distance(b, parse_shape("sphere:1e-9").body, Transformd{.translation = found.point_b_in_b}).signed_distance,
          1e-12);
    }
  }
}

TEST(HalfSpace, VerdictsAreTheTruthWithinRoundingOfContact) {
  std::mt19937_64 random(302);
  int n_exact = 0, n_overlaps = 0, n = 0;
  for (const char* name : kTestBodies) {
    SCOPED_TRACE(name);
    const ConvexBody b = parse_shape(name).body;
    const ExactForm form = b.exact_form().value();
    for (int k = 0; k < 24; ++k) {
      const HalfSpace a = random_half_space(random, k);
      Transformd pose = placed_over(a, b, random, 0.0, k % 2 == 0 ? 1.0 : 100.0);
      // A few last places to and fro.
      const double step = std::ldexp(static_cast<double>(k % 5) - 2.0, -53);
      pose.translation = pose.translation + step * a.unit_normal();
      const Verdict found = overlap(a, b, pose);
      const bool meets = true_height(a, form, pose) <= 0;
      ASSERT_EQ(found.outcome, meets ? Outcome::overlap : Outcome::disjoint);
      const Separation separation = signed_distance(a, b, pose);
      EXPECT_EQ(separation.verdict, found);
      EXPECT_LE(separation.lower, separation.signed_distance);
      EXPECT_LE(separation.signed_distance, separation.upper);
      n_exact += found.by == DecidedBy::exact ? 1 : 0;
      n_overlaps += meets ? 1 : 0;
      ++n;
    }
  }
  EXPECT_GT(n_exact, n * 3 / 4) << "these were to be too near for double precision";
  EXPECT_GT(n_overlaps, n / 4);
  EXPECT_LT(n_overlaps, n * 3 / 4);
}

TEST(HalfSpace, ABodyThatStandsOnAFloorTouchesItExactly) {
  const HalfSpace floor({0.0, 0.0, 3.0}, 0.0);
  const double up = 0x1p-52;
  for (const auto& [name, height] : {std::pair{"box:1,1,1", 0.5},
                                     {"cylinder:1,0.5", 0.5},
                                     {"sphere:0.75", 0.75},
                                     {"capsule:1,0.25", 0.75},
                                     {"cone:1,0.5", 0.5},
                                     {"hemisphere:0.5", 0.0}}) {
    SCOPED_TRACE(name);
    const ConvexBody b = parse_shape(name).body;
    for (const double far : {0.0, 1e9}) {
      const Transformd on{.translation = {far, -far, height}}, above{.translation = {far, -far, height + up}};
      EXPECT_EQ(overlap(floor, b, on).outcome, Outcome::overlap);
      EXPECT_EQ(overlap(floor, b, above).outcome, Outcome::disjoint);
      EXPECT_NEAR(signed_distance(floor, b, above).signed_distance, up, 1e-14);
    }
  }
}

TEST(HalfSpace, ABodyWithoutExactFormIsUndecidedThereAndNowhereElse) {
  const HalfSpace floor({0.0, 0.0, 1.0}, 0.0);
  const ConvexBody b = parse_shape("lens:0.9,0.7").body;
  ASSERT_FALSE(b.exact_form());
  std::mt19937_64 random(303);
  int n_undecided = 0;
  for (int k = 0; k < 40; ++k) {
    const double height = (k % 2 == 0 ? 1.0 : -1.0) * std::ldexp(1.0, -20 - k);
    const Transformd pose = placed_over(floor, b, random, height, 0.0);
    const Separation found = signed_distance(floor, b, pose);
    n_undecided += found.verdict.outcome == Outcome::undecided ? 1 : 0;
    if (found.verdict.outcome == Outcome::undecided) {
      EXPECT_LT(std::fabs(height), 1e-13);
      EXPECT_LT(found.lower, 0.0);
      EXPECT_GT(found.upper, 0.0);
      EXPECT_EQ(linear_cast(floor, b, pose, {0.0, 0.0, -1.0}).verdict.outcome, Outcome::undecided);
    } else {
      EXPECT_EQ(found.verdict.outcome, height > 0.0 ? Outcome::disjoint : Outcome::overlap);
    }
  }
  EXPECT_GT(n_undecided, 5);
  EXPECT_LT(n_undecided, 25);
}

TEST(HalfSpace, CastsMeetThePlaneWhenTheTruthSaysSo) {
  std::mt19937_64 random(304);
  int n_met = 0, n_never = 0, n_late = 0;
  for (const char* name : kTestBodies) {
    SCOPED_TRACE(name);
    const ConvexBody b = parse_shape(name).body;
    const ExactForm form = b.exact_form().value();
    for (int k = 0; k < 10; ++k) {
      const HalfSpace a = random_half_space(random, k);
      const Transformd pose = placed_over(a, b, random, 0.5, 1.0);
      Vec3d motion = random_direction(random);
      if (k % 5 == 4) motion = cross(a.unit_normal(), motion);  // along the plane, to rounding
      const Float speed = -Float(exact::inner(exact::exactly(a.dir_normal()), exact::exactly(motion)));
      const FirstContact found = linear_cast(a, b, pose, motion);
      if (speed <= 0) {
        EXPECT_EQ(found.verdict.outcome, Outcome::disjoint);
        EXPECT_EQ(found.time, HUGE_VAL);
        ++n_never;
        continue;
      }
      ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
      const Float time = true_height(a, form, pose) / speed;
      EXPECT_LE(Float(found.lower), time);
      EXPECT_LE(time, Float(found.upper));
      EXPECT_LE(found.lower, found.time);
      EXPECT_LE(found.time, found.upper);
      EXPECT_LT(found.upper - found.lower, 1e-12 * found.time);
      EXPECT_LT(std::fabs(dot(a.unit_normal(), found.point_b) - a.offset() / a.length()),
                1e-12 * (1.0 + found.time * norm(motion)));
      ++n_met;
      // An end about the time of contact: rational numbers tell which comes first.
      for (const double end : {found.lower, found.time, found.upper, 0.5 * found.time, 2.0 * found.time}) {
        const FirstContact until = linear_cast(a, b, pose, motion, end);
        ASSERT_EQ(until.verdict.outcome, time <= Float(end) ? Outcome::overlap : Outcome::disjoint);
        n_late += until.verdict.outcome == Outcome::disjoint ? 1 : 0;
        if (until.verdict.outcome == Outcome::overlap) {
          EXPECT_LE(until.upper, end);
        }
      }
    }
  }
  EXPECT_GT(n_met, 60);
  EXPECT_GT(n_never, 60);
  EXPECT_GT(n_late, 60);
}

TEST(HalfSpace, ContactAtTheStartIsContactAtTimeZero) {
  const HalfSpace floor({0.0, 0.0, 1.0}, 0.0);
  const ConvexBody ball = parse_shape("sphere:1").body;
  const FirstContact found = linear_cast(floor, ball, Transformd{.translation = {0.0, 0.0, 0.75}}, {0.0, 0.0, 1.0});
  EXPECT_EQ(found.verdict.outcome, Outcome::overlap);
  EXPECT_EQ(found.upper, 0.0);
  EXPECT_NEAR(found.point_b.z, -0.25, 1e-15);
  EXPECT_NEAR(found.point_a.z, 0.0, 1e-15);
}

TEST(HalfSpace, ARayMeetsTheFloor) {
  const HalfSpace floor({0.0, 2.0, 2.0}, 1.0);
  const FirstContact hit = cast_ray(floor, {1.0, 2.0, 3.0}, {0.0, 0.0, -2.0});
  ASSERT_EQ(hit.verdict.outcome, Outcome::overlap);
  EXPECT_NEAR(hit.time, 2.25, 1e-15);
  EXPECT_NEAR(hit.normal.y, std::sqrt(0.5), 1e-15);
  EXPECT_EQ(cast_ray(floor, {1.0, 2.0, 3.0}, {0.0, 1.0, -1.0}).verdict.outcome, Outcome::disjoint);
  EXPECT_EQ(cast_ray(floor, {1.0, 2.0, 3.0}, {0.0, 0.0, -2.0}, 2.0).verdict.outcome, Outcome::disjoint);
}

TEST(HalfSpace, TimesBeyondDoublesAreUndecidedAndNeverHits) {
  const HalfSpace floor({0.0, 0.0, 1.0}, 0.0);
  const ConvexBody ball = parse_shape("sphere:1").body;
  const FirstContact found = linear_cast(floor, ball, Transformd{.translation = {0.0, 0.0, 1e200}}, {0, 0, -1e-200});
  EXPECT_EQ(found.verdict.outcome, Outcome::undecided);
  EXPECT_GT(found.lower, 1e300);
  const FirstContact until =
      linear_cast(floor, ball, Transformd{.translation = {0.0, 0.0, 1e200}}, {0, 0, -1e-200}, 1e300);
  EXPECT_EQ(until.verdict.outcome, Outcome::disjoint);
}

TEST(HalfSpace, HeightsBeyondDoublesAreUndecided) {
  const HalfSpace slope({1.0, 1.0, 1.9}, 0.0);
  for (const double until : {0.0, 1.0, 1e300, HUGE_VAL}) {
    const FirstContact found = cast_ray(slope, {1.7e308, 1.7e308, -1.7e308}, {0.0, 0.0, -1.0}, until);
    EXPECT_EQ(found.verdict.outcome, Outcome::undecided) << until;
  }
}

TEST(HalfSpace, WhatIsNoPlaneIsRefused) {
  EXPECT_THROW(HalfSpace({0.0, 0.0, 0.0}, 1.0), InputError);
  EXPECT_THROW(HalfSpace({0.0, HUGE_VAL, 0.0}, 1.0), InputError);
  EXPECT_THROW(HalfSpace({0.0, 0.0, 1.0}, std::nan("")), InputError);
  EXPECT_THROW(HalfSpace({0.0, 0.0, 1e-200}, 1e200), InputError);
  EXPECT_THROW(HalfSpace({0.0, 0.0, 1e300}, 1e-20), InputError);
  const HalfSpace floor({0.0, 0.0, 1e300}, 1e300);
  EXPECT_EQ(floor.offset() / floor.length(), 1.0);
  const ConvexBody ball = parse_shape("sphere:1").body;
  EXPECT_THROW(linear_cast(floor, ball, Pose(), {}), InputError);
  EXPECT_THROW(linear_cast(floor, ball, Pose(), {0.0, 0.0, 1.0}, -1.0), UsageError);
  EXPECT_THROW(PlaneContacts(ball).find(floor, Pose(), std::nan(""), *std::make_unique<std::vector<PlaneContact>>()),
               UsageError);
}

std::vector<PlaneContact> contacts(const HalfSpace& a, const char* body, const Pose& pose, double margin) {
  std::vector<PlaneContact> found;
  PlaneContacts(parse_shape(body).body).find(a, pose, margin, found);
  return found;
}

Transformd turned_about_x(double angle_rad, const Vec3d& translation) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {{1.0, 0.0, 0.0}, {0.0, c, -s}, {0.0, s, c}, translation};
}

TEST(PlaneContacts, BodiesStandOnEnoughPoints) {
  const HalfSpace floor({0.0, 0.0, 1.0}, 0.0);
  const double quarter = std::acos(0.0);
  EXPECT_EQ(contacts(floor, "box:1,1,1", Transformd{.translation = {0, 0, 0.49}}, 0.0).size(), 4u);
  EXPECT_EQ(contacts(floor, "box:1,1,1", turned_about_x(0.01, {0, 0, 0.5}), 0.02).size(), 4u);
  EXPECT_EQ(contacts(floor, "cylinder:1,0.5", Transformd{.translation = {0, 0, 0.49}}, 0.0).size(), 4u);
  EXPECT_EQ(contacts(floor, "cylinder:1,0.5", turned_about_x(quarter, {0, 0, 0.49}), 0.0).size(), 2u);
  EXPECT_EQ(contacts(floor, "capsule:1,0.25", turned_about_x(quarter, {0, 0, 0.24}), 0.0).size(), 2u);
  EXPECT_EQ(contacts(floor, "sphere:0.5", Transformd{.translation = {0, 0, 0.49}}, 0.0).size(), 1u);
  EXPECT_EQ(contacts(floor, "cone:1,0.5", Transformd{.translation = {0, 0, 0.49}}, 0.0).size(), 4u);
  EXPECT_EQ(contacts(floor, "hemisphere:0.5", Transformd{.translation = {0, 0, -0.01}}, 0.0).size(), 4u);
  EXPECT_EQ(contacts(floor, "rounded:0.1,box:1,1,1", Transformd{.translation = {0, 0, 0.59}}, 0.0).size(), 4u);
  EXPECT_EQ(contacts(floor, "lens:0.9,0.7", Transformd{.translation = {0, 0, 0.0}}, 0.0).size(), 1u);
  EXPECT_TRUE(contacts(floor, "box:1,1,1", Transformd{.translation = {0, 0, 0.51}}, 0.0).empty());
}

TEST(PlaneContacts, ArePointsOfTheBodyWithTheirDistancesAndStayingNames) {
  std::mt19937_64 random(305);
  const ConvexBody speck = parse_shape("sphere:1e-12").body;
  for (const char* name : kTestBodies) {
    SCOPED_TRACE(name);
    const ConvexBody b = parse_shape(name).body;
    const PlaneContacts points(b);
    std::vector<PlaneContact> found, after;
    for (int k = 0; k < 10; ++k) {
      const HalfSpace a = random_half_space(random, k);
      Transformd pose = placed_over(a, b, random, -0.05, 1.0);
      points.find(a, pose, 0.01, found);
      ASSERT_FALSE(found.empty());
      double deepest = HUGE_VAL;
      for (const PlaneContact& contact : found) {
        deepest = std::min(deepest, contact.signed_distance);
        EXPECT_LT(norm((contact.point_b - contact.point_a) - contact.signed_distance * a.unit_normal()), 1e-13);
        EXPECT_LT(std::fabs(dot(a.unit_normal(), contact.point_a) - a.offset() / a.length()), 1e-13);
        const Separation off = signed_distance(
            b, speck, Transformd{.translation = pose.direction_to_b(contact.point_b - pose.translation)});
        EXPECT_LT(off.lower, 1e-11);
      }
      EXPECT_NEAR(deepest, signed_distance(a, b, pose).signed_distance, 1e-12);
      // A little later the same points have the same names.
      pose.translation = pose.translation - 1e-9 * a.unit_normal();
      points.find(a, pose, 0.01 + 1e-8, after);
      std::set<std::uint32_t> names;
      for (const PlaneContact& contact : after) EXPECT_TRUE(names.insert(contact.feature).second);
      for (const PlaneContact& contact : found) EXPECT_TRUE(names.count(contact.feature) > 0);
    }
  }
}

}  // namespace
}  // namespace vex
