#include "engine/sampling/radial/radial_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/sampling/radial/radial_steps.h"
#include "shapes/any_shape.h"
#include "shapes/ellipsoid.h"
#include "shapes/formula.h"
#include "shapes/polytope.h"
#include "tests/referees/bodies.h"
#include "tests/referees/randomised_mean.h"

namespace vex {
namespace {

class RadialEstimatorOfPairs : public testing::TestWithParam<NamedPair> {};

// Student's t with 31 degrees of freedom exceeds 5 once in 50 000 times; seeds are fixed.
TEST_P(RadialEstimatorOfPairs, AgreesWithTheFormula) {
  const Body a = parse_shape(GetParam().a), b = parse_shape(GetParam().b);
  const double truth = average_excluded_volume(a.measures, b.measures);
  RadialEstimator estimator(a.body, b.body, {});
  const RandomisedMean found = mean_of(estimator, 7, 11);
  EXPECT_LE(std::fabs(found.value - truth), 5.0 * found.std_error + kRadialRounding * truth);
  EXPECT_LE(found.std_error, 0.02 * truth);
}

INSTANTIATE_TEST_SUITE_P(FormlessPairs, RadialEstimatorOfPairs, testing::ValuesIn(formless_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });
INSTANTIATE_TEST_SUITE_P(Pairs, RadialEstimatorOfPairs, testing::ValuesIn(unordered_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });

TEST(RadialEstimator, SeesABiasOfATwoHundredth) {
  const Body cube = parse_shape("box:1,1,1");
  RadialEstimator estimator(cube.body, cube.body, {});
  const RandomisedMean found = mean_of(estimator, 10, 1);
  EXPECT_LE(std::fabs(found.value - 11.0), 5.0 * found.std_error);
  EXPECT_GT(std::fabs(1.005 * found.value - 11.0), 5.0 * found.std_error);
}

TEST(RadialEstimator, GainsOnRandomPointsAsTheNetGrows) {
  const Body body = parse_shape("ellipsoid:1,2,3");
  RadialEstimator estimator(body.body, body.body, {});
  // Random points would need 256 times as many for a sixteenth of the error.
  EXPECT_LT(mean_of(estimator, 12, 1).std_error, mean_of(estimator, 4, 1).std_error / 32.0);
}

// Corners off the axes by symmetry: with the frame's axes for the body's own a net was no better than random points.
TEST(RadialEstimator, GainsForTetrahedra) {
  const Body body = parse_shape("tetrahedron:1");
  RadialEstimator estimator(body.body, body.body, {});
  const RandomisedMean found = mean_of(estimator, 12, 1);
  const double truth = average_excluded_volume(body.measures, body.measures);
  EXPECT_LE(std::fabs(found.value - truth), 5.0 * found.std_error);
  EXPECT_LE(found.std_error, 0.6 * 0.47 / std::sqrt(32.0 * 4096.0) * truth);
}

// Random points would have 0.56 and 0.77 / sqrt(32 * 4096), 1.5e-3 and 2.1e-3; the first is a function of three
// coordinates.
TEST(RadialEstimator, GainsForLongBodies) {
  for (const auto& [shape, bound] : {std::pair{"capsule:64,0.5", 5e-5}, std::pair{"box:64,1,1", 1.5e-4}}) {
    const Body body = parse_shape(shape);
    RadialEstimator estimator(body.body, body.body, {});
    const RandomisedMean found = mean_of(estimator, 12, 1);
    const double truth = average_excluded_volume(body.measures, body.measures);
    EXPECT_LE(std::fabs(found.value - truth), 5.0 * found.std_error + kRadialRounding * truth) << shape;
    EXPECT_LE(found.std_error, bound * truth) << shape;
  }
}

TEST(RadialEstimator, OfAlignedBodiesIsTheirSum) {
  // Also of long ones whose axes are one, and of a long and a flat one.
  for (const auto& [first, second, truth] :
       {std::tuple{"box:1,2,3", "box:3,1,2", 4.0 * 3.0 * 5.0}, std::tuple{"box:9,1,1", "box:9,1,1", 18.0 * 2.0 * 2.0},
        std::tuple{"box:9,1,1", "box:1,9,1", 10.0 * 10.0 * 2.0},
        std::tuple{"box:9,1,1", "box:9,9,1", 18.0 * 10.0 * 2.0},
        std::tuple{"box:9,9,1", "box:1,1,9", 10.0 * 10.0 * 10.0}}) {
    SCOPED_TRACE(std::string(first) + " " + second);
    const ConvexBody a = parse_shape(first).body, b = parse_shape(second).body;
    RadialEstimator boxes(a, b, OrientationLaw::aligned());
    const RandomisedMean sum = mean_of(boxes, 10, 1);
    EXPECT_LE(std::fabs(sum.value - truth), 5.0 * sum.std_error + kRadialRounding * truth);
    EXPECT_LE(sum.std_error, 1e-3 * sum.value);
  }
  // Of like ellipsoids every ray has the same weight: nothing is left to vary but the pick.
  const ConvexBody ellipsoid = parse_shape("ellipsoid:1,2,3").body;
  RadialEstimator ellipsoids(ellipsoid, ellipsoid, OrientationLaw::aligned());
  const RandomisedMean of_ellipsoids = mean_of(ellipsoids, 8, 1);
  EXPECT_NEAR(of_ellipsoids.value, 8.0 * 8.0 * std::numbers::pi, 1e-3 * of_ellipsoids.value);
}

// Off by 3e-4, 37 standard errors, while rays that the packets lost were given their own cube for any pick.
TEST(RadialEstimator, OfALongThinBodyHasNoBias) {
  const Body a = parse_shape("ellipsoid:1,1e-5,1e-5"), b = parse_shape("sphere:1e-6");
  const double truth = average_excluded_volume(a.measures, b.measures);
  RadialEstimator estimator(a.body, b.body, {});
  const RandomisedMean found = mean_of(estimator, 9, 1);
  EXPECT_GT(estimator.n_one_by_one(), 100u);
  EXPECT_LE(std::fabs(found.value - truth), 5.0 * found.std_error);
  EXPECT_LE(found.std_error, 1e-4 * truth);
  EXPECT_LE(found.half_width_sum, 1e-6 * truth * 32.0 * 512.0);
}

// Nearly all rays of round bodies were, while the first three normals were alike: the support point between them was on
// the ray.
TEST(RadialEstimator, LeavesFewRaysOfSymmetricBodiesOpen) {
  const ConvexBody sphere = parse_shape("sphere:0.6").body;
  for (const std::string name : {"sphere:0.6", "needle:2", "capsule:1,0.25", "ellipsoid:0.5,0.5,1.5", "disc:0.7",
                                 "cone:1,0.5", "hemisphere:0.8", "cylinder:1,0.5", "box:1,1,1"}) {
    const ConvexBody body = parse_shape(name).body;
    for (const auto& [a, b] : {std::pair{&sphere, &body}, std::pair{&body, &sphere}, std::pair{&body, &body}}) {
      if (name == "needle:2" && a == b) continue;  // flat, whatever the orientation
      RadialEstimator estimator(*a, *b, {});
      mean_of(estimator, 5, 1);
      EXPECT_LE(estimator.n_one_by_one(), 32u * 32u / 50u) << name;
    }
  }
}

TEST(RadialEstimator, OfAPointIsTheOtherBody) {
  const ConvexBody box = parse_shape("box:1,2,3").body;
  const std::vector<Vec3d> vertices(3, Vec3d{1.0, 2.0, 3.0});
  const ConvexBody point = Polytope(vertices, vertices[0], 0.0);
  RadialEstimator estimator(box, point, {});
  const RandomisedMean found = mean_of(estimator, 9, 1);
  EXPECT_LE(std::fabs(found.value - 6.0), 5.0 * found.std_error);
}

TEST(RadialEstimator, GivesTheSameBitsForEverySetAndBodiesThatNobodyHasAsked) {
  for (const auto& [text_a, text_b] :
       {std::pair{"cylinder:1,0.5", "ellipsoid:1,2,3"}, std::pair{"box:1,2,3", "cone:1,1"}}) {
    std::optional<double> first;
    for (const InstructionSet set : instruction_sets()) {
      const ConvexBody a = parse_shape(text_a).body, b = parse_shape(text_b).body;
      RadialEstimator estimator(a, b, {}, set);
      const double value = mean_of(estimator, 6, 1).value;
      if (!first) first = value;
      EXPECT_EQ(value, *first) << name_of(set);
    }
  }
}

// A body that does not tell its form has no packets.
TEST(RadialEstimator, OfBodiesWithoutPacketsGivesTheSameButForThePicks) {
  class WithoutName : public Ellipsoid {
   public:
    using Ellipsoid::Ellipsoid;
    std::optional<ExactForm> exact_form() const { return std::nullopt; }
  };
  const ConvexBody a = parse_shape("cylinder:1,0.5").body, b = parse_shape("ellipsoid:1,2,3").body;
  const ConvexBody nameless = WithoutName(1.0, 2.0, 3.0);
  RadialEstimator packets(a, b, {}), one_by_one(a, nameless, {});
  const RandomisedMean x = mean_of(packets, 6, 1), y = mean_of(one_by_one, 6, 1);
  EXPECT_EQ(packets.n_one_by_one(), 0u);
  EXPECT_EQ(one_by_one.n_one_by_one(), 32u * 64u);
  EXPECT_NEAR(x.value, y.value, 3.0 * kRadialGap / std::sqrt(32.0 * 64.0) * y.value);
}

}  // namespace
}  // namespace vex
