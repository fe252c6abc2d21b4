#include "engine/sampling/radial/radial_function.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <tuple>

#include "engine/query/overlap.h"
#include "engine/sampling/radial/radial_steps.h"
#include "shapes/any_shape.h"
#include "shapes/box.h"
#include "shapes/ellipsoid.h"
#include "shapes/sphere.h"
#include "tests/referees/bodies.h"
#include "tests/referees/polytopes.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

BodyPoints centres(const ConvexBody& a, const ConvexBody& b) { return {a.centre(), b.centre()}; }

void expect_holds(const RadialBounds& found, double truth) {
  EXPECT_LE(found.lower, truth);
  EXPECT_GE(found.upper, truth);
  EXPECT_LE(found.upper - found.lower, 8.0 * kRadialRounding * found.upper);
}

TEST(RadialFunction, OfBallsIsTheSumOfTheRadii) {
  const ConvexBody a = Sphere(1.0), b = Sphere(0.25);
  std::mt19937_64 random(1);
  for (int k = 0; k < 100; ++k) {
    const Vec3d dir = random_direction(random);
    expect_holds(radial_function(a, b, {}, random_rotation(random), dir), 1.25 / norm(dir));
  }
}

TEST(RadialFunction, OfAlignedBoxesIsThatOfABoxAlsoThroughCornersEdgesAndMiddles) {
  const ConvexBody a = Box(1.0, 2.0, 3.0), b = Box(0.5, 0.25, 4.0);
  std::mt19937_64 random(2);
  const auto truth = [](const Vec3d& dir) {
    const auto along = [](double half, double d) { return d == 0.0 ? HUGE_VAL : half / std::fabs(d); };
    return std::min({along(0.75, dir.x), along(1.125, dir.y), along(3.5, dir.z)});
  };
  for (int k = 0; k < 300; ++k) {
    Vec3d dir = random_direction(random);
    if (k % 3 == 1) dir = {0.75 * std::copysign(1.0, dir.x), 1.125, k % 2 == 0 ? 3.5 : dir.z};
    if (k % 3 == 2) dir = {k % 2 == 0 ? 0.0 : 1.0, 0.0, -1.0};
    expect_holds(radial_function(a, b, {}, {}, dir), truth(dir));
  }
}

TEST(RadialFunction, OfAlignedLikeEllipsoidsIsThatOfOneAlsoOfFlatAndLongOnes) {
  std::mt19937_64 random(3);
  for (const Vec3d& axes : {Vec3d{1, 2, 3}, Vec3d{1e-3, 1, 1}, Vec3d{300, 1, 1}}) {
    const ConvexBody a = Ellipsoid(axes.x, axes.y, axes.z), b = Ellipsoid(2 * axes.x, 2 * axes.y, 2 * axes.z);
    for (int k = 0; k < 100; ++k) {
      const Vec3d dir = random_direction(random);
      expect_holds(radial_function(a, b, {}, {}, dir),
                   3.0 / norm(Vec3d{dir.x / axes.x, dir.y / axes.y, dir.z / axes.z}));
    }
  }
}

TEST(RadialFunction, GrowsAsTheDirectionShrinksByAnyPowerOfTwo) {
  const ConvexBody a = Box(1.0, 2.0, 3.0), b = Ellipsoid(1.0, 0.5, 0.25);
  std::mt19937_64 random(4);
  const Transformd rotation = random_rotation(random);
  const Vec3d dir = random_direction(random);
  const RadialBounds found = radial_function(a, b, {}, rotation, dir);
  for (const int exponent : {-900, -30, 1, 40, 900}) {
    const RadialBounds scaled = radial_function(a, b, {}, rotation, times_power_of_two(dir, exponent));
    EXPECT_EQ(scaled.lower, std::ldexp(found.lower, -exponent));
    EXPECT_EQ(scaled.upper, std::ldexp(found.upper, -exponent));
  }
}

TEST(RadialFunction, ClosesInAsFarAsIsAskedFor) {
  const ConvexBody a = Ellipsoid(1.0, 2.0, 3.0), b = Ellipsoid(3.0, 0.5, 0.25);
  std::mt19937_64 random(5);
  for (int k = 0; k < 100; ++k) {
    const Transformd rotation = random_rotation(random);
    const Vec3d dir = random_direction(random);
    const RadialBounds best = radial_function(a, b, {}, rotation, dir);
    int n_calls = best.n_support_calls + 1;
    for (const double gap : {1e-6, 1e-3, 0.1}) {
      const RadialBounds found = radial_function(a, b, {}, rotation, dir, gap);
      EXPECT_LE(found.upper - found.lower, (gap + 4.0 * kRadialRounding) * found.upper);
      EXPECT_LE(found.lower, best.upper);
      EXPECT_GE(found.upper, best.lower);
      EXPECT_LT(found.n_support_calls, n_calls) << "less is less work";
      n_calls = found.n_support_calls + 1;
    }
  }
}

