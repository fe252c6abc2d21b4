#include "engine/query/exact/extended_overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "engine/numeric/double_double.h"
#include "engine/query/overlap.h"
#include "engine/query/search/portal_refinement.h"
#include "engine/support/combinators.h"
#include "shapes/cylinder.h"
#include "shapes/ellipsoid.h"
#include "shapes/plate.h"
#include "tests/referees/bodies.h"
#include "tests/referees/exact_truth.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

Transformd moved_away(double x, double y, double z) { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {x, y, z}}; }

std::vector<std::string> curved_bodies() {
  std::vector<std::string> names;
  for (const char* name : kTestBodies) {
    if (!parse_shape(name).body.exact_form()->is_rounded_polytope()) names.emplace_back(name);
  }
  return names;
}

TEST(ExtendedOverlap, DecidesEllipsoidsNearContactAsExactArithmeticDoes) {
  std::mt19937_64 random(1);
  const std::vector<ConvexBody> bodies = {Ellipsoid(1, 2, 3), Ellipsoid(0.5, 0.5, 1.5), Ellipsoid(1, 1, 1e-3),
                                          Ellipsoid(1e-2, 1e-2, 3)};
  int n_extended = 0;
  for (const ConvexBody& a : bodies) {
    for (const ConvexBody& b : bodies) {
      for (int k = 0; k < 3; ++k) {
        Transformd pose = random_rotation(random);
        const Vec3d dir = random_direction(random);
        const double contact = contact_along(a, b, pose, dir);
        const double radii = a.circumradius() + b.circumradius();
        for (const double d : {1e-6, 1e-10, 1e-12, 1e-13, 1e-14, 3e-15}) {
          for (const double side : {-1.0, 1.0}) {
            pose.translation = (contact + side * d * radii / norm(dir)) * dir;
            OverlapCertificate certificate;
            const Verdict verdict = overlap(a, b, pose, &certificate);
            ASSERT_EQ(verdict.outcome, exact_outcome(a, b, pose)) << d;
            ASSERT_TRUE(check_certificate(a, b, pose, verdict.outcome, certificate).is_proven) << d;
            n_extended += verdict.by == DecidedBy::double_double ? 1 : 0;
          }
        }
      }
    }
  }
  EXPECT_GT(n_extended, 50) << "the sample must hold what double precision leaves open";
}

TEST(ExtendedOverlap, DecidesEveryCurvedPairNearContact) {
  // Along a ray from inside, B meets A up to one distance and never again (A - B is convex): what is proven on both
  // sides of the contact is the truth.
  std::mt19937_64 random(2);
  int n_overlap = 0, n_disjoint = 0, n_extended = 0;
  for (const std::string& name_a : curved_bodies()) {
    for (const char* name_b : kTestBodies) {
      const ConvexBody a = parse_shape(name_a).body, b = parse_shape(name_b).body;
      for (const bool is_turned : {false, true}) {
        Transformd pose = random_rotation(random);
        const Vec3d dir = random_direction(random);
        const ConvexBody &first = is_turned ? b : a, &second = is_turned ? a : b;
        const double contact = contact_along(first, second, pose, dir);
        const double radii = a.circumradius() + b.circumradius();
        for (const double d : {1e-3, 1e-9, 1e-12, 1e-14}) {
          for (const double side : {-1.0, 1.0}) {
            pose.translation = (contact + side * d * radii / norm(dir)) * dir;
            OverlapCertificate certificate;
            const Verdict verdict = overlap(first, second, pose, &certificate);
            ASSERT_EQ(verdict.outcome, side < 0.0 ? Outcome::overlap : Outcome::disjoint)
                << name_a << " " << name_b << " at " << side * d;
            const CertificateCheck check = check_certificate(first, second, pose, verdict.outcome, certificate);
            ASSERT_TRUE(check.is_proven) << check.fault << ": " << name_a << " " << name_b << " at " << side * d;
            (side < 0.0 ? n_overlap : n_disjoint) += 1;
            n_extended += verdict.by == DecidedBy::double_double ? 1 : 0;
          }
        }
      }
    }
  }
  EXPECT_EQ(n_overlap, n_disjoint);
  EXPECT_GT(n_extended, 300);
}

// A lower bound of the signed gap: the largest separation along many directions.
double sampled_gap(const ConvexBody& a, const ConvexBody& b, const Transformd& pose, std::mt19937_64& random) {
  double gap = -HUGE_VAL;
  for (int k = 0; k < 2000; ++k) {
    const Vec3d d = random_direction(random);
    const double apart = dot(d, pose(b.support(pose.direction_to_b(-d)))) - dot(d, a.support(d));
    gap = std::max(gap, apart / norm(d));
  }
  return gap;
}

