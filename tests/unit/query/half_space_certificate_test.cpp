// The checker of what half-spaces answer proves every answer, and none that was changed.
#include "engine/query/half_space_certificate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

Transformd pose_over(const HalfSpace& a, const ConvexBody& b, std::mt19937_64& random, double height) {
  Transformd pose = random_rotation(random);
  pose.translation = 3.0 * random_direction(random);
  for (int step = 0; step < 3; ++step) {
    const double now = signed_distance(a, b, pose).signed_distance;
    pose.translation = pose.translation - (now - height) * a.unit_normal();
  }
  return pose;
}

template <class Answer, class Prove>
void expect_only_true_ones(const Answer& answer, const std::vector<std::function<void(Answer&)>>& lies,
                           const Prove& prove) {
  const CertificateCheck check = prove(answer);
  ASSERT_TRUE(check.is_proven) << check.fault;
  for (std::size_t k = 0; k < lies.size(); ++k) {
    Answer changed = answer;
    lies[k](changed);
    EXPECT_FALSE(prove(changed).is_proven) << "lie " << k;
  }
}

TEST(HalfSpaceCertificate, DistancesAndDepthsAreProvenAndNoOthers) {
  std::mt19937_64 random(341);
  for (const char* name : kTestBodies) {
    SCOPED_TRACE(name);
    const ConvexBody b = parse_shape(name).body;
    for (const double height : {0.4, -0.1, 0.0, 0x1p-52}) {
      const HalfSpace a(4.0 * random_direction(random), 0.25);
      const Pose pose = pose_over(a, b, random, height);
      const Separation found = signed_distance(a, b, pose);
      const HalfSpaceCertificate proof = certify(a, b, pose, found);
      const double more = 1e-9;
      expect_only_true_ones<Separation>(
          found,
          {[&](Separation& x) { x.lower = x.signed_distance = x.upper = x.upper + more; },
           [&](Separation& x) { x.lower = x.signed_distance = x.upper = x.lower - more; },
           [&](Separation& x) {
             x.verdict = x.verdict.outcome == Outcome::overlap ? Verdict::disjoint(DecidedBy::gjk)
                                                               : Verdict::overlap(DecidedBy::gjk);
           },
           [&](Separation& x) { x.normal = -x.normal; },
           [&](Separation& x) { x.point_a = x.point_a + 1e-6 * x.normal; }, [&](Separation& x) { x.point_b.x += 1e-6; },
           [&](Separation& x) {
             x.point_b_in_b = x.point_b_in_b + Vec3d{1e-6, 1e-6, 1e-6};
           }},
          [&](const Separation& claimed) { return check_certificate(a, b, pose, claimed, proof); });
    }
  }
}

TEST(HalfSpaceCertificate, CastsAndImpactsAreProvenAndNoOthers) {
  std::mt19937_64 random(342);
  int n_met = 0, n_never = 0;
  for (const char* name : kTestBodies) {
    SCOPED_TRACE(name);
    const ConvexBody b = parse_shape(name).body;
    for (int k = 0; k < 8; ++k) {
      const HalfSpace a(random_direction(random), -0.25);
      const Pose pose = pose_over(a, b, random, k % 4 == 3 ? -0.01 : 0.3);
      RigidMotion motion{random_direction(random), 2.0 * random_direction(random)};
      if (k % 4 == 1) motion.angular_velocity = {};
      const double until = k % 2 == 0 ? HUGE_VAL : 2.0;
      const FirstContact found = time_of_impact(a, b, pose, motion, until);
      const HalfSpaceCertificate proof = certify(a, b, pose, motion, found, until);
      const auto prove = [&](const FirstContact& claimed) {
        return check_certificate(a, b, pose, motion, claimed, proof, until);
      };
      if (found.verdict.outcome == Outcome::disjoint) {
        ++n_never;
        expect_only_true_ones<FirstContact>(found,
                                            {[](FirstContact& x) { x.lower = 1.0; },
                                             [](FirstContact& x) {
                                               x.verdict = Verdict::overlap(DecidedBy::gjk);
                                               x.time = x.lower = x.upper = 1.0;
                                             }},
                                            prove);
        continue;
      }
      ASSERT_EQ(found.verdict.outcome, Outcome::overlap);
      ++n_met;
      expect_only_true_ones<FirstContact>(
          found,
          {[](FirstContact& x) { x.lower = x.time = x.upper = x.upper + 1e-3; },
           [](FirstContact& x) {
             x.verdict = Verdict::disjoint(DecidedBy::gjk);
             x.time = x.lower = x.upper = HUGE_VAL;
           },
           [](FirstContact& x) { x.normal = -x.normal; }, [](FirstContact& x) { x.point_a.y += 1e-3; },
           [](FirstContact& x) {
             x.point_b_in_b = x.point_b_in_b + Vec3d{1e-3, 1e-3, 1e-3};
           }},
          prove);
      if (found.lower > 0.01) {
        FirstContact early = found;
        early.lower = early.time = early.upper = 0.99 * found.lower;
        EXPECT_FALSE(prove(early).is_proven);
      }
    }
  }
  EXPECT_GT(n_met, 40);
  EXPECT_GT(n_never, 20);
}

