#include "engine/query/certificate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "engine/query/overlap.h"
#include "shapes/ellipsoid.h"
#include "shapes/needle.h"
#include "shapes/plate.h"
#include "shapes/sphere.h"
#include "tests/referees/bodies.h"
#include "tests/referees/exact_truth.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

Transformd shifted(double x, double y, double z) { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {x, y, z}}; }

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = HUGE_VAL;

// A pair, a pose, and what the query says of it.
struct Proven {
  ConvexBody a, b;
  Transformd pose;
  OverlapCertificate certificate;
  Verdict verdict;

  Proven(ConvexBody body_a, ConvexBody body_b, const Transformd& a_from_b)
      : a(std::move(body_a)), b(std::move(body_b)), pose(a_from_b), verdict(overlap(a, b, pose, &certificate)) {}

  bool proves(Outcome claimed, const OverlapCertificate& c) const {
    return check_certificate(a, b, pose, claimed, c).is_proven;
  }
  bool proves(const OverlapCertificate& c) const { return proves(verdict.outcome, c); }
  Outcome opposite() const { return verdict.outcome == Outcome::overlap ? Outcome::disjoint : Outcome::overlap; }
};

TEST(Certificate, OfEveryPairFarAndNearIsProven) {
  std::mt19937_64 random(1);
  int n_overlap = 0, n_disjoint = 0, n_undecided = 0;
  for (const char* name_a : kTestBodies) {
    const ConvexBody a = parse_shape(name_a).body;
    for (const char* name_b : kTestBodies) {
      const ConvexBody b = parse_shape(name_b).body;
      Transformd pose = random_rotation(random);
      const Vec3d dir = random_direction(random);
      const double contact = contact_along(a, b, pose, dir);
      for (const double factor :
           {0.7, 1.4, 1.0 - 1e-3, 1.0 + 1e-3, 1.0 - 1e-12, 1.0 + 1e-12, 1.0 - 1e-15, 1.0 + 1e-15}) {
        pose.translation = (contact * factor) * dir;
        const Proven proven(a, b, pose);
        const Outcome outcome = proven.verdict.outcome;
        (outcome == Outcome::overlap ? n_overlap : (outcome == Outcome::disjoint ? n_disjoint : n_undecided)) += 1;
        if (outcome == Outcome::undecided) {
          ASSERT_LT(std::fabs(factor - 1.0), 2e-15) << name_a << " " << name_b;
          ASSERT_FALSE(a.exact_form()->is_rounded_polytope() && b.exact_form()->is_rounded_polytope());
          ASSERT_FALSE(proven.proves(Outcome::undecided, proven.certificate)) << "which claims nothing";
          continue;
        }
        const CertificateCheck check = check_certificate(a, b, pose, outcome, proven.certificate);
        ASSERT_TRUE(check.is_proven) << name_a << " " << name_b << " at " << factor << ": " << check.fault;
        ASSERT_TRUE(check.fault.empty());
        const CertificateCheck opposite = check_certificate(a, b, pose, proven.opposite(), proven.certificate);
        ASSERT_FALSE(opposite.is_proven) << name_a << " " << name_b << " at " << factor;
        ASSERT_FALSE(opposite.fault.empty());
      }
    }
  }
  EXPECT_GT(n_overlap, 1500);
  EXPECT_GT(n_disjoint, 1500);
  EXPECT_LT(n_undecided, 200);
}

