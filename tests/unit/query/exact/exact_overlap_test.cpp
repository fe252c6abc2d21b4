#include "engine/query/exact/exact_overlap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/query/overlap.h"
#include "shapes/capsule.h"
#include "shapes/needle.h"
#include "shapes/plate.h"
#include "shapes/rounded.h"
#include "shapes/sphere.h"
#include "tests/referees/exact_truth.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

Transformd shifted_by(double x, double y, double z) { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {x, y, z}}; }

ConvexBody hull(const std::vector<Vec3d>& points) { return Polytope(points, points.front(), 0.0); }

template <class Body>
ConvexBody inflated(Body body, double radius) {
  return Inflated<Body>(std::move(body), radius);
}

std::string hex(const Transformd& pose) {
  std::string text;
  for (const Vec3d& v : {pose.row_x, pose.row_y, pose.row_z, pose.translation}) {
    for (const double x : {v.x, v.y, v.z}) {
      char one[40];
      std::snprintf(one, sizeof one, "%a ", x);
      text += one;
    }
  }
  return text;
}

// The stage itself, the whole query and its certificate, all against the truth.
void expect_truth(const ConvexBody& a, const ConvexBody& b, const Transformd& pose, Outcome truth) {
  const std::optional<PlacedForms> forms = placed_forms(a, b, pose);
  ASSERT_TRUE(forms.has_value());
  ASSERT_EQ(exact_overlap(*forms).overlap, truth == Outcome::overlap) << hex(pose);
  OverlapCertificate certificate;
  ASSERT_EQ(overlap(a, b, pose, &certificate).outcome, truth) << hex(pose);
  const CertificateCheck check = check_certificate(a, b, pose, truth, certificate);
  ASSERT_TRUE(check.is_proven) << check.fault << " at " << hex(pose);
}
void expect_truth(const ConvexBody& a, const ConvexBody& b, const Transformd& pose) {
  expect_truth(a, b, pose, true_outcome(a, b, pose).value());
}

// Small whole coordinates: half of all placements touch, and most are degenerate in some way.
std::vector<Vec3d> lattice_points(std::mt19937_64& random, std::size_t n, int span) {
  const auto coordinate = [&] {
    return static_cast<double>(random() % (2u * static_cast<unsigned>(span) + 1u)) - span;
  };
  std::vector<Vec3d> points;
  for (std::size_t k = 0; k < n; ++k) points.push_back({coordinate(), coordinate(), coordinate()});
  switch (random() % 6) {
    case 0:  // coplanar
      for (Vec3d& p : points) p.z = p.x - p.y;
      break;
    case 1:  // collinear
      for (Vec3d& p : points) p = {p.x, 2.0 * p.x, -p.x};
      break;
    case 2: points.push_back(points.front()); break;  // twice the same
    default: break;
  }
  return points;
}

Transformd lattice_pose(std::mt19937_64& random, int span) {
  constexpr Vec3d kAxes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::size_t first = random() % 3, second = (first + 1 + random() % 2) % 3;
  const auto sign = [&] { return (random() & 1) != 0 ? 1.0 : -1.0; };
  const Vec3d row_x = sign() * kAxes[first], row_y = sign() * kAxes[second];
  Transformd pose{row_x, row_y, cross(row_x, row_y), {}};
  const auto coordinate = [&] {
    return static_cast<double>(random() % (2u * static_cast<unsigned>(span) + 1u)) - span;
  };
  pose.translation = {coordinate(), coordinate(), coordinate()};
  return pose;
}

TEST(ExactOverlap, OfLatticeHullsIsWhatRationalsSay) {
  std::mt19937_64 random(1);
  int n_overlap = 0, n_touching = 0;
  constexpr int kCases = 2500;
  for (int k = 0; k < kCases; ++k) {
    const ConvexBody a = hull(lattice_points(random, 1 + random() % 8, 2));
    const ConvexBody b = hull(lattice_points(random, 1 + random() % 8, 2));
    const Transformd pose = lattice_pose(random, 3);
    const Outcome truth = true_outcome(a, b, pose).value();
    ASSERT_NO_FATAL_FAILURE(expect_truth(a, b, pose, truth));
    if (truth == Outcome::disjoint) continue;
    ++n_overlap;
    // Whether they only touch: moved apart by an ulp along some axis they are disjoint.
    for (const Vec3d& dir : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, Vec3d{-1, 0, 0}, Vec3d{0, -1, 0}}) {
      Transformd moved = pose;
      moved.translation = moved.translation + 0x1p-48 * dir;
      const Outcome after = true_outcome(a, b, moved).value();
      ASSERT_NO_FATAL_FAILURE(expect_truth(a, b, moved, after));
      if (after == Outcome::disjoint) {
        ++n_touching;
        break;
      }
    }
  }
  EXPECT_GT(n_overlap, kCases / 10);
  EXPECT_GT(n_touching, kCases / 40) << "the sample must hold bodies that only touch";
}

