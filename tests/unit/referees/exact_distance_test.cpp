// Signed distances against closed forms and against laws that they obey.
#include "tests/referees/exact_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shapes/any_shape.h"
#include "tests/referees/polytopes.h"
#include "tests/unit/apps/referees/pairs.h"

namespace vex {
namespace {

ConvexBody body_of_text(const char* text) { return parse_shape(text).body; }

Transformd placed_at(double x, double y, double z, Transformd turn = {}) {
  turn.translation = {x, y, z};
  return turn;
}

void expect_distance(const char* a, const char* b, const Transformd& pose, double expected) {
  const SignedDistance found = exact_signed_distance(body_of_text(a), body_of_text(b), pose);
  EXPECT_LE(found.error, 1e-16 * (1.0 + std::fabs(expected))) << a << " " << b;
  EXPECT_NEAR(found.value, expected, 1e-15 * (1.0 + std::fabs(expected))) << a << " " << b;
}

TEST(ExactSignedDistance, OfParallelBoxes) {
  expect_distance("box:1,2,3", "box:1,2,3", placed_at(0, 0, 5), 2.0);
  expect_distance("box:1,2,3", "box:1,2,3", placed_at(0.5, 1.5, 0.1), -0.5);
  expect_distance("box:1,2,3", "box:1,2,3", placed_at(-0.5, 0.25, 0), -0.5);
  expect_distance("box:1,2,3", "box:1,2,3", placed_at(4, 6, 0), 5.0);          // edges 3 and 4 apart
  expect_distance("box:1,2,3", "box:1,2,3", placed_at(3, -5, 9), 7.0);         // corners 2, 3 and 6 apart
  expect_distance("box:1,2,3", "box:1,2,3", placed_at(1, 2, 3), 0.0);          // a corner in common
  expect_distance("box:4,4,4", "box:0.5,0.5,0.5", placed_at(1, 0, 0), -1.25);  // inside: out by the nearest face
  expect_distance("box:1,1,1", "box:1,1,1", placed_at(0x1p-80, 0, 1), 0.0);
}

TEST(ExactSignedDistance, OfTurnedCubes) {
  const double half_diagonal = std::numbers::sqrt2 / 2.0;
  const Transformd turn = rotation_about({0, 0, 1}, std::numbers::pi / 4.0);
  expect_distance("box:1,1,1", "box:1,1,1", placed_at(1.5, 0, 0, turn), 1.0 - half_diagonal);  // edge over face
  expect_distance("box:1,1,1", "box:1,1,1", placed_at(0.5 + half_diagonal - 0.125, 0, 0, turn), -0.125);
  const Transformd on_edge = rotation_about({1, 0, 0}, std::numbers::pi / 4.0);
  // An edge along y below, one along x above: two crossed roofs.
  const Transformd a_turn = rotation_about({0, 1, 0}, std::numbers::pi / 4.0);
  Transformd relative;  // a_turn^T on_edge, and (0, 0, z) seen from A
  const Vec3d columns[] = {{on_edge.row_x.x, on_edge.row_y.x, on_edge.row_z.x},
                           {on_edge.row_x.y, on_edge.row_y.y, on_edge.row_z.y},
                           {on_edge.row_x.z, on_edge.row_y.z, on_edge.row_z.z}};
  const Vec3d turned[] = {a_turn.direction_to_b(columns[0]), a_turn.direction_to_b(columns[1]),
                          a_turn.direction_to_b(columns[2])};
  relative.row_x = {turned[0].x, turned[1].x, turned[2].x};
  relative.row_y = {turned[0].y, turned[1].y, turned[2].y};
  relative.row_z = {turned[0].z, turned[1].z, turned[2].z};
  for (const double gap : {0.25, -0.125}) {
    relative.translation = a_turn.direction_to_b({0, 0, std::numbers::sqrt2 + gap});
    expect_distance("box:1,1,1", "box:1,1,1", relative, gap);
  }
}

TEST(ExactSignedDistance, OfFlatBodiesThatMeetIsZero) {
  expect_distance("plate:1,1", "plate:1,1", placed_at(0.25, 0.25, 0), 0.0);
  expect_distance("needle:2", "plate:1,1", placed_at(0, 0, 1), 0.0);
  expect_distance("needle:2", "plate:1,1", placed_at(0, 0, 1.5), 0.5);
  expect_distance("needle:2", "needle:2", placed_at(0, 0, 0), 0.0);
  expect_distance("needle:2", "needle:2", placed_at(0, 3, 6), 5.0);
  expect_distance("needle:2", "plate:1,1", placed_at(0, 0, 0.75), -0.25);  // along the needle, or 0.5 aside
}

TEST(ExactSignedDistance, OfBallsIsThatOfTheirCoresLessTheRadii) {
  expect_distance("sphere:0.5", "sphere:0.25", placed_at(3, 4, 0), 4.25);
  expect_distance("sphere:0.5", "sphere:0.25", placed_at(0, 0, 0), -0.75);
  expect_distance("sphere:0.5", "box:2,2,2", placed_at(2, 0, 0), 0.5);
  expect_distance("box:2,2,2", "sphere:0.5", placed_at(0.75, 0, 0), -0.75);
  expect_distance("capsule:2,0.25", "capsule:2,0.5", placed_at(3, 4, 1), 4.25);
  expect_distance("rounded:0.25,box:1,1,1", "box:1,1,1", placed_at(0, 1, 0), -0.25);
}

TEST(ExactSignedDistance, OfCylindersIsBetweenNarrowBounds) {
  expect_distance("cylinder:2,0.5", "cylinder:2,0.25", placed_at(0, 0, 3), 1.0);
  expect_distance("cylinder:2,0.5", "box:1,1,1", placed_at(1.25, 0, 0), 0.25);
  expect_distance("cylinder:2,0.5", "box:1,1,1", placed_at(0.875, 0, 0), -0.125);
  expect_distance("box:1,1,1", "cylinder:2,0.5", placed_at(0, 0, -1.25), -0.25);
  expect_distance("capsule:2,0.25", "cylinder:2,0.5", placed_at(3, 4, 0.5), 4.25);
  // A rim over a face: the half length and the radius, both at 45 degrees.
  const Transformd turn = rotation_about({0, 1, 0}, std::numbers::pi / 4.0);
  expect_distance("box:4,4,1", "cylinder:2,0.5", placed_at(0, 0, 2, turn), 1.5 - 1.5 * std::numbers::sqrt2 / 2.0);
  expect_distance("box:4,4,1", "cylinder:2,0.5", placed_at(0, 0, 1.5, turn), 1.0 - 1.5 * std::numbers::sqrt2 / 2.0);
  // A needle's end beside a rim, 3 out and 4 up.
  expect_distance("needle:2", "cylinder:2,0.5", placed_at(3.5, 0, -6), 5.0);
}

TEST(ExactSignedDistance, OfConesAndHemispheresIsThatOfTheirFlatSidesAndTips) {
  for (const char* text : {"cone:1,0.5", "hemisphere:0.5", "frustum:1,0.5,0.25"}) {
    const double top = body_of_text(text).support({0, 0, 1}).z, bottom = body_of_text(text).support({0, 0, -1}).z;
    for (const double gap : {0.25, -0.125}) {
      const SignedDistance below =
          exact_signed_distance(body_of_text("box:2,2,1"), body_of_text(text), placed_at(0, 0, 0.5 - bottom + gap));
      EXPECT_NEAR(below.value, gap, below.error + 1e-15) << text;
      EXPECT_LE(below.error, 1e-15) << text;
      const SignedDistance above =
          exact_signed_distance(body_of_text("box:2,2,1"), body_of_text(text), placed_at(0, 0, -0.5 - top - gap));
      EXPECT_NEAR(above.value, gap, above.error + 1e-15) << text;
      EXPECT_LE(above.error, 1e-15) << text;
    }
  }
}

TEST(ExactSignedDistance, IsMutualAndEndsInContact) {
  std::mt19937_64 random(211);
  int n_overlap = 0;
  constexpr int n = 30;
  for (int k = 0; k < n; ++k) {
    const auto points = [&](const std::vector<Vec3d>& vertices) {
      std::vector<exact::Point> result;
      for (const Vec3d& v : vertices) result.push_back(exact::exactly(v));
      return result;
    };
    const std::vector<exact::Point> a = points(test_point_hull(7, {1, 2, 0.5}, random()).vertices);
    Transformd pose = random_rotation(random);
    pose.translation = 2.0 * random_direction(random);
    std::vector<exact::Point> b = points(exact::placed(box_vertices(1, 0.2, 2), pose));
    const exact::Deepest one = exact::deepest(a, b), other = exact::deepest(b, a);
    n_overlap += one.signed_distance <= 0 ? 1 : 0;
    EXPECT_LT(abs(one.signed_distance - other.signed_distance), 1e-90);
    // Moved along the direction by depth or distance, to forty digits, the bodies touch, and a little beyond they do
    // not.
    exact::Float length_sq = 0;
    for (const exact::Rational& x : one.direction) length_sq += exact::Float(x) * exact::Float(x);
    const exact::Float factor = -one.signed_distance / sqrt(length_sq);
    for (const double beyond : {-1e-40, 1e-40}) {
      std::vector<exact::Point> moved = b;
      for (exact::Point& p : moved) {
        for (std::size_t i = 0; i < 3; ++i) {
          const exact::Float step = factor * exact::Float(one.direction[i]) * (exact::Float(1) + beyond);
          p[i] += exact::Rational(boost::multiprecision::cpp_int(ldexp(step, 250))) /
                  exact::Rational(boost::multiprecision::cpp_int(1) << 250);
        }
      }
      const exact::Float left = exact::deepest(a, moved).signed_distance;
      EXPECT_LT(abs(left), 1e-39);
      // Apart, going beyond meets; together, it separates.
      EXPECT_EQ(left > 0, (beyond > 0) == (one.signed_distance < 0));
    }
  }
  EXPECT_GT(n_overlap, 3 * n / 10);
  EXPECT_LT(n_overlap, 7 * n / 10);
}

TEST(EllipsoidSignedDistance, OfSpheresIsExactAndOfSpheroidsAtTheirPoles) {
  const auto expect = [](const char* a, const char* b, const Transformd& pose, const Vec3d& normal, double expected) {
    const SignedDistance found = ellipsoid_signed_distance(body_of_text(a), body_of_text(b), pose, normal);
    EXPECT_NEAR(found.value, expected, found.error) << a << " " << b;
    EXPECT_LE(found.error, 1e-15 * (1.0 + std::fabs(expected))) << a << " " << b;
  };
  expect("sphere:0.5", "sphere:0.25", placed_at(3, 4, 0), {3, 4, 0}, 4.25);
  expect("ellipsoid:1,2,3", "ellipsoid:0.5,0.5,1", placed_at(0, 0, 4.5), {0, 0, 1}, 0.5);
  expect("ellipsoid:1,2,3", "ellipsoid:0.5,0.5,1", placed_at(0, 2.375, 0), {0, 2, 0}, -0.125);
  expect("ellipsoid:1,2,3", "sphere:0.5", placed_at(-1.25, 0, 0), {-1, 0, 0}, -0.25);
}

TEST(EllipsoidSignedDistance, BoundsFarFromTheNormalStillHold) {
  const ConvexBody a = body_of_text("ellipsoid:1,2,3"), b = body_of_text("ellipsoid:0.5,0.5,1");
  const SignedDistance off = ellipsoid_signed_distance(a, b, placed_at(0, 0, 4.0625), {0.01, -0.01, 1});
  EXPECT_GT(off.error, 1e-6);
  EXPECT_NEAR(off.value, 0.0625, off.error);
  EXPECT_EQ(ellipsoid_signed_distance(a, b, {}, {0, 0, 1}).error, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace vex
