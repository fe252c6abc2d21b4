// Distances and depths in closed form, and what the query promises beside the numbers. What is held against referees is
// in tests/property/separation_laws_test.cpp.
#include "engine/query/separation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "engine/query/separation_certificate.h"
#include "engine/support/combinators.h"
#include "shapes/any_shape.h"
#include "shapes/polytope.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

ConvexBody body(const char* text) { return parse_shape(text).body; }
Transformd at(double x, double y, double z) { return {.translation = {x, y, z}}; }

Transformd about_z(double angle_rad, const Vec3d& translation) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}, translation};
}

void expect(const Separation& found, double expected, double error) {
  EXPECT_NEAR(found.signed_distance, expected, error);
  EXPECT_LE(found.lower, expected + 1e-16);
  EXPECT_GE(found.upper, expected - 1e-16);
  EXPECT_LE(found.lower, found.signed_distance);
  EXPECT_GE(found.upper, found.signed_distance);
  EXPECT_LE(found.upper - found.lower, std::fmax(4.0 * error, 1e-12));
  EXPECT_EQ(found.verdict.outcome, expected > 0.0 ? Outcome::disjoint : Outcome::overlap);
  ASSERT_TRUE(found.has_witnesses);
  EXPECT_NEAR(norm(found.normal), 1.0, 1e-15);
  EXPECT_LE(norm((found.point_b - found.point_a) - found.signed_distance * found.normal),
            std::fmax(2.0 * error, 1e-12));
}

TEST(Separation, OfBalls) {
  expect(signed_distance(body("sphere:1"), body("sphere:0.5"), at(3, 4, 0)), 3.5, 1e-15);
  expect(signed_distance(body("sphere:1"), body("sphere:0.5"), at(0.6, 0.8, 0)), -0.5, 1e-15);
  expect(signed_distance(body("sphere:1"), body("sphere:0.5"), at(0, 0, 0)), -1.5, 1e-15);
  expect(signed_distance(body("sphere:1"), body("sphere:1"), at(2, 0, 0)), 0.0, 1e-15);
}

TEST(Separation, OfCapsules) {
  expect(signed_distance(body("capsule:2,0.25"), body("capsule:2,0.5"), at(3, 4, 1)), 4.25, 1e-15);
  expect(signed_distance(body("capsule:2,0.25"), body("capsule:2,0.5"), at(0, 0, 1)), -0.75, 1e-15);  // one axis
  const Transformd crossed{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.0, 0.5}};
  expect(signed_distance(body("capsule:2,0.25"), body("capsule:2,0.5"), crossed), -0.75, 1e-15);
}

TEST(Separation, OfParallelBoxes) {
  const ConvexBody box = body("box:1,2,3");
  expect(signed_distance(box, box, at(0, 0, 5)), 2.0, 1e-15);
  expect(signed_distance(box, box, at(0.5, 1.5, 0.1)), -0.5, 1e-15);
  expect(signed_distance(box, box, at(4, 6, 0)), 5.0, 1e-14);
  expect(signed_distance(box, box, at(3, -5, 9)), 7.0, 1e-14);
  expect(signed_distance(box, box, at(1, 2, 3)), 0.0, 1e-15);
  expect(signed_distance(box, box, at(1, 0, 0)), 0.0, 1e-15);
  expect(signed_distance(box, box, at(0, 0, 0)), -1.0, 1e-15);
  expect(signed_distance(body("box:4,4,4"), body("box:0.5,0.5,0.5"), at(1, 0, 0)), -1.25, 1e-15);
}

// libccd issue 25: NaN as the depth of cubes 1.9 apart along an axis.
TEST(Separation, OfCubesThatStartSymmetrically) {
  const ConvexBody cube = body("box:2,2,2");
  for (const Vec3d& t : {Vec3d{1.9, 0, 0}, Vec3d{0, 1.9, 0}, Vec3d{0, 0, 1.9}, Vec3d{0, 0, -1.9}}) {
    const Separation found = signed_distance(cube, cube, Transformd{.translation = t});
    expect(found, -0.1, 1e-15);
    EXPECT_NEAR(dot(found.normal, t), 1.9, 1e-14);
  }
}