TEST(ExactOverlap, OfLatticeHullsUnderBallsIsWhatRationalsSay) {
  // Squared distances of lattice points are whole: with radii that add up to 3 or 5 many placements touch exactly.
  std::mt19937_64 random(2);
  int n_overlap = 0, n_touching = 0;
  constexpr int kCases = 1500;
  for (int k = 0; k < kCases; ++k) {
    const double radii = (random() & 1) != 0 ? 3.0 : 5.0;
    const double radius_a = 0.25 * static_cast<double>(random() % 5);
    const std::vector<Vec3d> v = lattice_points(random, 1 + random() % 4, 2),
                             w = lattice_points(random, 1 + random() % 4, 2);
    const ConvexBody a = inflated(Polytope(v, v.front(), 0.0), radius_a);
    const ConvexBody b = inflated(Polytope(w, w.front(), 0.0), radii - radius_a);
    const Transformd pose = lattice_pose(random, 6);
    const Outcome truth = true_outcome(a, b, pose).value();
    ASSERT_NO_FATAL_FAILURE(expect_truth(a, b, pose, truth));
    if (truth == Outcome::disjoint) continue;
    ++n_overlap;
    const ConvexBody smaller = inflated(Polytope(w, w.front(), 0.0), std::nextafter(radii - radius_a, 0.0));
    const Outcome after = true_outcome(a, smaller, pose).value();
    ASSERT_NO_FATAL_FAILURE(expect_truth(a, smaller, pose, after));
    n_touching += after == Outcome::disjoint ? 1 : 0;
  }
  EXPECT_GT(n_overlap, kCases / 10);
  EXPECT_GT(n_touching, kCases / 100) << "the sample must hold bodies that only touch";
}

TEST(ExactOverlap, OfTurnedBodiesNearContactIsWhatRationalsSay) {
  std::mt19937_64 random(3);
  const std::vector<ConvexBody> bodies = {
      test_box(1, 1, 1).body,      test_box(1e-6, 1, 1).body,  Plate(1.0, 0.5), Needle(2.0),
      hull({{0.1, 0.2, 0.3}}),     test_tetrahedron(0.7).body, Sphere(0.4),     Capsule(1.0, 0.25),
      inflated(Plate(1, 1), 0.125)};
  int n_overlap = 0, n_disjoint = 0;
  for (const ConvexBody& a : bodies) {
    for (const ConvexBody& b : bodies) {
      Transformd pose = random_rotation(random);
      const Vec3d dir = random_direction(random);
      const double contact = contact_along(a, b, pose, dir);
      for (const double factor : {0.5, 1.0 - 1e-9, 1.0 - 0x1p-52, 1.0, 1.0 + 0x1p-52, 1.0 + 1e-9}) {
        pose.translation = (contact * factor) * dir;
        const Outcome truth = true_outcome(a, b, pose).value();
        (truth == Outcome::overlap ? n_overlap : n_disjoint) += 1;
        ASSERT_NO_FATAL_FAILURE(expect_truth(a, b, pose, truth));
      }
    }
  }
  EXPECT_GT(n_overlap, 100);
  EXPECT_GT(n_disjoint, 100);
}

