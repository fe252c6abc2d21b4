// False statements that the checker of certificates once accepted, each with the certificate that was to prove it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/query/contact_certificate.h"
#include "engine/query/manifold_certificate.h"
#include "engine/query/separation_certificate.h"
#include "shapes/box.h"
#include "shapes/cylinder.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

ExactVector along(const Vec3d& dir) { return {{{dir, 0}}}; }
Verdict verdict_of(Outcome outcome) { return {outcome, DecidedBy::gjk, UndecidedReason::none}; }
FirstContact no_contact() {
  FirstContact none;
  none.verdict = verdict_of(Outcome::disjoint);
  none.time = none.lower = none.upper = HUGE_VAL;
  return none;
}

// A bar that turns above a box, and meets it after a sixth of a turn.
class BarAboveBox : public ::testing::Test {
 protected:
  const ConvexBody box = Box(1, 1, 1), bar = Box(4, 0.1, 0.1);
  const Transformd pose{.translation = {0, 1.5, 0}};
  const RigidMotion turn{{}, {0, 0, 1}};
  const FirstContact truth = time_of_impact(box, bar, pose, turn);
  const ContactCertificate proof = certify(box, bar, pose, turn, truth);

  bool is_accepted(const FirstContact& claimed, const ContactCertificate& certificate, double until = HUGE_VAL) const {
    return check_certificate(box, bar, pose, turn, claimed, certificate, until).is_proven;
  }
};

TEST_F(BarAboveBox, IsProven) {
  EXPECT_EQ(truth.verdict.outcome, Outcome::overlap);
  EXPECT_TRUE(is_accepted(truth, proof));
}

TEST_F(BarAboveBox, IsNotApartByATimeBeforeTheStart) {
  for (const double before : {-6.4, -1.0, -0.0}) {
    ContactCertificate forged = proof;
    forged.apart = {{before, before, along({0, 1, 0})}};
    EXPECT_FALSE(is_accepted(no_contact(), forged)) << before;
    EXPECT_FALSE(is_accepted(no_contact(), forged, 5.0)) << before;
    FirstContact late = truth;
    late.verdict = verdict_of(Outcome::undecided);
    late.lower = late.time = 100.0;
    late.upper = HUGE_VAL;
    EXPECT_FALSE(is_accepted(late, forged)) << before;
  }
}

TEST_F(BarAboveBox, StatesTimesThatFitItsVerdict) {
  const ConvexBody& a = box;
  const Transformd far{.translation = {0, 50, 0}};
  const auto of_far = [&](const FirstContact& claimed, double until) {
    return check_certificate(a, bar, far, turn, claimed, certify(a, bar, far, turn, no_contact()), until).is_proven;
  };
  EXPECT_TRUE(of_far(no_contact(), HUGE_VAL));
  FirstContact claimed = no_contact();
  claimed.lower = 1.0;
  claimed.time = 2.0;
  claimed.upper = 3.0;
  EXPECT_FALSE(of_far(claimed, HUGE_VAL));
  claimed.lower = claimed.time = claimed.upper = kNaN;
  EXPECT_FALSE(of_far(claimed, HUGE_VAL));
  EXPECT_FALSE(of_far(no_contact(), -1.0));
  EXPECT_FALSE(of_far(no_contact(), kNaN));
  EXPECT_FALSE(check_certificate(a, bar, far, Vec3d{0, -1, 0}, no_contact(), {}, -1.0).is_proven);
  FirstContact undecided = truth;
  undecided.verdict = verdict_of(Outcome::undecided);
  undecided.lower = 0.0;
  EXPECT_FALSE(is_accepted(undecided, proof));
  FirstContact none = truth;
  none.verdict = verdict_of(static_cast<Outcome>(7));
  EXPECT_FALSE(is_accepted(none, proof));
}