TEST(Certificate, WithANumberThatIsNoneProvesNothing) {
  const std::vector<Proven> all = {
      {test_box(1, 1, 1).body, test_box(1, 1, 1).body, shifted(0.5, 0.25, 0.125)},
      {test_box(1, 1, 1).body, test_box(1, 1, 1).body, shifted(1.5, 0.25, 0.125)},
      {test_box(1, 1, 1).body, test_box(1, 1, 1).body, shifted(std::nextafter(1.0, 2.0), 0.25, 0.125)},
      {Ellipsoid(1, 2, 3), Ellipsoid(1, 2, 3), shifted(1.5, 0.25, 0.125)},
      {Ellipsoid(1, 2, 3), Ellipsoid(1, 2, 3), shifted(2.5, 0.25, 0.125)}};
  for (const Proven& proven : all) {
    ASSERT_TRUE(proven.proves(proven.certificate));
    for (const double bad : {kNan, kInf, -kInf}) {
      const bool has_dir = norm_1(proven.certificate.separating_dir) > 0.0;
      std::vector<std::function<double&(OverlapCertificate&)>> fields = {
          [](OverlapCertificate& c) -> double& { return c.separating_dir.y; },
          [](OverlapCertificate& c) -> double& { return c.separating_dir_low.z; }};
      if (!has_dir) {
        fields.emplace_back([](OverlapCertificate& c) -> double& { return c.witnesses[0].point_a.x; });
        fields.emplace_back([](OverlapCertificate& c) -> double& { return c.witnesses[0].point_b.z; });
      }
      if (!proven.a.exact_form()->is_rounded_polytope() && proven.verdict.outcome == Outcome::overlap) {
        fields.emplace_back([](OverlapCertificate& c) -> double& { return c.witnesses[3].dir.y; });
        fields.emplace_back([](OverlapCertificate& c) -> double& { return c.witnesses[2].dir_low.x; });
        fields.emplace_back([](OverlapCertificate& c) -> double& { return c.witnesses[1].dir_b.z; });
        fields.emplace_back([](OverlapCertificate& c) -> double& { return c.witnesses[0].dir_b_low.y; });
      }
      for (const auto& field : fields) {
        OverlapCertificate tampered = proven.certificate;
        field(tampered) = bad;
        EXPECT_FALSE(proven.proves(tampered));
      }
      Transformd pose = proven.pose;
      pose.translation.x = bad;
      EXPECT_FALSE(check_certificate(proven.a, proven.b, pose, proven.verdict.outcome, proven.certificate).is_proven);
      pose = proven.pose;
      pose.row_y.z = bad;
      EXPECT_FALSE(check_certificate(proven.a, proven.b, pose, proven.verdict.outcome, proven.certificate).is_proven);
    }
  }
  // Vertices that are placed beyond the largest double.
  const ConvexBody huge = Polytope(std::vector<Vec3d>{{1.5e308, 0, 0}}, {1.5e308, 0, 0}, 0.0);
  OverlapCertificate apart;
  apart.separating_dir = {-1, 0, 0};
  EXPECT_FALSE(check_certificate(huge, huge, shifted(-1.5e308, 0, 0), Outcome::overlap, apart).is_proven);
  EXPECT_FALSE(check_certificate(huge, huge, shifted(1.5e308, 0, 0), Outcome::overlap, apart).is_proven);
}

TEST(Certificate, WithoutContentsProvesNothing) {
  const ConvexBody box = test_box(1, 1, 1).body, round = Ellipsoid(1, 2, 3);
  for (const Proven& proven : std::vector<Proven>{{box, box, shifted(0.5, 0.2, 0.1)},
                                                  {box, box, shifted(1.5, 0.2, 0.1)},
                                                  {round, box, shifted(0.5, 0.2, 0.1)},
                                                  {round, box, shifted(2.5, 0.2, 0.1)},
                                                  {Sphere(1), round, shifted(0, 0, 5)}}) {
    ASSERT_TRUE(proven.proves(proven.certificate));
    for (const Outcome claimed : {Outcome::disjoint, Outcome::overlap, Outcome::undecided}) {
      EXPECT_FALSE(proven.proves(claimed, {}));
    }
    for (const int n : {-1, 0, 7, 1000000}) {
      OverlapCertificate tampered = proven.certificate;
      tampered.n_witnesses = n;
      tampered.separating_dir = tampered.separating_dir_low = {};
      EXPECT_FALSE(proven.proves(tampered)) << n;
    }
  }
}

TEST(Certificate, OfASeparationIsRefusedWhenItsDirectionIsBent) {
  struct Near {
    ConvexBody a, b;
    Transformd pose;
  };
  // Each 1e-12 apart, along x; a face or a curved surface there, so that every tilt by more than 1e-5 fails.
  const double gap = 1e-12;
  for (const Near& near : std::vector<Near>{{Sphere(1), Sphere(2), shifted(3 + gap, 0, 0)},
                                            {test_box(1, 1, 1).body, test_box(1, 1, 1).body, shifted(1 + gap, 0, 0)},
                                            {Ellipsoid(1, 2, 3), Ellipsoid(1, 1, 1), shifted(2 + gap, 0, 0)},
                                            {Ellipsoid(1, 2, 3), test_box(2, 1, 1).body, shifted(2 + gap, 0, 0)}}) {
    const Proven proven(near.a, near.b, near.pose);
    ASSERT_EQ(proven.verdict.outcome, Outcome::disjoint);
    ASSERT_TRUE(proven.proves(proven.certificate));
    OverlapCertificate tampered;
    tampered.separating_dir = {-1, 0, 0};
    EXPECT_FALSE(proven.proves(tampered)) << "the other way round";
    tampered.separating_dir = {1, 0, 0};
    EXPECT_TRUE(proven.proves(tampered)) << "the axis itself, whatever the search has found";
    tampered.separating_dir_low = {-2, 0, 0};
    EXPECT_FALSE(proven.proves(tampered)) << "the lower half counts";
    for (const double tilt : {1e-5, 1e-3, 0.1, 10.0}) {
      tampered = {};
      tampered.separating_dir = {1, tilt, 0};
      EXPECT_FALSE(proven.proves(tampered)) << tilt;
      tampered.separating_dir = {1, 0, -tilt};
      EXPECT_FALSE(proven.proves(tampered)) << tilt;
      tampered.separating_dir = {1, 0, 0};
      tampered.separating_dir_low = {0, tilt, 0};
      EXPECT_FALSE(proven.proves(tampered)) << tilt;
    }
    // Any length of the same direction proves the same.
    for (const double length : {1e-300, 0x1p-1074, 1e300}) {
      tampered = {};
      tampered.separating_dir = {length, 0, 0};
      EXPECT_TRUE(proven.proves(tampered)) << length;
      tampered.separating_dir = {0, length, 0};
      EXPECT_FALSE(proven.proves(tampered)) << length;
    }
  }
}