TEST(ExactOverlap, OfWhatTouchesIsOverlapAndOneUlpApartIsNot) {
  const ConvexBody cube = test_box(2, 2, 2).body;
  const ConvexBody diamond = hull({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
  const ConvexBody point = hull({{0, 0, 0}}), plate = Plate(2, 2), needle = Needle(2);
  const ConvexBody across = hull({{-1, 0, 0}, {1, 0, 0}});
  struct Touch {
    const char* name;
    ConvexBody a, b;
    Vec3d at, apart;  // moved along `apart` they are disjoint
  };
  const std::vector<Touch> touches = {
      {"vertex on vertex", cube, cube, {2, 2, 2}, {1, 0, 0}},
      {"vertex on edge", cube, diamond, {2, 1, 0.25}, {1, 0, 0}},
      {"vertex on face", cube, diamond, {0.25, -0.5, 2}, {0, 0, 1}},
      {"edge along edge", cube, cube, {2, -2, 0.5}, {0, -1, 0}},
      {"edge across edge", needle, across, {0.5, 0, 0.25}, {0, 1, 0}},
      {"face on face", cube, cube, {0.5, 2, -0.25}, {0, 1, 0}},
      {"point on vertex", cube, point, {1, -1, 1}, {0, 0, 1}},
      {"point on face", cube, point, {1, 0.25, 0.125}, {1, 0, 0}},
      {"point on point", point, point, {0, 0, 0}, {1, 0, 0}},
      {"needle along needle", needle, needle, {0, 0, 2}, {0, 0, 1}},
      {"needle on needle", needle, needle, {0, 0, 0.5}, {1, 0, 0}},
      {"plate in the plane of a plate", plate, plate, {2, 0.5, 0}, {1, 0, 0}},
      {"plate on a plate", plate, plate, {0.5, 0.25, 0}, {0, 0, 1}},
      {"plate on a cube", cube, plate, {0.5, 0.25, -1}, {0, 0, -1}},
      {"needle in a face", cube, needle, {1, 0.5, 0.5}, {1, 0, 0}},
      {"ball on a face", cube, Sphere(0.5), {1.5, 0.25, 0.5}, {1, 0, 0}},
      {"ball on an edge", cube, Sphere(5), {4, 5, 0.5}, {1, 0, 0}},
      {"ball on a vertex", cube, Sphere(13), {4, 5, 13}, {1, 0, 0}},
      {"ball on a ball", Sphere(5), Sphere(8), {3, 4, 12}, {0, 0, 1}},
      {"capsule along capsule", Capsule(2, 2), Capsule(3, 3), {3, 4, 1}, {0, 1, 0}},
      {"capsule on the end of a capsule", Capsule(2, 5), Capsule(4, 8), {3, 4, 15}, {1, 0, 0}},
      {"rounded cube on a cube", inflated(Box(2, 2, 2), 0.5), cube, {2.5, 1, 0}, {1, 0, 0}},
  };
  for (const Touch& touch : touches) {
    SCOPED_TRACE(touch.name);
    // In the other order and with the axes exchanged the same.
    for (int turn = 0; turn < 2; ++turn) {
      Transformd pose = shifted_by(touch.at.x, touch.at.y, touch.at.z);
      ASSERT_NO_FATAL_FAILURE(expect_truth(touch.a, touch.b, pose, Outcome::overlap));
      ASSERT_EQ(true_outcome(touch.a, touch.b, pose), Outcome::overlap);
      const Vec3d d = touch.apart;
      const auto ulp_on = [](double x, double along) {
        return along == 0.0 ? x : (x == 0.0 ? along * 0x1p-1074 : std::nextafter(x, along * 1e300));
      };
      Transformd moved = shifted_by(ulp_on(touch.at.x, d.x), ulp_on(touch.at.y, d.y), ulp_on(touch.at.z, d.z));
      const Outcome truth = true_outcome(touch.a, touch.b, moved).value();
      ASSERT_NO_FATAL_FAILURE(expect_truth(touch.a, touch.b, moved, truth));
      // Placed vertices are rounded, so that a shift in the last bit can vanish; a few bits higher it cannot.
      moved = shifted_by(touch.at.x + 0x1p-40 * d.x, touch.at.y + 0x1p-40 * d.y, touch.at.z + 0x1p-40 * d.z);
      ASSERT_NO_FATAL_FAILURE(expect_truth(touch.a, touch.b, moved, Outcome::disjoint));
      moved = shifted_by(-touch.at.x, -touch.at.y, -touch.at.z);
      ASSERT_NO_FATAL_FAILURE(expect_truth(touch.b, touch.a, moved, Outcome::overlap));
    }
  }
}

TEST(ExactOverlap, BallsStayBallsUnderAMatrixThatIsNoRotation) {
  // R off a rotation by 1e-7: an ellipsoid of that matrix would reach 1e-7 farther or less.
  Transformd pose{{1.0 + 1e-7, 0, 0}, {0, 1.0 - 1e-7, 0}, {0, 0, 1.0 + 1e-7}, {3, 4, 12}};
  ASSERT_NO_FATAL_FAILURE(expect_truth(Sphere(5), Sphere(8), pose, Outcome::overlap));
  ASSERT_NO_FATAL_FAILURE(expect_truth(Sphere(8), Sphere(5), pose, Outcome::overlap));
  ASSERT_NO_FATAL_FAILURE(expect_truth(Sphere(5), Sphere(std::nextafter(8.0, 0.0)), pose, Outcome::disjoint));
  // The axis of a capsule is stretched, its radius is not.
  const Transformd stretched{{1, 0, 0}, {0, 1, 0}, {0, 0, 1.0 + 0x1p-23}, {0, 0, 5.0 + 0x1p-23}};
  ASSERT_NO_FATAL_FAILURE(expect_truth(Sphere(2), Capsule(2, 2), stretched, Outcome::overlap));
  Transformd apart = stretched;
  apart.translation.z = std::nextafter(apart.translation.z, 6.0);
  ASSERT_NO_FATAL_FAILURE(expect_truth(Sphere(2), Capsule(2, 2), apart, Outcome::disjoint));
}

TEST(ExactOverlap, OfAnySizesIsDecided) {
  struct Case {
    ConvexBody a, b;
    Transformd pose;
    Outcome truth;
  };
  const double big = 0x1p498, small = 0x1p-498, denormal = 0x1p-1074;
  const double tiny = 1e-300;  // the smallest size: below, support errors are no normal numbers any more
  const ConvexBody cube = test_box(2, 2, 2).body;
  const ConvexBody big_cube = test_box(2 * big, 2 * big, 2 * big).body;
  const ConvexBody small_cube = test_box(2 * small, 2 * small, 2 * small).body;
  const ConvexBody mixed = hull({{big, small, 0}, {-big, small, denormal}, {0, -small, 1}, {0, -1, -small}});
  const std::vector<Case> cases = {
      {big_cube, big_cube, shifted_by(2 * big, 0.5 * big, 1), Outcome::overlap},
      {big_cube, big_cube, shifted_by(std::nextafter(2 * big, HUGE_VAL), 0.5 * big, 1), Outcome::disjoint},
      {big_cube, big_cube, shifted_by(2 * big * (1 + 0x1p-50), 0.5 * big, 1), Outcome::disjoint},
      {small_cube, small_cube, shifted_by(2 * small, small, -small), Outcome::overlap},
      {small_cube, small_cube, shifted_by(2 * small * (1 + 0x1p-50), small, -small), Outcome::disjoint},
      {small_cube, cube, shifted_by(1 + small, 0, 0), Outcome::overlap},  // placed, the small cube is a rounded point
      {cube, small_cube, shifted_by(std::nextafter(1.0, 2.0), 0, 0), Outcome::disjoint},
      {big_cube, small_cube, shifted_by(big, big, big), Outcome::overlap},
      {big_cube, small_cube, shifted_by(std::nextafter(big, HUGE_VAL), big, big), Outcome::disjoint},
      {Sphere(big), Sphere(small), shifted_by(big, 0, 0), Outcome::overlap},
      {Sphere(big), Sphere(small), shifted_by(std::nextafter(big, HUGE_VAL), 0, 0), Outcome::disjoint},
      {Sphere(big), Sphere(tiny), shifted_by(0, big, 0), Outcome::overlap},
      {Sphere(1.0), Sphere(tiny), shifted_by(1.0, tiny, 0), Outcome::overlap},
      {Sphere(tiny), Sphere(tiny), shifted_by(2 * tiny, 0, 0), Outcome::overlap},
      {Sphere(tiny), Sphere(tiny), shifted_by(2 * tiny, denormal, 0), Outcome::disjoint},
      {hull({{denormal, 0, 0}}), hull({{0, 0, 0}}), shifted_by(denormal, 0, 0), Outcome::overlap},
      {hull({{denormal, 0, 0}}), hull({{0, 0, 0}}), shifted_by(2 * denormal, 0, 0), Outcome::disjoint},
      {Sphere(1e12), Sphere(1), shifted_by(1e12 + 1, 0, 0), Outcome::overlap},
      {Sphere(1e12), Sphere(1), shifted_by(std::nextafter(1e12 + 1, 1e13), 0, 0), Outcome::disjoint},
      {test_box(1e12, 1e12, 1e12).body, cube, shifted_by(5e11 + 1, 4e11, 3e11), Outcome::overlap},
      {test_box(1e12, 1e12, 1e12).body, cube, shifted_by(5e11 + 1.001, 4e11, 3e11), Outcome::disjoint},
  };
  for (std::size_t k = 0; k < cases.size(); ++k) {
    SCOPED_TRACE(k);
    EXPECT_EQ(true_outcome(cases[k].a, cases[k].b, cases[k].pose).value(), cases[k].truth);
    ASSERT_NO_FATAL_FAILURE(expect_truth(cases[k].a, cases[k].b, cases[k].pose, cases[k].truth));
  }
  std::mt19937_64 random(4);
  for (int k = 0; k < 30; ++k) {
    Transformd pose = random_rotation(random);
    pose.translation = {small, -1.0, k % 2 == 0 ? big * random_in_unit_interval(random) : denormal};
    ASSERT_NO_FATAL_FAILURE(expect_truth(mixed, mixed, pose)) << k;
    ASSERT_NO_FATAL_FAILURE(expect_truth(mixed, inflated(Needle(1), small), pose)) << k;
    ASSERT_NO_FATAL_FAILURE(expect_truth(inflated(Needle(1), 1.0), mixed, pose)) << k;
  }
}

TEST(ExactOverlap, EndsOnHullsOfManyNearlyCoplanarPoints) {
  // Points of a fine grid, raised by an ulp or two: thousands of vertices that double precision cannot tell apart.
  std::mt19937_64 random(5);
  std::vector<Vec3d> points;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) {
      points.push_back({0.05 * i - 1.0, 0.05 * j - 1.0, 1.0 + 0x1p-52 * static_cast<double>(random() % 3)});
    }
  }
  points.push_back({0, 0, -1});
  const ConvexBody grid = hull(points), cube = test_box(1, 1, 1).body;
  int n_support_calls = 0;
  for (const double lift : {1.5, 1.5 + 0x1p-52, 1.5 + 0x1p-51, 1.5 + 0x1p-50}) {
    const Transformd pose = shifted_by(0.01, 0.02, lift);
    ASSERT_NO_FATAL_FAILURE(expect_truth(grid, cube, pose));
    n_support_calls += exact_overlap(*placed_forms(grid, cube, pose)).n_support_calls;
  }
  EXPECT_LT(n_support_calls, 400);
}