TEST_F(BarAboveBox, TouchesWhereItsPointsAre) {
  FirstContact claimed = truth;
  claimed.normal = {7, 8, 9};
  EXPECT_FALSE(is_accepted(claimed, proof));
  for (Vec3d FirstContact::*point : {&FirstContact::point_a, &FirstContact::point_b, &FirstContact::point_b_in_b}) {
    for (const double off : {kNaN, static_cast<double>(HUGE_VAL), 1e-4}) {
      claimed = truth;
      (claimed.*point).z += off;
      (claimed.*point).x += off;
      (claimed.*point).y += off;
      EXPECT_FALSE(is_accepted(claimed, proof)) << off;
    }
  }
}

// A normal was read for its length and the points' distance along it alone; and nothing of what touches at the start.
TEST(ForgedCertificates, HaveTheNormalOfTheContact) {
  const ConvexBody a = Box(1, 1, 1), b = Sphere(0.5);
  const Transformd pose{.translation = {3, 0.1, 0.2}}, inside{.translation = {0.9, 0.1, 0.2}};
  const RigidMotion turning{{-1, 0, 0}, {0, 0.1, 0}}, of_a{{1, 0, 0}, {0, 0.1, 0}}, still;
  const Vec3d motion{-1, 0, 0};
  const auto refuses_others = [](const FirstContact& truth, const auto& check) {
    const auto is_accepted = [&](const FirstContact& claimed) { return check(claimed).is_proven; };
    EXPECT_EQ(check(truth).fault, "");
    for (const Vec3d& normal :
         {-truth.normal, Vec3d{0, 1, 0}, Vec3d{0, 0, -1}, Vec3d{0.8, 0.6, 0}, Vec3d{kNaN, 0, 0}}) {
      FirstContact claimed = truth;
      claimed.normal = normal;
      EXPECT_FALSE(is_accepted(claimed)) << normal.x << " " << normal.y << " " << normal.z;
    }
    FirstContact claimed = truth;
    claimed.point_b = claimed.point_b + Vec3d{0, 0.3, 0};
    EXPECT_FALSE(is_accepted(claimed));
    claimed = truth;
    claimed.point_a.z = kNaN;
    EXPECT_FALSE(is_accepted(claimed));
    claimed = truth;
    claimed.point_b_in_b.y += 0.1;
    EXPECT_FALSE(is_accepted(claimed));
  };
  for (const Transformd& at : {pose, inside}) {
    refuses_others(linear_cast(a, b, at, motion), [&](const FirstContact& claimed) {
      return check_certificate(a, b, at, motion, claimed, certify(a, b, at, motion, claimed));
    });
    refuses_others(time_of_impact(a, b, at, turning), [&](const FirstContact& claimed) {
      return check_certificate(a, b, at, turning, claimed, certify(a, b, at, turning, claimed));
    });
    refuses_others(time_of_impact(a, b, at, of_a, still), [&](const FirstContact& claimed) {
      return check_certificate(a, b, at, of_a, still, claimed, certify(a, b, at, of_a, still, claimed));
    });
  }
  for (const Vec3d& origin : {Vec3d{3, 0.1, 0.2}, Vec3d{0.4, 0.1, 0.2}}) {
    refuses_others(cast_ray(a, origin, motion), [&](const FirstContact& claimed) {
      return check_ray_certificate(a, origin, motion, claimed, certify_ray(a, origin, motion, claimed));
    });
  }
}

TEST(ForgedCertificates, HaveAVerdict) {
  const ConvexBody box = Box(1, 1, 1);
  for (const double x : {0.5, 3.0}) {
    const Transformd pose{.translation = {x, 0, 0}};
    Separation claimed = signed_distance(box, box, pose);
    const SeparationCertificate proof = certify(box, box, pose, claimed);
    claimed.verdict.outcome = static_cast<Outcome>(7);
    EXPECT_FALSE(check_certificate(box, box, pose, claimed, proof).is_proven);
    EXPECT_FALSE(check_certificate(box, box, pose, claimed.verdict.outcome, proof.sign).is_proven);
  }
}