TEST(Separation, OfCubesAsPolytopesIsThatOfBoxes) {
  std::vector<Vec3d> vertices;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      for (const double z : {-0.5, 0.5}) vertices.push_back({x, y, z});
    }
  }
  const ConvexBody cube = Polytope(vertices, {}, 0.5), box = body("box:1,1,1");
  ASSERT_FALSE(cube.generators());
  std::mt19937_64 random(5);
  const Domain domain = ball_domain(box, box);
  int n_deep = 0;
  for (int k = 0; k < 2000; ++k) {
    Transformd pose = random_pose(random, domain, box);
    if (k % 4 == 0) pose = about_z(0.25 * std::numbers::pi * (k % 16), pose.translation);
    if (k % 8 == 0) pose = {.translation = {pose.translation.x, 0.0, 0.0}};
    const Separation one = signed_distance(cube, cube, pose), other = signed_distance(box, box, pose);
    ASSERT_NEAR(one.signed_distance, other.signed_distance, 1e-14) << k;
    ASSERT_EQ(one.verdict.outcome, other.verdict.outcome);
    ASSERT_LE(one.upper - one.lower, 1e-12) << k;
    n_deep += one.signed_distance < -0.1 ? 1 : 0;
  }
  EXPECT_GT(n_deep, 300);
}

TEST(Separation, OfEllipsoidsThatAreBallsIsThatOfBalls) {
  expect(signed_distance(body("ellipsoid:1,1,1"), body("ellipsoid:0.5,0.5,0.5"), at(0.6, 0, 0.8)), -0.5, 1e-9);
  expect(signed_distance(body("ellipsoid:1,1,1"), body("ellipsoid:0.5,0.5,0.5"), at(0, 0, 3)), 1.5, 1e-9);
}

TEST(Separation, OfEllipsoidsAlongTheirAxes) {
  for (const char* flat : {"ellipsoid:1,1,0.001", "ellipsoid:1,1,0.000001"}) {
    const ConvexBody a = body(flat);
    const double half = a.inradius();
    expect(signed_distance(a, a, at(0, 0, 1)), 1.0 - 2.0 * half, 1e-9);
    expect(signed_distance(a, a, at(3, 0, 0)), 1.0, 1e-9);
    expect(signed_distance(a, a, at(0, 0, half)), -half, 1e-9);
  }
  expect(signed_distance(body("ellipsoid:1,2,3"), body("ellipsoid:0.000001,0.000001,0.000001"), at(0, 0, 4)),
         1.0 - 1e-6, 1e-9);
}

TEST(Separation, OfFlatBodiesThatMeetIsZero) {
  expect(signed_distance(body("plate:1,1"), body("plate:1,1"), at(0.25, 0.25, 0)), 0.0, 1e-15);
  const Separation discs = signed_distance(body("disc:1"), body("disc:1"), at(0.25, 0.25, 0));
  EXPECT_EQ(discs.verdict.outcome, Outcome::undecided);
  EXPECT_NEAR(discs.upper, 0.0, 1e-15);
  EXPECT_NEAR(discs.lower, 0.0, 1e-15);
  expect(signed_distance(body("needle:2"), body("needle:2"), at(0, 0, 0.5)), 0.0, 1e-15);
  expect(signed_distance(body("needle:2"), body("plate:1,1"), at(0, 0, 0.75)), -0.25, 1e-15);
}

TEST(Separation, TellsNoDepthToWhoAsksForTheDistanceNorTheOtherWayRound) {
  for (const char* name : {"box:1,1,1", "cylinder:1,0.5", "sphere:0.5", "dodecahedron:0.5"}) {
    const ConvexBody one = body(name);
    const Separation deep = distance(one, one, at(0.25, 0, 0)), apart = penetration_depth(one, one, at(5, 0, 0));
    EXPECT_EQ(deep.verdict.outcome, Outcome::overlap);
    EXPECT_FALSE(deep.has_witnesses);
    EXPECT_EQ(deep.signed_distance, 0.0);
    EXPECT_EQ(deep.lower, -kInfinity);
    EXPECT_EQ(deep.upper, 0.0);
    EXPECT_EQ(apart.verdict.outcome, Outcome::disjoint);
    EXPECT_FALSE(apart.has_witnesses);
    EXPECT_EQ(apart.lower, 0.0);
    EXPECT_EQ(apart.upper, kInfinity);
    EXPECT_NEAR(distance(one, one, at(5, 0, 0)).signed_distance, 5.0 - 2.0 * -one.support({-1, 0, 0}).x, 1e-9);
    EXPECT_LT(penetration_depth(one, one, at(0.25, 0, 0)).signed_distance, -0.2);
  }
}