// What the bounds are about: B moved as far as the lower one meets A, and farther than the upper one does not. The
// referee is the proven verdict.
void expect_bounds_of_contact(const ConvexBody& a, const ConvexBody& b, const BodyPoints& points,
                              const Transformd& rotation, const Vec3d& dir, const RadialBounds& found) {
  const auto at = [&](double r) {
    Transformd pose = rotation;
    pose.translation = {};
    pose.translation = (points.of_a - pose(points.of_b)) + r * dir;
    return overlap(a, b, pose).outcome;
  };
  // What the pose's own coordinates are rounded by.
  const double rounding = 64.0 * kUnitRoundoff * (a.reach() + b.reach()) / norm(dir);
  if (found.lower > rounding) {
    EXPECT_NE(at(found.lower - rounding), Outcome::disjoint);
  }
  EXPECT_NE(at(found.upper + rounding), Outcome::overlap);
}

class RadialFunctionOfPairs : public testing::TestWithParam<NamedPair> {};

TEST_P(RadialFunctionOfPairs, IsWhereProvenVerdictsChange) {
  const ConvexBody a = parse_shape(GetParam().a).body, b = parse_shape(GetParam().b).body;
  std::mt19937_64 random(6);
  int n_bisected = 0;
  constexpr int kRays = 60;
  for (int k = 0; k < kRays; ++k) {
    const Transformd rotation = random_rotation(random);
    Vec3d dir = random_direction(random);
    if (k % 4 == 0) dir = {dir.x, 0.0, 0.0};                                       // in planes of symmetry of A
    if (k % 4 == 1) dir = {rotation.row_x.z, rotation.row_y.z, rotation.row_z.z};  // along B's axis
    // About the centres, and about points that are nearer to one side.
    BodyPoints points = centres(a, b);
    if (k % 5 == 0) points.of_a = points.of_a + 0.75 * (a.support(random_direction(random)) - points.of_a);
    const RadialBounds found = radial_function(a, b, points, rotation, dir);
    EXPECT_LE(0.0, found.lower);
    EXPECT_LE(found.lower, found.upper);
    EXPECT_LE(found.upper - found.lower,
              8.0 * kRadialRounding * found.upper + 64.0 * kUnitRoundoff * (a.reach() + b.reach()) / norm(dir));
    expect_bounds_of_contact(a, b, points, rotation, dir, found);
    if (k % 4 >= 2 && found.is_bisected) ++n_bisected;
  }
  // Polytopes come to an end; with curved parts the last digits may be left to the verdicts.
  const auto is_polytope = [](const ConvexBody& body) { return body.exact_form()->is_polytope(); };
  if (is_polytope(a) && is_polytope(b)) {
    EXPECT_LE(n_bisected, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Pairs, RadialFunctionOfPairs, testing::ValuesIn(unordered_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });

TEST(RadialFunction, AboutAPointOfTheSurfaceEnds) {
  const ConvexBody a = parse_shape("octahedron:1").body, b = parse_shape("needle:2").body;
  std::mt19937_64 random(9);
  for (int k = 0; k < 60; ++k) {
    const BodyPoints points{a.support(random_direction(random)), b.centre()};
    const Transformd rotation = random_rotation(random);
    const RadialBounds found = radial_function(a, b, points, rotation, random_direction(random));
    EXPECT_LE(0.0, found.lower);
    EXPECT_LE(found.lower, found.upper);
  }
}

TEST(RadialFunction, OfLengthsThatOverflowInProductsComesFromVerdicts) {
  std::mt19937_64 random(7);
  for (const double size : {1e-140, 1e-70, 1e70, 1e140}) {
    const ConvexBody a = parse_shape("box:1,2,3", size, kQueriedSizes).body;
    const ConvexBody b = parse_shape("ellipsoid:1,0.5,2", size, kQueriedSizes).body;
    const ConvexBody unit_a = parse_shape("box:1,2,3").body, unit_b = parse_shape("ellipsoid:1,0.5,2").body;
    const Transformd rotation = random_rotation(random);
    const Vec3d dir = random_direction(random);
    const RadialBounds found = radial_function(a, b, {}, rotation, dir);
    const RadialBounds of_unit = radial_function(unit_a, unit_b, {}, rotation, dir);
    EXPECT_TRUE(found.is_bisected);
    EXPECT_NEAR(found.lower / size, of_unit.lower, 1e-6 * of_unit.upper);
    EXPECT_NEAR(found.upper / size, of_unit.upper, 1e-6 * of_unit.upper);
  }
}

// Bisection told of r to 1e-8 where the rounding of coordinates alone moves it by 1e-7.
TEST(RadialFunction, OfAThinBodyThatIsBisectedHoldsWhatRoundingMayMove) {
  const ConvexBody grain = Sphere(1e-20);
  std::mt19937_64 random(10);
  int n_bisected = 0;
  for (int k = 0; k < 400; ++k) {
    const Vec3d edges{1.0, 0.4 + random_in_unit_interval(random), 1e-8};
    const ConvexBody plate = Box(edges.x, edges.y, edges.z);
    const Transformd r = random_rotation(random);
    // Nearly along the plate, which the ray leaves by its rim or, at a grazing angle, by a face.
    const Vec3d in_plate = random_direction(random);
    const Vec3d dir = r(Vec3d{in_plate.x, in_plate.y, 2e-8 * in_plate.z});
    const auto half_over = [](double edge, long double d) { return 0.5L * edge / std::fabs(d); };
    const auto along = [&](double x, double y, double z) {  // a column of R times the direction as it is
      return static_cast<long double>(x) * dir.x + static_cast<long double>(y) * dir.y +
             static_cast<long double>(z) * dir.z;
    };
    const auto truth = static_cast<double>(std::min({half_over(edges.x, along(r.row_x.x, r.row_y.x, r.row_z.x)),
                                                     half_over(edges.y, along(r.row_x.y, r.row_y.y, r.row_z.y)),
                                                     half_over(edges.z, along(r.row_x.z, r.row_y.z, r.row_z.z))}));
    const RadialBounds found = radial_function(grain, plate, {}, r, dir);
    if (found.is_bisected) ++n_bisected;
    EXPECT_LE(found.lower, truth * (1.0 + 1e-9));
    EXPECT_GE(found.upper, truth * (1.0 - 1e-9));
    EXPECT_LE(found.upper - found.lower, 1e-5 * found.upper);
  }
  EXPECT_GT(n_bisected, 100);
}

/// A ball that knows itself to 1e-6 only.
struct RoughBall {
  Vec3d support(const Vec3d& dir) const { return (1.0 / norm(dir)) * dir; }
  double support_error() const { return 1e-6; }
  Vec3d centre() const { return {}; }
  double circumradius() const { return 1.0 + 1e-6; }
  double inradius() const { return 1.0 - 1e-6; }
};

TEST(RadialFunction, OfABodyThatIsNotKnownBetterIsFoundToThat) {
  const ConvexBody rough = RoughBall{}, ball = Sphere(1.0);
  const Vec3d dir{0.3, 0.4, 0.5};
  const RadialBounds found = radial_function(rough, ball, {}, {}, dir);
  EXPECT_LE(found.lower * norm(dir), 2.0);
  EXPECT_GE(found.upper * norm(dir), 2.0);
  EXPECT_LE(found.upper - found.lower, 2e-5);
}

TEST(RadialFunction, OfADirectionOfAnyLengthIsRoundedOutwards) {
  const ConvexBody small = Sphere(1e-20), unit = Sphere(1.0);
  const RadialBounds tiny = radial_function(small, small, {}, {}, {1e308, 0.0, 0.0});  // 2e-328
  EXPECT_EQ(tiny.lower, 0.0);
  EXPECT_GT(tiny.upper, 0.0);
  const RadialBounds huge = radial_function(unit, unit, {}, {}, {1e-310, 0.0, 0.0});  // 2e310
  EXPECT_EQ(huge.lower, std::numeric_limits<double>::max());
  EXPECT_EQ(huge.upper, HUGE_VAL);
}

TEST(RadialFunction, OfBodiesFarFromTheirOriginsIsAsGoodAsTheirCoordinates) {
  const ConvexBody a = Box(1.0, 1.0, 1.0);
  std::vector<Vec3d> far = box_vertices(1.0, 1.0, 1.0);
  for (Vec3d& v : far) v = v + Vec3d{1e6, -2e6, 3e6};
  const ConvexBody b = Polytope(far, {1e6, -2e6, 3e6}, 0.5);
  std::mt19937_64 random(8);
  for (int k = 0; k < 30; ++k) {
    const Transformd rotation = random_rotation(random);
    const Vec3d dir = random_direction(random);
    const RadialBounds found = radial_function(a, b, centres(a, b), rotation, dir);
    const RadialBounds near = radial_function(a, a, {}, rotation, dir);
    EXPECT_NEAR(found.lower, near.lower, 1e-7 * near.upper);
    EXPECT_NEAR(found.upper, near.upper, 1e-7 * near.upper);
  }
}

TEST(RadialFunction, OfADifferenceWithoutVolumeIsTheLengthInItsPlane) {
  const ConvexBody plate = parse_shape("plate:1,1").body;
  expect_holds(radial_function(plate, plate, {}, {}, {1.0, 0.5, 0.0}), 1.0);
  EXPECT_EQ(radial_function(plate, plate, {}, {}, {0.0, 0.0, 1.0}).lower, 0.0);
  EXPECT_LE(radial_function(plate, plate, {}, {}, {0.0, 0.0, 1.0}).upper, 1e-14);
}

}  // namespace
}  // namespace vex