TEST(ForgedCertificates, OneInputHasOneAnswer) {
  // B as it is placed has its corner at 0.5 and touches; as it moves it is 5.55e-17 beyond, and leaves.
  const ConvexBody a = Box(1, 1, 1), b = Box(0.6, 0.6, 0.6);
  const Transformd pose{.translation = {0.8, 0, 0}};
  const RigidMotion away{{1, 0, 0}, {1e-3, 0, 0}};
  const FirstContact found = time_of_impact(a, b, pose, away);
  EXPECT_TRUE(check_certificate(a, b, pose, away, found, certify(a, b, pose, away, found)).is_proven);
  EXPECT_EQ(found.verdict.outcome, Outcome::overlap);
  ContactCertificate forged = certify(a, b, pose, away, found);
  forged.apart = {{0.0, 1.0, along({1, 0, 0})}};
  EXPECT_FALSE(check_certificate(a, b, pose, away, no_contact(), forged).is_proven);
}

// Two boxes, one on the other, 0.1 deep.
class StackedBoxes : public ::testing::Test {
 protected:
  const ConvexBody box = Box(1, 1, 1);
  const Transformd pose{.translation = {0, 0, 0.9}};
  const Separation truth = penetration_depth(box, box, pose);

  static std::vector<Witness> corners() {
    std::vector<Witness> all;
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        for (const double z : {-1.0, 1.0}) {
          Witness corner;
          corner.dir = corner.dir_b = {x, y, z};
          corner.point_a = corner.point_b = {0.5 * x, 0.5 * y, 0.5 * z};
          all.push_back(corner);
        }
      }
    }
    return all;
  }
};

TEST_F(StackedBoxes, AreNotDeepAlongAnotherNormal) {
  SeparationCertificate forged = certify(box, box, pose, truth);
  EXPECT_TRUE(check_certificate(box, box, pose, truth, forged).is_proven);
  forged.near_a = forged.near_b = corners();
  Separation claimed = truth;
  claimed.normal = {1, 0, 0};
  claimed.point_a = {0.05, 0, 0.45};
  claimed.point_b = {-0.05, 0, 0.45};
  claimed.point_b_in_b = {-0.05, 0, -0.45};
  EXPECT_FALSE(check_certificate(box, box, pose, claimed, forged).is_proven);
}

TEST_F(StackedBoxes, HaveAFiniteValue) {
  const Transformd apart{.translation = {0, 0, 5}};
  Separation claimed = distance(box, box, apart);
  const SeparationCertificate proof = certify(box, box, apart, claimed);
  claimed.lower = 0.0;
  claimed.upper = claimed.signed_distance = HUGE_VAL;
  EXPECT_FALSE(check_certificate(box, box, apart, claimed, proof).is_proven);
  claimed.signed_distance = -HUGE_VAL;
  claimed.lower = -HUGE_VAL;
  claimed.verdict = verdict_of(Outcome::undecided);
  EXPECT_FALSE(check_certificate(box, box, apart, claimed, proof).is_proven);
}

TEST_F(StackedBoxes, MeetInOnePolygon) {
  const ContactManifold true_one = contact_manifold(box, box, pose);
  ManifoldCertificate proof = certify(box, box, pose, true_one);
  EXPECT_EQ(true_one.contacts.size(), 4u);
  EXPECT_TRUE(check_certificate(box, box, pose, true_one, proof).is_proven);
  for (ManifoldCertificate::Contact& contact : proof.contacts) contact.near_a = contact.near_b = corners();
  const auto is_accepted = [&](const ContactManifold& claimed, double margin = 0.0, double angle = 0.0) {
    ManifoldCertificate certificate = proof;
    certificate.contacts.resize(claimed.contacts.size(), proof.contacts.front());
    return check_certificate(box, box, pose, claimed, certificate, margin, angle).is_proven;
  };
  EXPECT_TRUE(is_accepted(true_one));
  EXPECT_FALSE(is_accepted(true_one, kNaN));
  EXPECT_FALSE(is_accepted(true_one, 0.0, kNaN));
  ContactManifold claimed = true_one;
  std::swap(claimed.contacts[0].point_b, claimed.contacts[2].point_b);
  EXPECT_FALSE(is_accepted(claimed)) << "points that are not opposite";
  claimed = true_one;
  claimed.contacts.insert(claimed.contacts.end(), true_one.contacts.begin(), true_one.contacts.end());
  EXPECT_FALSE(is_accepted(claimed)) << "twice around";
  claimed = true_one;
  claimed.contacts.resize(1);
  EXPECT_FALSE(is_accepted(claimed)) << "one corner";
  claimed.contacts.resize(4, true_one.contacts.front());
  EXPECT_FALSE(is_accepted(claimed)) << "one corner four times";
  claimed = true_one;
  claimed.contacts.clear();
  claimed.separation.has_witnesses = false;
  EXPECT_FALSE(is_accepted(claimed)) << "none";
}