TEST(Separation, KeepsItsBoundsWhereLessIsAskedFor) {
  std::mt19937_64 random(6);
  const ConvexBody a = body("cylinder:1,0.5"), b = body("ellipsoid:0.3,0.6,0.9");
  const Domain domain = ball_domain(a, b);
  double n_calls = 0.0, n_calls_rough = 0.0;
  for (int k = 0; k < 500; ++k) {
    const Transformd pose = random_pose(random, domain, b);
    const Separation near = signed_distance(a, b, pose), rough = signed_distance(a, b, pose, {.relative_gap = 1e-2});
    ASSERT_LE(rough.lower, near.upper);
    ASSERT_GE(rough.upper, near.lower);
    ASSERT_LE(rough.upper - rough.lower, 1.01e-2 * (std::fabs(near.signed_distance) + 2.0)) << k;
    ASSERT_EQ(rough.verdict.outcome, near.verdict.outcome);
    n_calls += near.n_support_calls;
    n_calls_rough += rough.n_support_calls;
  }
  EXPECT_LT(n_calls_rough, 0.6 * n_calls);
}

// What a depth's normal shows its search has asked already. Two more support calls were made to know it.
TEST(Separation, DepthsOfFewDigitsShowThemAlongTheirNormalsAndAskNoMore) {
  std::mt19937_64 random(16);
  for (const char* name : {"dodecahedron:0.5", "cylinder:1,0.5", "ellipsoid:0.3,0.6,0.9", "capsule:1,0.5"}) {
    const ConvexBody a = body(name), b = body("icosahedron:1");
    const Domain domain = ball_domain(a, b);
    for (const double gap : {1e-6, 1e-3, 1e-1}) {
      int n_calls = 0, n_coarse_calls = 0, n_deep = 0, n_rough = 0;
      WarmStart warm;
      for (int k = 0; k < 200; ++k) {
        const Pose pose = Pose::unchecked(random_pose(random, domain, b));
        const Separation all = penetration_depth(a, b, pose);
        if (all.verdict.outcome != Outcome::overlap) continue;
        for (WarmStart* const memory : {static_cast<WarmStart*>(nullptr), &warm}) {
          const Separation coarse = penetration_depth(a, b, pose, {.relative_gap = gap}, memory);
          n_coarse_calls += memory == nullptr ? coarse.n_support_calls : 0;
          n_rough += memory == nullptr && coarse.is_rough ? 1 : 0;
          if (coarse.is_rough) continue;
          const Vec3d of_a = a.support(coarse.normal);
          const Vec3d of_b = pose.a_from_b()(b.support(pose.a_from_b().direction_to_b(-coarse.normal)));
          ASSERT_GE(dot(coarse.normal, of_b - of_a), coarse.signed_distance - promised_accuracy(a, b, coarse));
        }
        n_calls += all.n_support_calls;
        ++n_deep;
      }
      EXPECT_GT(n_deep, 20) << name;
      EXPECT_LT(4 * n_rough, n_deep) << name << ' ' << gap;
      EXPECT_LE(n_coarse_calls, n_calls) << name << ' ' << gap;
    }
  }
}

// An earlier direction may show a larger distance than the answer's own: then the bound is the one that the normal
// shows, unless the better one alone tells the sign.
TEST(Separation, FewDigitsAreRoughOnlyNextToContact) {
  std::mt19937_64 random(17);
  for (const char* name : {"ellipsoid:1,2,3", "cylinder:1,0.5", "cone:1,0.5", "superball:2,1", "icosahedron:1"}) {
    const ConvexBody a = body(name), b = body("ellipsoid:0.5,1,1.5");
    const Domain domain = ball_domain(a, b);
    for (const double gap : {1e-6, 1e-3}) {
      for (int k = 0; k < 500; ++k) {
        const Pose pose = Pose::unchecked(random_pose(random, domain, b));
        const Separation found = signed_distance(a, b, pose, {.relative_gap = gap});
        const double part = gap * (std::fabs(found.signed_distance) + a.circumradius() + b.circumradius());
        ASSERT_LE(found.upper - found.lower, part);
        if (found.is_rough) {
          ASSERT_LE(std::fabs(found.signed_distance), 2.0 * part) << name << ' ' << gap;
          continue;
        }
        if (!a.exact_form() || k % 10 != 0) continue;
        const CertificateCheck check = check_certificate(a, b, pose, found, certify(a, b, pose, found));
        ASSERT_TRUE(check.is_proven) << check.fault << ' ' << name << ' ' << gap;
      }
    }
  }
}

