#include "shapes/estimators/axial_average.h"

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_2.hpp>
#include <cmath>
#include <numbers>

#include "shapes/estimators/ellipsoid_excluded_volume.h"
#include "shapes/estimators/exact_average.h"
#include "shapes/estimators/legendre_series.h"

namespace vex {
namespace {

using std::numbers::pi;

SeriesAverage at_angle(const std::string& a, const std::string& b, double degrees) {
  const std::optional<SeriesAverage> found =
      axial_average(parse_shape(a), parse_shape(b), OrientationLaw::angle(degrees));
  EXPECT_TRUE(found.has_value()) << a << " " << b;
  return found.value_or(SeriesAverage{});
}

/// L. Onsager, Ann. N.Y. Acad. Sci. 51, 627 (1949), equation A13; in a form without differences.
double of_cylinders(double l1, double d1, double l2, double d2, double degrees) {
  const double sin = std::sin(degrees * pi / 180.0), cos = std::fabs(std::cos(degrees * pi / 180.0));
  return pi / 4.0 * (d1 * d2 * (d1 + d2) * sin + d1 * d1 * l1 + d2 * d2 * l2 + (d1 * d1 * l2 + d2 * d2 * l1) * cos) +
         (l1 + l2) * d1 * d2 * boost::math::ellint_2(sin) + (d1 + d2) * l1 * l2 * sin;
}

TEST(AtAnAngle, TwoCylindersExcludeWhatOnsagerFound) {
  for (const double degrees :
       {0.0, 1e-6, 1e-3, 0.1, 1.0, 15.0, 30.0, 45.0, 60.0, 75.0, 89.0, 89.9999, 90.0, 120.0, 180.0}) {
    const double truth = of_cylinders(2.0, 1.0, 0.7, 1.6, degrees);
    const SeriesAverage found = at_angle("cylinder:2,0.5", "cylinder:0.7,0.8", degrees);
    EXPECT_NEAR(found.excluded_volume, truth, found.error) << degrees;
    EXPECT_NEAR(found.excluded_volume, truth, 1e-13 * truth) << degrees;
    EXPECT_LT(found.error, 1e-11 * truth) << degrees;
    // The front door takes it.
    const ExactAverage average =
        exact_average(parse_shape("cylinder:2,0.5"), parse_shape("cylinder:0.7,0.8"), OrientationLaw::angle(degrees));
    EXPECT_EQ(average.excluded_volume, found.excluded_volume);
    EXPECT_EQ(average.error, found.error);
  }
  for (const double ratio : {1e-3, 1.0, 1e3}) {
    const std::string text = "cylinder:" + std::to_string(ratio) + ",0.5";
    const double truth = of_cylinders(ratio, 1.0, ratio, 1.0, 37.0);
    EXPECT_NEAR(at_angle(text, text, 37.0).excluded_volume, truth, 1e-12 * truth) << ratio;
  }
}

TEST(AtAnAngle, CapsulesDiscsAndNeedlesHaveClosedForms) {
  for (const double degrees : {0.0, 20.0, 90.0, 135.0}) {
    const double sin = std::sin(degrees * pi / 180.0), cos = std::fabs(std::cos(degrees * pi / 180.0));
    const double r = 0.4, length = 1.5;
    const double capsules = 32.0 / 3.0 * pi * r * r * r + 8.0 * pi * length * r * r + 4.0 * length * length * r * sin;
    EXPECT_NEAR(at_angle("capsule:1.5,0.4", "capsule:1.5,0.4", degrees).excluded_volume, capsules, 1e-12 * capsules);
    const double discs = of_cylinders(0.0, 2.0, 0.0, 1.0, degrees);
    EXPECT_NEAR(at_angle("disc:1", "disc:0.5", degrees).excluded_volume, discs, 1e-12);
    EXPECT_NEAR(at_angle("disc:0.7", "needle:2", degrees).excluded_volume, pi * 0.49 * 2.0 * cos, 1e-12);
    EXPECT_NEAR(at_angle("needle:1", "needle:2", degrees).excluded_volume, 0.0, 1e-15);
  }
}

TEST(AtAnAngle, SpheroidsHaveTheClosedFormOfEllipsoids) {
  for (const double degrees : {0.0, 10.0, 50.0, 90.0}) {
    const double sin = std::sin(degrees * pi / 180.0), cos = std::cos(degrees * pi / 180.0);
    const Transformd turn{{cos, 0.0, sin}, {0.0, 1.0, 0.0}, {-sin, 0.0, cos}, {}};
    const double truth = ellipsoid_excluded_volume({1.0, 1.0, 3.0}, {2.0, 2.0, 0.5}, turn);
    const SeriesAverage found = at_angle("ellipsoid:1,1,3", "ellipsoid:2,2,0.5", degrees);
    EXPECT_NEAR(found.excluded_volume, truth, found.error + 1e-12 * truth) << degrees;
    EXPECT_LT(found.error, 1e-8 * truth) << degrees;
  }
}

TEST(AtAnAngle, IsTheMeanOverSpinsThatRandomPointsGive) {
  ExactAverageSettings settings;
  settings.series = false;
  settings.largest_cost = 2e7;
  for (const auto& [a, b] : {std::pair{"cone:1,0.5", "hemisphere:0.8"},
                             {"frustum:0.5,0.2,0.9", "cylinder:0.1,1"},
                             {"rounded:0.1,cylinder:1,0.5", "cone:0.2,1"},
                             {"rounded:0.2,ellipsoid:1,1,2", "disc:1"},
                             {"rounded:0.2,ellipsoid:1,1,0.3", "capsule:1,0.5"}}) {
    for (const double degrees : {0.0, 40.0, 90.0, 160.0}) {
      const ExactAverage truth =
          exact_average(parse_shape(a), parse_shape(b), OrientationLaw::angle(degrees), settings);
      const SeriesAverage found = at_angle(a, b, degrees);
      EXPECT_NEAR(found.excluded_volume, truth.excluded_volume, 5.0 * truth.error + found.error)
          << a << " " << b << " " << degrees;
      EXPECT_LT(found.error, 1e-7 * found.excluded_volume) << a << " " << b << " " << degrees;
    }
  }
}

TEST(AtAnAngle, IsTheSumOfTheLegendreSeries) {
  const Body a = parse_shape("rounded:0.5,cone:1,0.5"), b = parse_shape("ellipsoid:1,1,1.5");
  const LegendreSeries series = excluded_volume_series(a, b, 1024).value();
  for (const double degrees : {20.0, 75.0, 110.0}) {
    LegendreSeries polynomials(series.size(), 0.0);
    add_polynomials(1.0, std::cos(degrees * pi / 180.0), &polynomials);
    double sum = 0.0;
    for (std::size_t l = 0; l < series.size(); ++l) sum += series[l] * polynomials[l];
    const double found = axial_average(a, b, OrientationLaw::angle(degrees))->excluded_volume;
    EXPECT_NEAR(sum, found, 1e-6 * found) << degrees;
  }
}

TEST(AtAnAngle, IsNothingForOtherLawsAndBodies) {
  const Body cylinder = parse_shape("cylinder:1,0.5"), box = parse_shape("box:1,1,2"), plate = parse_shape("plate:1,1"),
             triaxial = parse_shape("ellipsoid:1,2,3");
  EXPECT_FALSE(axial_average(cylinder, cylinder, OrientationLaw::isotropic()).has_value());
  for (const Body* const other : {&box, &plate, &triaxial}) {
    EXPECT_FALSE(axial_average(cylinder, *other, OrientationLaw::angle(30.0)).has_value());
    EXPECT_FALSE(axial_average(*other, cylinder, OrientationLaw::angle(30.0)).has_value());
  }
}

}  // namespace
}  // namespace vex