TEST(Certificate, OfAnOverlapIsRefusedWhenItsWitnessesAreOthers) {
  std::mt19937_64 random(2);
  const std::vector<ConvexBody> bodies = {test_box(1, 1, 1).body, Ellipsoid(1, 0.5, 0.7), test_tetrahedron(0.6).body,
                                          parse_shape("cylinder:1,0.5").body, parse_shape("hemisphere:0.8").body};
  int n_permuted = 0, n_permuted_proven = 0, n_pairs = 0;
  for (const ConvexBody& a : bodies) {
    for (const ConvexBody& b : bodies) {
      for (int k = 0; k < 6; ++k) {
        Transformd pose = random_rotation(random);
        const Vec3d dir = random_direction(random);
        const double contact = contact_along(a, b, pose, dir);
        pose.translation = (contact * (1.0 - 1e-3)) * dir;
        const Proven near(a, b, pose);
        ASSERT_EQ(near.verdict.outcome, Outcome::overlap);
        ASSERT_TRUE(near.proves(near.certificate));
        const int n = near.certificate.n_witnesses;
        ++n_pairs;
        // One dropped: the origin is inside the tetrahedron of four, so on none of its faces.
        if (n == 4) {
          for (std::size_t dropped = 0; dropped < 4; ++dropped) {
            OverlapCertificate tampered = near.certificate;
            tampered.witnesses[dropped] = tampered.witnesses[3];
            tampered.n_witnesses = 3;
            EXPECT_FALSE(near.proves(tampered));
            tampered.n_witnesses = 4;
            tampered.witnesses[3] = tampered.witnesses[(dropped + 1) % 3];
            EXPECT_FALSE(near.proves(tampered)) << "the same twice";
          }
        }
        OverlapCertificate tampered = near.certificate;
        for (Witness& witness : tampered.witnesses) witness = tampered.witnesses[0];
        EXPECT_FALSE(near.proves(tampered)) << "all the same";
        // Every body's points turned over to another witness.
        tampered = near.certificate;
        for (int j = 0; j < n; ++j) {
          const auto i = static_cast<std::size_t>(j), next = static_cast<std::size_t>((j + 1) % n);
          tampered.witnesses[i].point_b = near.certificate.witnesses[next].point_b;
          tampered.witnesses[i].dir_b = near.certificate.witnesses[next].dir_b;
          tampered.witnesses[i].dir_b_low = near.certificate.witnesses[next].dir_b_low;
        }
        ++n_permuted;
        n_permuted_proven += near.proves(tampered) ? 1 : 0;
        // The same witnesses where the bodies are apart.
        Proven apart = near;
        for (const double factor : {1.0 + 1e-3, 1.0 + 1e-9, 1.5}) {
          apart.pose.translation = (contact * factor) * dir;
          ASSERT_EQ(overlap(a, b, apart.pose).outcome, Outcome::disjoint);
          EXPECT_FALSE(apart.proves(Outcome::overlap, near.certificate)) << factor;
          EXPECT_FALSE(apart.proves(Outcome::overlap, tampered)) << factor;
        }
      }
    }
  }
  EXPECT_LT(n_permuted_proven, n_permuted / 4) << "of " << n_pairs;
}