TEST(Separation, IsTheSameFromAWarmStartAndNeedsFewerCalls) {
  std::mt19937_64 random(7);
  for (const char* name : {"box:1,1,1", "dodecahedron:0.5", "cylinder:1,0.5", "ellipsoid:0.3,0.6,0.9"}) {
    const ConvexBody one = body(name);
    int n_calls = 0, n_warm_calls = 0;
    WarmStart warm;
    const Transformd turn = random_rotation(random);
    for (int k = 0; k < 400; ++k) {
      Transformd pose = turn;
      pose.translation = {0.4, 0.2, 2.5 - 0.005 * k};
      const Separation cold = signed_distance(one, one, pose), found = signed_distance(one, one, pose, {}, &warm);
      ASSERT_LE(found.lower, cold.upper) << name << " " << k;
      ASSERT_GE(found.upper, cold.lower) << name << " " << k;
      ASSERT_EQ(found.verdict.outcome, cold.verdict.outcome);
      if (cold.verdict.outcome != Outcome::disjoint) continue;
      n_calls += cold.n_support_calls;
      n_warm_calls += found.n_support_calls;
    }
    EXPECT_LT(n_warm_calls, 0.9 * n_calls) << name;
  }
}

TEST(Separation, TakesAnyWarmStart) {
  const ConvexBody one = body("box:1,1,1"), other = body("dodecahedron:0.5"), small = body("tetrahedron:0.1");
  WarmStart of_others;
  signed_distance(other, other, at(0, 0, 3), {}, &of_others);
  expect(signed_distance(small, small, at(0, 0, 1), {}, &of_others),
         signed_distance(small, small, at(0, 0, 1)).signed_distance, 1e-15);
  WarmStart warm;
  signed_distance(one, one, at(0, 0, 3), {}, &warm);
  for (const Transformd& pose : {at(0, 0, -3), at(3, 0, 0), at(0.1, 0, 0), at(1, 1, 1)}) {
    const Separation found = signed_distance(one, other, pose, {}, &warm), cold = signed_distance(one, other, pose);
    EXPECT_NEAR(found.signed_distance, cold.signed_distance, 1e-14);
  }
}

TEST(Separation, OfBodiesOfAnySizeAnywhere) {
  for (const int exponent : {-900, -300, -60, 60, 300, 900}) {
    const double unit = std::ldexp(1.0, exponent);
    std::vector<Vec3d> vertices;
    for (const double x : {-unit, unit}) {
      for (const double y : {-unit, unit}) {
        for (const double z : {-unit, unit}) vertices.push_back({x, y, z});
      }
    }
    const ConvexBody cube = Polytope(vertices, {}, unit);
    const Separation apart = signed_distance(cube, cube, at(0, 3.0 * unit, 0));
    EXPECT_NEAR(std::ldexp(apart.signed_distance, -exponent), 1.0, 1e-12) << exponent;
    EXPECT_EQ(apart.verdict.outcome, Outcome::disjoint);
    const Separation deep = signed_distance(cube, cube, at(0, 1.5 * unit, 0));
    EXPECT_NEAR(std::ldexp(deep.signed_distance, -exponent), -0.5, 1e-12) << exponent;
    EXPECT_NEAR(deep.normal.y, 1.0, 1e-12);
  }
}

TEST(Separation, KeepsItsDigitsFarFromTheOrigin) {
  const double far = 0x1p30;
  std::vector<Vec3d> vertices;
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      for (const double z : {0.0, 1.0}) vertices.push_back({far + x, far + y, far + z});
    }
  }
  const ConvexBody cube = Polytope(vertices, vertices.front(), 0.0);
  const Separation found = signed_distance(cube, cube, at(0, 0, 1.0 + 0x1p-12));
  EXPECT_NEAR(found.signed_distance, 0x1p-12, 1e-15);
  EXPECT_LE(found.upper - found.lower, 1e-12);
  EXPECT_EQ(found.verdict.by, DecidedBy::double_double);
}

// A body that tells no more than a body has to.
struct Lens {
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return ball_support(L(1.0), dir);
  }
  double support_error() const { return 8.0 * kUnitRoundoff; }
  Vec3d centre() const { return {}; }
  double circumradius() const { return 1.0; }
  double inradius() const { return 1.0; }
};