// Manifolds of bodies whose squares are no doubles lost corners, or were no numbers.
TEST(HugeAndTinyBodies, HaveTheSameManifold) {
  for (const double size : {1e-200, 1e-161, 1.0, 1e155, 1e200}) {
    const ConvexBody box = Box(size, size, size);
    const Transformd pose{{0.8, -0.6, 0}, {0.6, 0.8, 0}, {0, 0, 1}, {0.3 * size, 0.1 * size, 0.9 * size}};
    const ContactManifold found = contact_manifold(box, box, pose);
    ASSERT_EQ(found.contacts.size(), 6u) << size;
    double area = 0.0;
    const Vec3d first = (1.0 / size) * found.contacts[0].point_a;
    for (std::size_t k = 1; k + 1 < found.contacts.size(); ++k) {
      const Vec3d p = (1.0 / size) * found.contacts[k].point_a, q = (1.0 / size) * found.contacts[k + 1].point_a;
      area += 0.5 * cross(p - first, q - first).z;
    }
    EXPECT_NEAR(std::fabs(area), 0.645833333333333, 1e-12) << size;
    EXPECT_TRUE(check_certificate(box, box, pose, found, certify(box, box, pose, found)).is_proven) << size;
  }
}

// The rim of a huge disc in a direction next to its axis was no number, a gap that was none was left out, and bodies
// that meet were proven apart for ever.
TEST(HugeAndTinyBodies, TouchWhereOthersDo) {
  for (const double size : {1.0, 1e180, 1e290}) {
    const ConvexBody sphere = Sphere(size), cylinder = Cylinder(size, size);
    Transformd pose{.translation = {0, 0, 3 * size}};
    pose.row_y = {0, 1, 1e-130};
    pose.row_z = {0, -1e-130, 1};
    const FirstContact found = time_of_impact(sphere, cylinder, pose, RigidMotion{{0, 0, -size}, {0, 0.001, 0}});
    EXPECT_EQ(found.verdict.outcome, Outcome::overlap) << size;
    EXPECT_NEAR(found.lower, 1.4999983125, 1e-9) << size;  // it leans by 1.5e-3
    EXPECT_TRUE(is_finite(cylinder.support({0, 1e-130, 1}))) << size;
  }
}

// Times until which there is nothing had no certificate: none at all, and one just before a contact.
TEST(Ends, HaveCertificates) {
  const ConvexBody box = Box(1, 1, 1);
  const Transformd pose{.translation = {1.2, 0, 0}};
  for (const RigidMotion& motion : {RigidMotion{{}, {0, 0, 1}}, RigidMotion{{-1, 0, 0}, {}}}) {
    const FirstContact found = time_of_impact(box, box, pose, motion, 0.0);
    EXPECT_EQ(found.verdict.outcome, Outcome::disjoint);
    EXPECT_TRUE(
        check_certificate(box, box, pose, motion, found, certify(box, box, pose, motion, found, 0.0), 0.0).is_proven);
  }
  const Transformd at_two{.translation = {2, 0, 0}};
  const Vec3d towards{-3, 0, 0};
  const double until = 0.3333333333333333;  // the double below a third
  const FirstContact found = linear_cast(box, box, at_two, towards, until);
  EXPECT_EQ(found.verdict.outcome, Outcome::disjoint);
  const ContactCertificate proof = certify(box, box, at_two, towards, found, until);
  EXPECT_TRUE(check_certificate(box, box, at_two, towards, found, proof, until).is_proven);
  EXPECT_FALSE(check_certificate(box, box, at_two, towards, found, proof, std::nextafter(until, 1.0)).is_proven);
}

}  // namespace
}  // namespace vex
