// Found 2026-11 by a hostile referee: an impact of two balls that touch at the start, given as ellipsoids, with an end
// of 0: `disjoint`, "proven", which no checker accepted.
//
// Cause. The search went on as long as its time was before the end, and answered `disjoint` once it was not. Where the
// end is the start it had looked at nothing, and whether the bodies are apart there was undecided.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/query/contact_certificate.h"
#include "engine/query/overlap.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

ConvexBody named_body(const std::string& text) { return parse_shape(text).body; }
Transformd at(double x) { return {.translation = {x, 0.0, 0.0}}; }

FirstContact proven_impact(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const RigidMotion& of_a,
                           const RigidMotion& of_b, double until) {
  const FirstContact found = time_of_impact(a, b, pose, of_a, of_b, until);
  const CertificateCheck check =
      check_certificate(a, b, pose, of_a, of_b, found, certify(a, b, pose, of_a, of_b, found, until), until);
  EXPECT_TRUE(check.is_proven) << check.fault << " until " << until;
  return found;
}

TEST(EndsAtTheStart, OfBodiesThatMayTouchThereAreUndecided) {
  const ConvexBody ball = named_body("ellipsoid:1,1,1");
  const Pose touching = at(2.0);
  ASSERT_EQ(overlap(ball, ball, touching).outcome, Outcome::undecided);
  const RigidMotion turning{{}, {0.0, 0.0, 10.0}}, leaving{{1.0, 0.0, 0.0}, {}}, both{{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  for (const RigidMotion& of_b : {turning, leaving, both}) {
    for (const RigidMotion& of_a : {RigidMotion{}, turning, RigidMotion{{0.0, 1e-30, 0.0}, {}}}) {
      const FirstContact found = proven_impact(ball, ball, touching, of_a, of_b, 0.0);
      EXPECT_NE(found.verdict.outcome, Outcome::disjoint);
      EXPECT_EQ(found.lower, 0.0);
    }
  }
  EXPECT_NE(linear_cast(ball, ball, touching, {1.0, 0.0, 0.0}, 0.0).verdict.outcome, Outcome::disjoint);
  EXPECT_NE(cast_ray(ball, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.0).verdict.outcome, Outcome::disjoint);
}

TEST(EndsAtTheStart, OfBodiesThatAreApartThereAreDisjoint) {
  const ConvexBody ball = named_body("ellipsoid:1,1,1");
  const RigidMotion of_b{{-1.0, 0.0, 0.0}, {0.0, 0.0, 10.0}};
  for (const double x : {2.0 + 0x1p-40, 2.5, 100.0}) {
    EXPECT_EQ(proven_impact(ball, ball, at(x), {}, of_b, 0.0).verdict.outcome, Outcome::disjoint) << x;
  }
}

// The first contact is at 0.5 exactly, and the search comes to it from before, or begins there.
TEST(EndsAtTheStart, AndThoseAtAContactAreNotDisjoint) {
  const RigidMotion of_b{{-2.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, of_a{{0.25, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  const RigidMotion faster{{-1.75, 0.0, 0.0}, {0.5, 0.0, 0.0}};
  for (const char* const text :
       {"sphere:0.5", "ellipsoid:0.5,0.5,0.5", "box:1,1,1", "capsule:1,0.5", "cylinder:1,0.5"}) {
    const ConvexBody a = named_body(text), ball = named_body("sphere:0.5");
    for (const double until : {0.5, 0.5 + 0x1p-53, 0.5 + 0x1p-44}) {
      EXPECT_NE(proven_impact(a, ball, at(2.0), {}, of_b, until).verdict.outcome, Outcome::disjoint) << text;
      EXPECT_NE(proven_impact(a, ball, at(2.0), of_a, faster, until).verdict.outcome, Outcome::disjoint) << text;
    }
    EXPECT_EQ(proven_impact(a, ball, at(2.0), {}, of_b, 0.5 - 0x1p-30).verdict.outcome, Outcome::disjoint) << text;
  }
}

}  // namespace
}  // namespace vex