// Steps as long as the search's own bound of what bends allows were a little too long for the checker's.
TEST(HalfSpaceCertificate, StepsThatFitTheSearchAreProven) {
  struct Motion {
    const char* body;
    Vec3d at, velocity, angular_velocity;
    double until;
  };
  for (const Motion& x : {Motion{"disc:1", {0, 0, 1.25}, {0, 0, -1}, {0.25, -0.625, 0.5}, HUGE_VAL},
                          Motion{"box:2,0.1,0.1", {0, 0, 1.25}, {0, 0, -0.1}, {0.25, -1.25, 0.5}, HUGE_VAL},
                          Motion{"disc:0.026113094825296855",
                                 {0, 0, 3.9338218375942439e-05},
                                 {0.01724792436771827, 0.017413655108289319, 0},
                                 {0.15382248631108997, -0.90398047979701368, 0.0080039303503369741},
                                 3.7635}}) {
    const ConvexBody b = parse_shape(x.body).body;
    const HalfSpace floor({0, 0, 1}, 0.0);
    Transformd pose;
    pose.translation = x.at;
    const RigidMotion motion{x.velocity, x.angular_velocity};
    const FirstContact found = time_of_impact(floor, b, Pose(pose), motion, x.until);
    EXPECT_NE(found.verdict.outcome, Outcome::undecided) << x.body;
    const HalfSpaceCertificate proof = certify(floor, b, Pose(pose), motion, found, x.until);
    EXPECT_EQ(check_certificate(floor, b, Pose(pose), motion, found, proof, x.until).fault, "") << x.body;
  }
}

TEST(HalfSpaceCertificate, ContactsAreProvenAndNoOthers) {
  std::mt19937_64 random(343);
  for (const char* name : kTestBodies) {
    SCOPED_TRACE(name);
    const ConvexBody b = parse_shape(name).body;
    const HalfSpace a(random_direction(random), 0.5);
    const Pose pose = pose_over(a, b, random, -0.02);
    std::vector<PlaneContact> found;
    PlaneContacts(b).find(a, pose, 0.01, found);
    ASSERT_FALSE(found.empty());
    const HalfSpaceCertificate proof = certify(a, b, pose, std::span<const PlaneContact>(found));
    const auto check = [&] { return check_certificate(a, b, pose, std::span<const PlaneContact>(found), proof, 0.01); };
    EXPECT_TRUE(check().is_proven) << check().fault;
    found.front().signed_distance += 1e-6;
    EXPECT_FALSE(check().is_proven);
  }
}

TEST(HalfSpaceCertificate, WhatTouchesExactlyIsProvenToAllDigits) {
  const HalfSpace floor({0.0, 0.0, 3.0}, 0.0);
  for (const auto& [name, height] : {std::pair{"cylinder:1,0.5", 0.5},
                                     {"sphere:0.75", 0.75},
                                     {"ellipsoid:1,2,0.75", 0.75},
                                     {"hemisphere:0.5", 0.0}}) {
    SCOPED_TRACE(name);
    const ConvexBody b = parse_shape(name).body;
    for (const double up : {0.0, 0x1p-52}) {
      const Pose pose = Transformd{.translation = {1e3, 0.0, height + up}};
      Separation found = signed_distance(floor, b, pose);
      EXPECT_EQ(found.verdict.outcome, up > 0.0 ? Outcome::disjoint : Outcome::overlap);
      EXPECT_TRUE(check_certificate(floor, b, pose, found, certify(floor, b, pose, found)).is_proven);
      found.lower = found.signed_distance = found.upper = up > 0.0 ? 0x1p-60 : -0x1p-60;
      found.has_witnesses = false;
      EXPECT_FALSE(check_certificate(floor, b, pose, found, {}).is_proven);
    }
  }
}

}  // namespace
}  // namespace vex