TEST(Separation, OfABodyWithoutExactFormIsUndecidedWhereItTouchesAndBounded) {
  const ConvexBody lens = Lens{};
  const Separation apart = signed_distance(lens, lens, at(0, 0, 3));
  EXPECT_EQ(apart.verdict.outcome, Outcome::disjoint);
  EXPECT_NEAR(apart.signed_distance, 1.0, 1e-9);
  const Separation touching = signed_distance(lens, lens, at(0, 0, 2));
  EXPECT_EQ(touching.verdict.outcome, Outcome::undecided);
  EXPECT_LE(touching.lower, 0.0);
  EXPECT_GE(touching.upper, 0.0);
  EXPECT_LE(touching.upper - touching.lower, 1e-9);
}

TEST(Separation, SaysHowFarItGotWhenItMayAskNoMore) {
  const Separation found = signed_distance(body("ellipsoid:1,2,3"), body("ellipsoid:3,1,1"), at(4.5, 1, 1),
                                           {.relative_gap = 0.0, .max_support_calls = 4});
  EXPECT_LE(found.lower, found.upper);
  const Separation known = signed_distance(body("ellipsoid:1,2,3"), body("ellipsoid:3,1,1"), at(4.5, 1, 1));
  EXPECT_LE(found.lower, known.upper);
  EXPECT_GE(found.upper, known.lower);
  EXPECT_GT(found.upper - found.lower, 1e-9);
}

// Found by review: points and normal that did not go with the value.
double mismatch(const Separation& found) {
  return norm((found.point_b - found.point_a) - found.signed_distance * found.normal);
}

TEST(Separation, OfNearlyParallelBoxesHasPointsThatGoWithIt) {
  std::mt19937_64 random(12);
  for (const auto& [name_a, name_b] :
       {std::pair{"box:1,2,3", "box:1,2,3"}, {"box:1,1,1", "plate:1,1"}, {"rounded:0.1,box:1,1,1", "box:1,1,1"}}) {
    const ConvexBody a = body(name_a), b = body(name_b);
    for (int k = 0; k < 400; ++k) {
      const double tilt = std::ldexp(1.0, -10 - k % 44);
      const Vec3d d = tilt * random_direction(random);
      const Vec3d t = k % 3 == 0 ? Vec3d{} : k % 3 == 1 ? Vec3d{0.99, 0.1, 0.2} : Vec3d{0.25, 0.999999, 0.0};
      const Transformd pose{{1.0, -d.z, d.y}, {d.z, 1.0, -d.x}, {-d.y, d.x, 1.0}, t};
      if (tilt > 1e-7) continue;  // or it would be no rotation
      const Separation found = signed_distance(a, b, pose);
      ASSERT_LE(mismatch(found), 1e-12 * 4.0) << name_a << " " << name_b << " tilt " << tilt << " case " << k;
      ASSERT_LE(found.upper - found.lower, 1e-12 * 4.0);
    }
  }
}

TEST(Separation, OfFlushTetrahedraIsAlongTheirFaces) {
  const ConvexBody a = body("tetrahedron:1");
  const Transformd pose{{-0x1.ffffffffffffep-1, 0x1p-54, -0x1.8p-53},
                        {-0x1.8p-53, -0x1.8p-55, -0x1.fffffffffffffp-1},
                        {0x1p-54, -0x1.fffffffffffffp-1, -0x1.8p-55},
                        {0.0, 0x1.6a09e68f24d8fp-1, 0.0}};
  const Separation found = signed_distance(a, a, pose);
  EXPECT_NEAR(found.signed_distance, 4.56e-9, 1e-11);
  EXPECT_NEAR(found.normal.y, 1.0, 1e-12);
  EXPECT_LE(mismatch(found), 1e-12);
}

TEST(Separation, OfAPointOnALineHasThePointsOfContact) {
  const std::vector<Vec3d> point = {{0.1, 0.2, 0.3}}, line = {{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0.5, 0, 0}};
  const ConvexBody a = Polytope(point, point[0], 0.0), b = Polytope(line, {}, 0.0);
  const Transformd pose{{-0x1.1e1acd685c9e6p-1, 0x1.9c1e7ff7574dep-1, 0x1.98d231d16841bp-3},
                        {0x1.3f92ec92e5b64p-1, 0x1.22263ac21e7b2p-1, -0x1.135f4b4db35c7p-1},
                        {-0x1.17927b30220b1p-1, -0x1.68564ea3b055bp-3, -0x1.a35dcf0442ab4p-1},
                        {0x1.5bda3380fb1cp-3, 0x1.f3a046a04d7dp-4, 0x1.7917d1ff3bb5fp-2}};
  const Separation found = signed_distance(a, b, pose);
  EXPECT_LE(mismatch(found), 1e-15);
  EXPECT_LE(norm(found.point_b - point[0]), 1e-15);
}