TEST(ExactOverlap, OfFacesThatAreCoplanarButForRoundingIsWhatRationalsSay) {
  // Points of one tilted plane, rounded, on both bodies, which lie on either side of it: along its normal double
  // precision takes now this, now that point for the farthest.
  std::mt19937_64 random(6);
  int n_overlap = 0, n_disjoint = 0;
  for (int k = 0; k < 600; ++k) {
    const Vec3d normal = random_direction(random), e = cross(normal, random_direction(random)), f = cross(normal, e);
    const Vec3d middle = 3.0 * random_direction(random);
    const auto face = [&](std::vector<Vec3d>& points) {
      for (int j = 0; j < 10; ++j) {
        points.push_back(middle + (random_in_unit_interval(random) - 0.5) * e +
                         (random_in_unit_interval(random) - 0.5) * f);
      }
    };
    std::vector<Vec3d> below = {middle - normal}, above = {middle + normal};
    face(below);
    face(above);
    const double lift = (random_in_unit_interval(random) - 0.25) * 0x1p-51;
    const Transformd pose = shifted_by(lift * normal.x, lift * normal.y, lift * normal.z);
    const ConvexBody a = hull(below), b = hull(above);
    const Outcome truth = true_outcome(a, b, pose).value();
    (truth == Outcome::overlap ? n_overlap : n_disjoint) += 1;
    ASSERT_NO_FATAL_FAILURE(expect_truth(a, b, pose, truth));
  }
  EXPECT_GT(n_overlap, 100);
  EXPECT_GT(n_disjoint, 20);
}

}  // namespace
}  // namespace vex