TEST(ExtendedOverlap, BoundsTheGapOfWhatItGivesUp) {
  // With a cap too low for an answer: bounds on both sides, of what is apart and of what is not.
  std::mt19937_64 random(3);
  const ConvexBody a = Ellipsoid(1, 5, 0.3), b = Ellipsoid(2, 0.2, 1), unit = Ellipsoid(1, 1, 1);
  int n_apart = 0, n_together = 0, n_known = 0;
  for (int cap = 1; cap <= 5; ++cap) {
    for (int k = 0; k < 120; ++k) {
      Transformd pose = random_rotation(random);
      const Vec3d dir = random_direction(random);
      const bool is_apart = k % 2 == 0;
      pose.translation = (contact_along(a, b, pose, dir) * (is_apart ? 1.02 : 0.9)) * dir;
      OverlapCertificate c;
      if (overlap(a, b, pose, &c, cap).outcome == Outcome::undecided) {
        (is_apart ? n_apart : n_together) += 1;
        ASSERT_LE(c.gap_lower, c.gap_upper);
        ASSERT_TRUE(std::isfinite(c.gap_lower) && std::isfinite(c.gap_upper));
        if (is_apart) {
          ASSERT_GE(c.gap_upper, sampled_gap(a, b, pose, random) - 1e-12);
        } else {
          ASSERT_LE(c.gap_lower, 0.0);
          ASSERT_GE(c.gap_upper, 0.0);
        }
      }
      // Balls that are not called so: the gap is known.
      const double gap = is_apart ? 1e-3 : -1e-3;
      pose.translation = ((2.0 + gap) / norm(dir)) * dir;
      if (overlap(unit, unit, pose, &c, cap).outcome == Outcome::undecided) {
        ++n_known;
        ASSERT_LE(c.gap_lower, gap + 1e-14);
        ASSERT_GE(c.gap_upper, gap - 1e-14);
      }
    }
  }
  EXPECT_GT(n_apart, 40);
  EXPECT_GT(n_together, 120);
  EXPECT_GT(n_known, 120);
}

TEST(ExtendedOverlap, OfWhatTouchesExactlyBoundsTheGapTightly) {
  // Contact on an axis, where nothing is rounded: the signed gap is 0.
  struct Touch {
    ConvexBody a, b;
    Transformd pose;
  };
  const Transformd quarter{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}, {3, 0, 0}};
  for (const Touch& touch : std::vector<Touch>{{Ellipsoid(1, 2, 3), Plate(1, 1), moved_away(0, 0, 3)},
                                               {Ellipsoid(1, 2, 3), Ellipsoid(1, 2, 3), moved_away(0, 0, 6)},
                                               {Ellipsoid(1, 2, 3), Ellipsoid(1, 2, 3), quarter},
                                               {Plate(1, 1), Ellipsoid(3, 1, 2), moved_away(0, 0, -2)},
                                               {Cylinder(2, 1), Cylinder(2, 1), moved_away(0, 0, 2)},
                                               {Cylinder(2, 1), Ellipsoid(1, 2, 3), moved_away(2, 0, 0)}}) {
    const double radii = touch.a.circumradius() + touch.b.circumradius();
    OverlapCertificate c;
    const Verdict verdict = overlap(touch.a, touch.b, touch.pose, &c);
    if (verdict.outcome == Outcome::undecided) {
      EXPECT_EQ(verdict.by, DecidedBy::double_double);
      EXPECT_EQ(verdict.reason, UndecidedReason::rounding);
      EXPECT_LE(c.gap_lower, 0.0);
      EXPECT_GE(c.gap_upper, 0.0);
      EXPECT_LE(c.gap_upper - c.gap_lower, 1e-14 * radii);
    } else {
      EXPECT_EQ(verdict.outcome, Outcome::overlap) << "they share a point";
      EXPECT_TRUE(check_certificate(touch.a, touch.b, touch.pose, verdict.outcome, c).is_proven);
    }
  }
}

TEST(ExtendedOverlap, DoesNotDependOnTheUnitOfLength) {
  // By a power of two nothing but exponents changes, near the ends of the promised range as well: the square of a
  // semi-axis of 1e-150 along a direction of 1e-16 is below the smallest double.
  std::mt19937_64 random(4);
  for (int k = 0; k < 60; ++k) {
    const ConvexBody a = Ellipsoid(1, 2, 3), b = Ellipsoid(1, 1, 0.5), c = Cylinder(2, 0.5);
    Transformd pose = random_rotation(random);
    const Vec3d dir = random_direction(random);
    const double to_b = contact_along(a, b, pose, dir), to_c = contact_along(a, c, pose, dir);
    for (const int exponent : {-800, -498, -400, 400, 498, 800}) {
      const double s = std::ldexp(1.0, exponent);
      const ConvexBody scaled_a = Ellipsoid(s, 2 * s, 3 * s), scaled_b = Ellipsoid(s, s, 0.5 * s);
      const ConvexBody scaled_c = Cylinder(2 * s, 0.5 * s);
      for (const double factor : {1 - 1e-3, 1 + 1e-3, 1 - 1e-9, 1 + 1e-9, 1 - 1e-13, 1 + 1e-13}) {
        const Outcome truth = factor < 1.0 ? Outcome::overlap : Outcome::disjoint;
        Transformd scaled = pose;
        pose.translation = (to_b * factor) * dir;
        scaled.translation = s * pose.translation;
        ASSERT_EQ(overlap(a, b, pose).outcome, truth);
        OverlapCertificate certificate;
        ASSERT_EQ(overlap(scaled_a, scaled_b, scaled, &certificate).outcome, truth) << exponent << " " << factor;
        ASSERT_TRUE(check_certificate(scaled_a, scaled_b, scaled, truth, certificate).is_proven);
        pose.translation = (to_c * factor) * dir;
        scaled.translation = s * pose.translation;
        ASSERT_EQ(overlap(a, c, pose).outcome, truth);
        ASSERT_EQ(overlap(scaled_a, scaled_c, scaled, &certificate).outcome, truth) << exponent << " " << factor;
      }
    }
  }
}

