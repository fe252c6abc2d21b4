#include "shapes/estimators/ellipsoid_excluded_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/sampling/poses/orientation_law.h"
#include "shapes/ellipsoid.h"
#include "shapes/rounded.h"

namespace vex {
namespace {

// From ten million times as long as thin to ten million times as wide.
TEST(EllipsoidExcludedVolume, OfAnEllipsoidAndABallIsTheParallelBodysVolume) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> decades(-7.0, 0.0), unit;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d axes{std::pow(10.0, decades(random)), std::pow(10.0, decades(random)),
                     i % 3 == 0 ? 1.0 : std::pow(10.0, decades(random))};
    const double r = std::pow(10.0, decades(random));
    const double point[] = {unit(random), unit(random), unit(random)};
    const Transformd turn = OrientationLaw::isotropic().rotation<double>(point);
    const double truth = parallel_body_measures(Ellipsoid(axes.x, axes.y, axes.z).measures(), r).volume;
    EXPECT_NEAR(ellipsoid_excluded_volume(axes, {r, r, r}, turn), truth, 1e-13 * truth);
    EXPECT_NEAR(ellipsoid_excluded_volume({r, r, r}, axes, turn), truth, 1e-13 * truth);
  }
}

TEST(EllipsoidExcludedVolume, OfLikeEllipsoidsIsTheirSums) {
  const Transformd aligned;
  EXPECT_NEAR(ellipsoid_excluded_volume({1, 2, 3}, {1, 2, 3}, aligned), 8.0 * Ellipsoid(1, 2, 3).measures().volume,
              1e-12);
  EXPECT_NEAR(ellipsoid_excluded_volume({1, 2, 3}, {2, 4, 6}, aligned), 27.0 * Ellipsoid(1, 2, 3).measures().volume,
              1e-11);
}

// It had looped for ever.
TEST(EllipsoidExcludedVolume, BeyondDoublesIsRefused) {
  const Transformd aligned;
  for (const double axis : {-1.0, 0.0, std::nan(""), 1e160, 1e300}) {
    EXPECT_THROW(ellipsoid_excluded_volume({axis, 1, 1}, {1, axis, 1}, aligned), InputError) << axis;
  }
  EXPECT_GT(ellipsoid_excluded_volume({1e90, 1e90, 1e90}, {1e90, 1e90, 1e90}, aligned), 1e271);
}

}  // namespace
}  // namespace vex
