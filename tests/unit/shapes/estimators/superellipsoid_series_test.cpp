// Superballs and superellipsoids had no measures on normals: no exact average of a law of orientations was known of
// them, and vex_nematic refused them.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "shapes/any_shape.h"
#include "shapes/estimators/axial_average.h"
#include "shapes/estimators/exact_average.h"
#include "shapes/estimators/legendre_average.h"
#include "shapes/estimators/legendre_series.h"
#include "shapes/formula.h"

namespace vex {
namespace {

struct SameBodies {
  std::string superellipsoid, other;
};

/// Which are other bodies of this house: the series of these share nothing with those of superellipsoids.
std::vector<SameBodies> same_bodies() {
  return {{"superellipsoid:1,2,3,1,1", "ellipsoid:1,2,3"},
          {"superellipsoid:1,1,3,1,1", "ellipsoid:1,1,3"},
          {"superellipsoid:2,2,0.1,1,1", "ellipsoid:2,2,0.1"},
          {"superball:0.5,1", "octahedron:1.4142135623730951"},
          {"rounded:0.2,superball:0.5,1", "rounded:0.2,octahedron:1.4142135623730951"}};
}

TEST(SuperellipsoidSeries, OfOtherBodiesIsTheirs) {
  for (const auto& [superellipsoid, other] : same_bodies()) {
    const Body a = parse_shape(superellipsoid), b = parse_shape(other);
    for (const std::size_t degree : {std::size_t{2}, std::size_t{40}, std::size_t{257}}) {
      const LegendreSeries found = excluded_volume_series(a, a, degree).value();
      const LegendreSeries truth = excluded_volume_series(b, b, degree).value();
      for (std::size_t l = 0; l <= degree; ++l) EXPECT_NEAR(found[l], truth[l], 1e-10 * truth[0]) << other << " " << l;
    }
  }
}

TEST(SuperellipsoidSeries, AboutOtherAxesIsThatOfOtherBodies) {
  const Body disc = parse_shape("cylinder:0.5,1");
  for (const auto& [superellipsoid, other] : same_bodies()) {
    for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{1, -2, 2}}) {
      const OrientationLaw law = OrientationLaw::maier_saupe(3.0).about(axis, {0, 0, 1});
      const std::optional<SeriesAverage> truth = legendre_average(parse_shape(other), disc, law);
      const std::optional<SeriesAverage> found = legendre_average(parse_shape(superellipsoid), disc, law);
      ASSERT_TRUE(found.has_value());
      if (!truth) continue;  // of ellipsoids about an axis askew
      EXPECT_NEAR(found->excluded_volume, truth->excluded_volume, 1e-10 * truth->excluded_volume) << other;
    }
  }
}

TEST(SuperellipsoidSeries, BeginsWithTheFormula) {
  const Body other = parse_shape("cone:1,0.5");
  for (const char* text :
       {"superball:2,1", "superball:0.7,3", "superball:20,1", "superball:1000,1", "superball:0.5000001,1",
        "superellipsoid:1,2,3,0.625,6", "superellipsoid:1,1,20,3,1", "superellipsoid:1,1,0.05,1,4",
        "superellipsoid:1e30,2e30,1e30,2,3", "superellipsoid:1,1,1,0.5,1000", "rounded:0.3,superball:3,1"}) {
    const Body body = parse_shape(text);
    const double truth = average_excluded_volume(body.measures, other.measures);
    EXPECT_NEAR(excluded_volume_series(body, other, 64).value()[0], truth, 1e-10 * truth) << text;
  }
}

TEST(SuperellipsoidSeries, AverageIsThatOfRandomPoints) {
  ExactAverageSettings settings;
  settings.series = false;
  settings.log2_n_points = 10;
  for (const char* text : {"superball:2,1", "superellipsoid:1,2,3,0.7,2", "superellipsoid:1,1,4,1,3",
                           "rounded:0.1,superellipsoid:0.5,1,2,3,0.6"}) {
    const Body a = parse_shape(text), b = parse_shape("box:0.2,1,3");
    const OrientationLaw law = OrientationLaw::maier_saupe(-2.0);
    const ExactAverage points = exact_average(a, b, law, settings);
    const std::optional<SeriesAverage> series = legendre_average(a, b, law);
    ASSERT_TRUE(series.has_value()) << text;
    EXPECT_NEAR(points.excluded_volume, series->excluded_volume, 5.0 * points.error) << text;
    EXPECT_LE(points.error, 1e-3 * series->excluded_volume) << text;
  }
}

TEST(SuperellipsoidSeries, AtAnAngleIsThatOfSpheroids) {
  const Body spheroid = parse_shape("ellipsoid:1,1,3"), found = parse_shape("superellipsoid:1,1,3,1,1"),
             other = parse_shape("cylinder:1,0.5");
  for (const double degrees : {0.0, 25.0, 90.0, 130.0}) {
    const std::optional<SeriesAverage> here = axial_average(found, other, OrientationLaw::angle(degrees));
    const std::optional<SeriesAverage> truth = axial_average(spheroid, other, OrientationLaw::angle(degrees));
    ASSERT_TRUE(here && truth);
    EXPECT_NEAR(here->excluded_volume, truth->excluded_volume, here->error + truth->error) << degrees;
    EXPECT_LE(here->error, 1e-7 * truth->excluded_volume) << degrees;
  }
  EXPECT_FALSE(axial_average(parse_shape("superball:2,1"), other, OrientationLaw::angle(30.0)).has_value());
}

/// A cylinder's rim is the limit, and the angle between the axes all that counts.
TEST(SuperellipsoidSeries, AtAnAngleComesNearToThatOfCylinders) {
  const Body nearly = parse_shape("superellipsoid:0.5,0.5,2,1,1000"), cylinder = parse_shape("cylinder:4,0.5");
  for (const double degrees : {0.0, 45.0, 90.0}) {
    const double truth = axial_average(cylinder, cylinder, OrientationLaw::angle(degrees))->excluded_volume;
    EXPECT_NEAR(axial_average(nearly, nearly, OrientationLaw::angle(degrees)).value().excluded_volume, truth,
                1e-2 * truth)
        << degrees;
  }
}

/// A body a thousand times as wide as thick takes too long, and is left to random points.
TEST(SuperellipsoidSeries, IsNothingWhereItTakesTooLong) {
  const Body coin = parse_shape("superellipsoid:1,3,0.001,4,1.5");
  EXPECT_FALSE(excluded_volume_series(coin, coin, 256).has_value());
}

}  // namespace
}  // namespace vex
