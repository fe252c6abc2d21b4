#include "shapes/estimators/mean_width_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"
#include "shapes/formula.h"
#include "tests/referees/bodies.h"
#include "tests/referees/randomised_mean.h"

namespace vex {
namespace {

// Student's t with 31 degrees of freedom exceeds it once in 50 000 times; seeds are fixed.
constexpr double kMostErrors = 5.0;

class MeanWidthEstimatorOfPairs : public testing::TestWithParam<NamedPair> {};

TEST_P(MeanWidthEstimatorOfPairs, AgreesWithTheFormula) {
  const Body a = parse_shape(GetParam().a), b = parse_shape(GetParam().b);
  const double truth = average_excluded_volume(a.measures, b.measures);
  MeanWidthEstimator estimator(a, b);
  const RandomisedMean found = mean_of(estimator, 7, 11);
  EXPECT_LE(std::fabs(found.value - truth), kMostErrors * found.std_error + estimator.relative_rounding() * truth);
  EXPECT_LE(found.std_error, 1e-4 * truth);
  EXPECT_LE(estimator.relative_rounding(), 1e-12);
  EXPECT_EQ(found.half_width_sum, 0.0);
  EXPECT_LE(found.largest, estimator.scale() * (1.0 + 1e-12));
  EXPECT_LE(estimator.scale(), 4.0 * truth);
}

INSTANTIATE_TEST_SUITE_P(FormlessPairs, MeanWidthEstimatorOfPairs, testing::ValuesIn(formless_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });
INSTANTIATE_TEST_SUITE_P(Pairs, MeanWidthEstimatorOfPairs, testing::ValuesIn(unordered_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });

TEST(MeanWidthEstimator, SeesABiasOfAThousandth) {
  for (const char* text : {"box:1,1,1", "ellipsoid:1,2,3", "box:1000,1,1", "box:1,1,0.001", "tetrahedron:1.3"}) {
    const Body body = parse_shape(text);
    const double truth = average_excluded_volume(body.measures, body.measures);
    MeanWidthEstimator estimator(body, body);
    const RandomisedMean found = mean_of(estimator, 8, 1);
    EXPECT_LE(std::fabs(found.value - truth), kMostErrors * found.std_error) << text;
    EXPECT_GT(std::fabs(1.001 * found.value - truth), kMostErrors * found.std_error) << text;
    EXPECT_GT(std::fabs(0.999 * found.value - truth), kMostErrors * found.std_error) << text;
  }
}

TEST(MeanWidthEstimator, GainsOnRandomPointsAsTheNetGrows) {
  for (const char* text : {"box:1,1,1", "box:64,1,1", "box:1,1,0.01", "ellipsoid:1,2,3", "cone:1,0.5", "needle:2"}) {
    const Body body = parse_shape(text), box = parse_shape("box:1,2,3");
    MeanWidthEstimator estimator(body, box);
    // A slope of -1 or steeper. Random points would give a sixteenth.
    EXPECT_LT(mean_of(estimator, 12, 1).std_error, mean_of(estimator, 4, 1).std_error / 256.0) << text;
  }
}

TEST(MeanWidthEstimator, OfBallsIsTheirsAtEveryPoint) {
  const Body a = parse_shape("sphere:0.6"), b = parse_shape("sphere:1.7");
  const double truth = average_excluded_volume(a.measures, b.measures);
  MeanWidthEstimator estimator(a, b);
  const RandomisedMean found = mean_of(estimator, 5, 1);
  EXPECT_NEAR(found.value, truth, estimator.relative_rounding() * truth);
  EXPECT_LE(found.std_error, 1e-15 * truth);
}

TEST(MeanWidthEstimator, DoesNotLookAtM) {
  Body box = parse_shape("box:1,2,3"), capsule = parse_shape("rounded:0.2,capsule:1,0.25");
  MeanWidthEstimator estimator(box, capsule);
  const RandomisedMean found = mean_of(estimator, 5, 1);
  box.measures.integrated_mean_curvature = capsule.measures.integrated_mean_curvature =
      std::numeric_limits<double>::quiet_NaN();
  box.normals = capsule.normals = {};
  MeanWidthEstimator blind(box, capsule);
  EXPECT_EQ(mean_of(blind, 5, 1).value, found.value);
  EXPECT_EQ(blind.relative_rounding(), estimator.relative_rounding());
  MeanWidthEstimator of_parts(box.body, {box.measures.volume, box.measures.surface_area}, capsule.body,
                              {capsule.measures.volume, capsule.measures.surface_area});
  EXPECT_EQ(mean_of(of_parts, 5, 1).value, found.value);
}

TEST(MeanWidthEstimator, GivesTheSameBitsInAnyBatchAndForOneBodyTwice) {
  for (const char* text : kTestBodies) {
    const Body one = parse_shape(text), other = parse_shape(text);
    MeanWidthEstimator twice(one, one), both(one, other);
    constexpr std::size_t kPoints = 64;
    const std::vector<double> points = scrambled_net(2, 6, 5, 0);
    std::vector<double> together(kPoints);
    twice.evaluate(points, together);
    for (std::size_t k = kPoints; k-- > 0;) {
      const double point[2] = {points[k], points[kPoints + k]};
      double alone = 0.0;
      both.evaluate(point, {&alone, 1});
      EXPECT_EQ(alone, together[k]) << text;
    }
  }
}

TEST(MeanWidthEstimator, IsForUniformRotationsAlone) {
  const Body box = parse_shape("box:1,2,3");
  for (const OrientationLaw& law : {OrientationLaw::aligned(), OrientationLaw::cone(30.0), OrientationLaw::onsager(1.0),
                                    OrientationLaw::fixed(1.0, 2.0, 3.0, 4.0)}) {
    try {
      MeanWidthEstimator estimator(box, box, law);
      ADD_FAILURE() << law.name() << " is taken";
    } catch (const UsageError& refusal) {
      EXPECT_NE(std::string(refusal.what()).find(law.name()), std::string::npos) << refusal.what();
    }
  }
}

}  // namespace
}  // namespace vex