TEST(Certificate, NamesVerticesByTheNearestOne) {
  // Points that are no vertices mean the nearest vertex; what that proves is about the body, not about the points.
  const Proven inside(test_box(2, 2, 2).body, test_box(2, 2, 2).body, shifted(1, 0.5, 0.25));
  OverlapCertificate c;
  c.n_witnesses = 1;
  c.witnesses[0].point_a = {0.5, 0.25, 0.125};  // in both boxes; but it names the vertex (1, 1, 1)
  c.witnesses[0].point_b = {-0.5, -0.25, -0.125};
  EXPECT_FALSE(inside.proves(Outcome::overlap, c));
  // Vertex on vertex: named from afar, and proven.
  const Proven touching(test_box(2, 2, 2).body, test_box(2, 2, 2).body, shifted(2, 2, 2));
  for (const double far : {0.25, 1.0, 1e3, 1e10}) {
    c.witnesses[0].point_a = {far, far, far};
    c.witnesses[0].point_b = {-far, -far, -far};
    EXPECT_TRUE(touching.proves(Outcome::overlap, c)) << far;
    c.witnesses[0].point_b = {-far, far, -far};
    EXPECT_FALSE(touching.proves(Outcome::overlap, c)) << far;
  }
  // Outside of both bodies and equal: proves nothing of bodies that are apart.
  const Proven apart(test_box(2, 2, 2).body, test_box(2, 2, 2).body, shifted(5, 0, 0));
  c.witnesses[0].point_a = {2.5, 0, 0};
  c.witnesses[0].point_b = {-2.5, 0, 0};
  EXPECT_FALSE(apart.proves(Outcome::overlap, c));
}

TEST(Certificate, OfWhatTouchesHoldsToTheLastBit) {
  struct Touch {
    ConvexBody a, b;
    Vec3d at, apart;
  };
  const ConvexBody cube = test_box(2, 2, 2).body, plate = Plate(2, 2), needle = Needle(2);
  const ConvexBody across = Polytope(std::vector<Vec3d>{{-1, 0, 0}, {1, 0, 0}}, {}, 0.0);
  for (const Touch& touch : std::vector<Touch>{{cube, cube, {2, 0.5, 0.25}, {1, 0, 0}},
                                               {cube, cube, {2, 2, 2}, {0, 1, 0}},
                                               {cube, cube, {2, 2, 0.5}, {1, 0, 0}},
                                               {plate, plate, {2, 0.5, 0}, {1, 0, 0}},
                                               {plate, plate, {0.5, 0.5, 0}, {0, 0, 1}},
                                               {needle, across, {0.5, 0, 0.25}, {0, 1, 0}},
                                               {needle, needle, {0, 0, 2}, {0, 0, 1}},
                                               {needle, needle, {0, 0, 1}, {0, 1, 0}},
                                               {plate, needle, {0.5, 0.25, 1}, {0, 0, 1}},
                                               {Sphere(5), Sphere(8), {3, 4, 12}, {0, 1, 0}},
                                               {Sphere(5), cube, {4, 5, 0.5}, {1, 0, 0}}}) {
    const Proven touching(touch.a, touch.b, shifted(touch.at.x, touch.at.y, touch.at.z));
    ASSERT_EQ(touching.verdict.outcome, Outcome::overlap);
    EXPECT_TRUE(touching.proves(touching.certificate));
    EXPECT_FALSE(touching.proves(Outcome::disjoint, touching.certificate));
    // The placed vertices at 2 - 1 = 1 have the ulp of 1: moved by 2^-51 every pair here is apart.
    const Vec3d moved = touch.at + 0x1p-50 * touch.apart;
    const Proven apart(touch.a, touch.b, shifted(moved.x, moved.y, moved.z));
    ASSERT_EQ(apart.verdict.outcome, Outcome::disjoint);
    EXPECT_TRUE(apart.proves(apart.certificate));
    EXPECT_FALSE(apart.proves(Outcome::overlap, touching.certificate));
    EXPECT_FALSE(touching.proves(Outcome::disjoint, apart.certificate));
  }
}

TEST(Certificate, OfABodyWithoutExactFormProvesNothing) {
  struct Nameless {
    Sphere ball{1.0};
    Vec3d centre() const { return {}; }
    double circumradius() const { return 1.0; }
    double inradius() const { return 1.0; }
    double support_error() const { return ball.support_error(); }
    Vec3d support(const Vec3d& dir) const { return ball.support(dir); }
  };
  const ConvexBody nameless = Nameless{};
  OverlapCertificate certificate;
  const Verdict verdict = overlap(nameless, Sphere(1.0), shifted(3, 0, 0), &certificate);
  ASSERT_EQ(verdict.outcome, Outcome::disjoint);
  const CertificateCheck check =
      check_certificate(nameless, Sphere(1.0), shifted(3, 0, 0), Outcome::disjoint, certificate);
  EXPECT_FALSE(check.is_proven);
  EXPECT_EQ(check.fault, "a body has no exact form");
}

}  // namespace
}  // namespace vex
