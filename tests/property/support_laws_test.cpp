// What every support mapping owes to the engine, for every body of the list.
#include <gtest/gtest.h>

#include <limits>

#include "shapes/any_shape.h"
#include "shapes/measures.h"
#include "tests/referees/bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

class SupportLaws : public testing::TestWithParam<const char*> {
 protected:
  const Body shape_ = parse_shape(GetParam());
  const ConvexBody& body_ = shape_.body;
  std::mt19937_64 random_{17};
};

TEST_P(SupportLaws, TheSupportPointIsFarthestOfAllSupportPoints) {
  // h(d) >= d . s(e) for every other e, to within the body's own error.
  for (int k = 0; k < 300; ++k) {
    const Vec3d d = random_direction(random_);
    const double h = dot(d, body_.support(d));
    for (int j = 0; j < 30; ++j) {
      const double other = dot(d, body_.support(random_direction(random_)));
      ASSERT_LE(other, h + norm(d) * (2.0 * body_.support_error() + 1e-15 * body_.reach()));
    }
  }
}

TEST_P(SupportLaws, ALengthOfTheDirectionChangesNothing) {
  for (int k = 0; k < 300; ++k) {
    const Vec3d d = random_direction(random_);
    const Vec3d p = body_.support(d);
    for (const double factor : {0x1p-200, 0x1p-40, 0x1p40, 0x1p200}) {
      const Vec3d q = body_.support(factor * d);
      ASSERT_LE(norm(p - q), 4.0 * body_.support_error());
    }
  }
}

TEST_P(SupportLaws, TheBodyLiesBetweenItsBalls) {
  for (int k = 0; k < 3000; ++k) {
    const Vec3d d = random_direction(random_);
    const double error = body_.support_error() + 4e-16 * body_.reach();
    const double from_centre = dot(d, body_.support(d) - body_.centre()) / norm(d);
    ASSERT_LE(norm(body_.support(d) - body_.centre()), body_.circumradius() + error);
    ASSERT_GE(from_centre, body_.inradius() - error);
  }
}

TEST_P(SupportLaws, TheMeanOfTheSupportFunctionIsTheMeanRadius) {
  // M / 4 pi is the mean of h over the sphere: the measures are of the very body that the engine sees. Midpoint rule in
  // the polar angle and the azimuth, bands weighted by their true area: the error falls with the square of the step.
  constexpr int n = 400;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const SinCos<double> polar = sincospi((i + 0.5) / n);
    const double band = sincospi(static_cast<double>(i) / n).cos - sincospi((i + 1.0) / n).cos;
    for (int j = 0; j < 2 * n; ++j) {
      const SinCos<double> azimuth = sincospi((j + 0.5) / n);
      const Vec3d d{polar.sin * azimuth.cos, polar.sin * azimuth.sin, polar.cos};
      sum += band * dot(d, body_.support(d));
    }
  }
  const double mean = sum / (2.0 * 2.0 * n);
  EXPECT_NEAR(mean, shape_.measures.mean_radius(), 1e-5 * shape_.measures.mean_radius());
}

TEST_P(SupportLaws, AZeroDirectionGivesNoNaN) {
  const Vec3d p = body_.support(Vec3d{});
  EXPECT_LE(norm(p - body_.centre()), body_.circumradius());
}

TEST_P(SupportLaws, TheMeasuresObeyTheIsoperimetricInequalities) {
  // Minkowski's: S^2 >= 3 V M, M^2 >= 4 pi S; equality for balls only.
  const Measures& m = shape_.measures;
  EXPECT_GE(m.surface_area * m.surface_area, 3.0 * m.volume * m.integrated_mean_curvature * (1 - 1e-14));
  EXPECT_GE(m.integrated_mean_curvature * m.integrated_mean_curvature,
            4.0 * std::numbers::pi * m.surface_area * (1 - 1e-14));
}

INSTANTIATE_TEST_SUITE_P(Bodies, SupportLaws, testing::ValuesIn(every_test_body()));

}  // namespace
}  // namespace vex