// A user's body: a support mapping, and no more.
struct Nameless {
  Ellipsoid body{1, 2, 3};
  Vec3d centre() const { return {}; }
  double circumradius() const { return 3.0; }
  double inradius() const { return 1.0; }
  double support_error() const { return body.support_error(); }
  Vec3d support(const Vec3d& dir) const { return body.support(dir); }
};

TEST(ExtendedOverlap, IsNotThereForABodyWithoutExactForm) {
  const ConvexBody nameless = Nameless{}, named = Ellipsoid(1, 2, 3);
  EXPECT_FALSE(placed_forms(nameless, named, {}).has_value());
  EXPECT_FALSE(placed_forms(named, nameless, {}).has_value());
  const Transformd near = moved_away(2.0 + 1e-15, 0, 0);
  OverlapCertificate certificate;
  certificate.gap_lower = 1.0;  // left over from elsewhere
  const Verdict verdict = overlap(nameless, named, near, &certificate);
  EXPECT_EQ(verdict.outcome, Outcome::undecided);
  EXPECT_EQ(verdict.by, DecidedBy::gjk);
  EXPECT_EQ(certificate.gap_lower, -HUGE_VAL) << "nothing is known of the gap";
  EXPECT_EQ(certificate.gap_upper, HUGE_VAL);
  EXPECT_EQ(certificate.n_witnesses, 0);
  EXPECT_EQ(overlap(named, named, near).outcome, Outcome::disjoint) << "which is decided where the form is known";
  // Far from contact it is decided as any other, for lack of a form without witnesses.
  EXPECT_EQ(overlap(nameless, named, moved_away(2.1, 0, 0), &certificate).outcome, Outcome::disjoint);
  EXPECT_EQ(overlap(nameless, named, moved_away(1.9, 0, 0), &certificate).outcome, Outcome::overlap);
  EXPECT_EQ(certificate.n_witnesses, 0);
}

TEST(ExtendedOverlap, SearchesInDoubleDoubleAsInDouble) {
  // The search of portal_refinement.h with the other lane type: the same outcomes away from contact, and answers where
  // double precision has none.
  std::mt19937_64 random(5);
  using L = DoubleDouble;
  const Ellipsoid a(1, 2, 3), b(1, 1, 0.5);
  const ConvexBody body_a = a, body_b = b;
  int n_overlap = 0, n_disjoint = 0, n_more = 0;
  for (int k = 0; k < 1000; ++k) {
    Transformd pose = random_rotation(random);
    const Vec3d dir = random_direction(random);
    const double contact = contact_along(body_a, body_b, pose, dir);
    const double off = std::ldexp(1.0, -1 - k % 50);
    pose.translation = (contact * ((k / 50) % 2 == 0 ? 1.0 + off : 1.0 - off)) * dir;
    const Vec3d inner = Vec3d{0.01, 0.02, 0.03} - pose.translation;
    const Posed<Ellipsoid, double> placed(b, pose);
    const PortalResult<double> in_double =
        refine_portal(MinkowskiDifference(a, placed), inner, query_error(body_a, body_b, pose), 300);
    const Transform<L> extended{broadcast<L>(pose.row_x), broadcast<L>(pose.row_y), broadcast<L>(pose.row_z),
                                broadcast<L>(pose.translation)};
    const Posed<Ellipsoid, L> extended_placed(b, extended);
    const PortalResult<L> in_extended =
        refine_portal<L>(MinkowskiDifference(a, extended_placed), broadcast<L>(inner), {L(16.0), L(0x1p-90)}, 300);
    ASSERT_FALSE(in_extended.capped);
    if (in_double.disjoint || in_double.overlap) {
      ASSERT_EQ(in_extended.disjoint, in_double.disjoint) << k;
      ASSERT_EQ(in_extended.overlap, in_double.overlap) << k;
      (in_double.overlap ? n_overlap : n_disjoint) += 1;
    } else {
      n_more += in_extended.disjoint || in_extended.overlap ? 1 : 0;
    }
  }
  EXPECT_GT(n_overlap, 300);
  EXPECT_GT(n_disjoint, 300);
  EXPECT_GT(n_more, 20);
}

}  // namespace
}  // namespace vex