TEST(Separation, OfThinBodiesWithOneCentreHasPointsThatGoWithIt) {
  const Transformd pose{{0x1.43ba527c9b4ep-1, 0x1.c294b357a9a3p-2, 0x1.467a9df47a294p-1},
                        {-0x1.0002a4f185c88p-6, 0x1.a9071138705dbp-1, -0x1.1d5cb2a244a92p-1},
                        {-0x1.8c95f6a62a4dap-1, 0x1.5ea7b6c4fb895p-2, 0x1.1041d41d91a1dp-1},
                        {0.0, 0.0, 0.0}};
  EXPECT_LE(mismatch(signed_distance(body("needle:1e-6"), body("rounded:1e-3,needle:1"), pose)), 1e-12);
  EXPECT_LE(mismatch(signed_distance(body("sphere:1e-9"), body("box:1,1e-9,1e-9"), pose)), 1e-12);
}

TEST(Separation, OfPolytopesOfManyVerticesGoesOnToTheEnd) {
  std::vector<Vec3d> prism, ball;
  for (int k = 0; k < 500; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 500.0;
    for (const double z : {-0.5, 0.5}) prism.push_back({std::cos(angle), std::sin(angle), z});
  }
  std::mt19937_64 random(13);
  for (int k = 0; k < 4000; ++k) {
    const Vec3d d = random_direction(random);
    ball.push_back((1.0 / norm(d)) * d);
  }
  const std::vector<Vec3d> point = {{0.0, 0.0, 0.0}};
  const ConvexBody at_one_point = Polytope(point, {}, 0.0);
  for (const std::vector<Vec3d>& vertices : {prism, ball}) {
    const ConvexBody a = Polytope(vertices, {}, 0.4);
    for (const Vec3d& t : {Vec3d{0.0, 0.0, 0.0}, Vec3d{0.01, 0.02, 0.0}}) {
      const Separation found = signed_distance(a, at_one_point, Transformd{.translation = t});
      EXPECT_LE(found.upper - found.lower, 1e-12);
      EXPECT_LE(mismatch(found), 1e-12);
    }
  }
}

TEST(Separation, HasPointsThatGoWithItHoweverFewItMayAsk) {
  std::mt19937_64 random(14);
  const ConvexBody a = body("disc:1"), b = body("ellipsoid:0.2,0.3,1");
  const Domain domain = ball_domain(a, b);
  for (int k = 0; k < 500; ++k) {
    const Transformd pose = random_pose(random, domain, b);
    for (const int most : {1, 2, 3, 5, 8}) {
      const Separation found = signed_distance(a, b, pose, {.relative_gap = 0.0, .max_support_calls = most});
      const Separation known = signed_distance(a, b, pose);
      ASSERT_TRUE(found.has_witnesses);
      ASSERT_LE(found.lower, known.upper);
      ASSERT_GE(found.upper, known.lower);
      if (found.signed_distance > 1e-6) {
        ASSERT_LE(mismatch(found), 1e-9);
      }
    }
  }
}

TEST(Margin, AsksWhetherTheGapIsAtMostSoMuch) {
  const ConvexBody box = body("box:1,1,1"), ball = body("sphere:0.5");
  EXPECT_EQ(overlap(with_margin(box, 0.25), ball, at(1.25, 0, 0)).outcome, Outcome::overlap);
  EXPECT_EQ(overlap(with_margin(box, 0.25), ball, at(std::nextafter(1.25, 2.0), 0, 0)).outcome, Outcome::disjoint);
  EXPECT_EQ(overlap(with_margin(box, 0.0), ball, at(1.0, 0, 0)).outcome, Outcome::overlap);
  std::mt19937_64 random(8);
  const ConvexBody a = body("cylinder:1,0.5"), b = body("tetrahedron:1"), wide = with_margin(a, 0.1);
  const Domain domain = ball_domain(wide, b);
  int n_near = 0;
  for (int k = 0; k < 1000; ++k) {
    const Transformd pose = random_pose(random, domain, b);
    const Separation found = signed_distance(a, b, pose);
    const Outcome outcome = overlap(wide, b, pose).outcome;
    if (found.lower > 0.1) {
      ASSERT_EQ(outcome, Outcome::disjoint);
    }
    if (found.upper < 0.1) {
      ASSERT_EQ(outcome, Outcome::overlap);
    }
    n_near += found.upper < 0.1 && found.lower > 0.0 ? 1 : 0;
  }
  EXPECT_GT(n_near, 30);
}

}  // namespace
}  // namespace vex
