// Answers of compounds are proven again by their pairs of parts, and answers that were changed are not.
#include "engine/scene/compound_certificate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shapes/any_shape.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

Compound some_compound(std::mt19937_64& random, int n_parts) {
  constexpr std::array kBodies = {"box:1,1,0.5", "cylinder:1,0.5", "rounded:0.1,tetrahedron:1",
                                  "ellipsoid:0.5,0.7,0.3"};
  std::vector<CompoundPart> parts;
  for (int k = 0; k < n_parts; ++k) {
    Transformd pose = random_rotation(random);
    pose.translation = 2.0 * random_direction(random);
    parts.push_back(
        {parse_shape(kBodies[static_cast<std::size_t>(k) % kBodies.size()]).body, k == 0 ? Transformd{} : pose});
  }
  return Compound(std::move(parts));
}

template <class B>
void expect_proven_distance(const Compound& a, const B& b, const Pose& pose) {
  const CompoundSeparation found = distance(a, b, pose);
  const CompoundCertificate proof = certify(a, b, pose, found);
  const CertificateCheck check = check_certificate(a, b, pose, found, proof);
  EXPECT_TRUE(check.is_proven) << check.fault;
  CompoundSeparation lie = found;
  if (found.separation.verdict.outcome == Outcome::overlap) {
    lie.separation.verdict = Verdict::disjoint(DecidedBy::gjk);
    EXPECT_FALSE(check_certificate(a, b, pose, lie, proof).is_proven);
    return;
  }
  lie.separation.lower = lie.separation.signed_distance = lie.separation.upper = found.separation.upper + 1e-6;
  EXPECT_FALSE(check_certificate(a, b, pose, lie, proof).is_proven);
  lie = found;
  lie.separation.lower = lie.separation.signed_distance = lie.separation.upper = found.separation.lower - 1e-6;
  EXPECT_FALSE(check_certificate(a, b, pose, lie, proof).is_proven);
  lie = found;
  lie.separation.point_a.x += 1e-3;
  EXPECT_FALSE(check_certificate(a, b, pose, lie, proof).is_proven);
  CompoundCertificate less = proof;
  less.pairs.pop_back();
  EXPECT_FALSE(check_certificate(a, b, pose, found, less).is_proven);
}

TEST(CompoundCertificate, DistancesAreProvenByEveryPair) {
  std::mt19937_64 random(351);
  for (int k = 0; k < 6; ++k) {
    const Compound a = some_compound(random, 4), b = some_compound(random, 2);
    Transformd pose = random_rotation(random);
    pose.translation = (k < 4 ? 6.0 : 1.0) * random_direction(random);
    expect_proven_distance(a, b, pose);
    expect_proven_distance(a, parse_shape("capsule:1,0.25").body, pose);
  }
}

TEST(CompoundCertificate, ImpactsAreProvenByEveryPair) {
  std::mt19937_64 random(352);
  int n_met = 0;
  for (int k = 0; k < 6; ++k) {
    const Compound a = some_compound(random, 3), b = some_compound(random, 2);
    Transformd pose = random_rotation(random);
    pose.translation = 7.0 * random_direction(random);
    RigidMotion of_a{0.2 * random_direction(random), 0.4 * random_direction(random)};
    RigidMotion of_b{of_a.velocity - 0.5 * pose.translation, 0.4 * random_direction(random)};
    if (k % 3 == 2) of_a.angular_velocity = of_b.angular_velocity = {};
    const double until = 2.5;
    const CompoundContact found = time_of_impact(a, b, pose, of_a, of_b, until);
    const CompoundContactCertificate proof = certify(a, b, pose, of_a, of_b, found, until);
    const CertificateCheck check = check_certificate(a, b, pose, of_a, of_b, found, proof, until);
    EXPECT_TRUE(check.is_proven) << check.fault << ", case " << k;
    CompoundContact lie = found;
    if (found.contact.verdict.outcome == Outcome::overlap) {
      ++n_met;
      lie.contact.verdict = Verdict::disjoint(DecidedBy::gjk);
      lie.contact.time = lie.contact.lower = lie.contact.upper = HUGE_VAL;
    } else {
      lie.contact.verdict = Verdict::overlap(DecidedBy::gjk);
      lie.contact.time = lie.contact.lower = lie.contact.upper = 1.0;
      lie.part_a = lie.part_b = 0;
    }
    EXPECT_FALSE(check_certificate(a, b, pose, of_a, of_b, lie, proof, until).is_proven);
    if (found.contact.lower > 0.1 && found.contact.lower < HUGE_VAL) {
      lie = found;
      lie.contact.upper = lie.contact.time = lie.contact.lower = 0.9 * found.contact.lower;
      EXPECT_FALSE(check_certificate(a, b, pose, of_a, of_b, lie, proof, until).is_proven);
      lie = found;
      lie.contact.upper = lie.contact.time = lie.contact.lower = found.contact.upper + 0.01;
      EXPECT_FALSE(check_certificate(a, b, pose, of_a, of_b, lie, proof, until).is_proven);
    }
  }
  EXPECT_GT(n_met, 1);
}

TEST(CompoundCertificate, OverAFloorEveryPartIsProven) {
  std::mt19937_64 random(353);
  for (int k = 0; k < 6; ++k) {
    const Compound b = some_compound(random, 5);
    const HalfSpace a(random_direction(random), -2.0);
    Transformd pose = random_rotation(random);
    pose.translation = random_direction(random);
    const CompoundSeparation found = signed_distance(a, b, pose);
    const CompoundOnPlaneCertificate proof = certify(a, b, pose, found);
    const CertificateCheck check = check_certificate(a, b, pose, found, proof);
    EXPECT_TRUE(check.is_proven) << check.fault;
    CompoundSeparation lie = found;
    lie.separation.lower = lie.separation.signed_distance = lie.separation.upper = found.separation.upper + 1e-6;
    EXPECT_FALSE(check_certificate(a, b, pose, lie, proof).is_proven);
  }
}

}  // namespace
}  // namespace vex
