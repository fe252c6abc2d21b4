// The measures on normals, held against V, S and M: these come from other formulas.
#include "shapes/normal_measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/normal_integral.h"

namespace vex {
namespace {

class NormalsOfBodies : public testing::TestWithParam<const char*> {
 protected:
  const Body shape_ = parse_shape(GetParam());
  const NormalMeasure area_ = shape_.normals.area();
  const NormalMeasure curvature_ = shape_.normals.mean_curvature();
  const Measures m_ = shape_.measures;

  double height(const Vec3d& n) const { return dot(n, shape_.body.support(n)); }
  /// The heights of a rounded body have the kinks of its core's in the midst of the ball's normals, where quadrature is
  /// slow to converge; of all others they are smooth along each component.
  double quadrature_error() const { return shape_.kind == "rounded" || shape_.kind == "capsule" ? 1e-4 : 1e-12; }
};

TEST_P(NormalsOfBodies, HaveTheSurfaceAndTheMeanCurvatureForMasses) {
  EXPECT_NEAR(area_.total_mass(), m_.surface_area, 1e-14 * m_.surface_area);
  EXPECT_NEAR(curvature_.total_mass(), m_.integrated_mean_curvature, 1e-14 * m_.integrated_mean_curvature);
}

TEST_P(NormalsOfBodies, WeighAsMuchAsTheirMasses) {
  const auto one = [](const Vec3d&) { return 1.0; };
  EXPECT_NEAR(integral_over(area_, one), m_.surface_area, 1e-12 * m_.surface_area);
  EXPECT_NEAR(integral_over(curvature_, one), m_.integrated_mean_curvature, 1e-12 * m_.integrated_mean_curvature);
}

TEST_P(NormalsOfBodies, AreOfLengthOne) {
  for (const NormalMeasure* measure : {&area_, &curvature_}) {
    for (const NormalMeasure::Component& component : measure->components()) {
      for (const double v : {0x1p-52, 0.3, 0.5, 1.0 - 0x1p-52}) {
        for (const double w : {0x1p-52, 0.2, 0.5, 1.0 - 0x1p-52}) {
          EXPECT_NEAR(norm(normal_at(component, v, w).unit_normal), 1.0, 4e-15);
          EXPECT_GE(normal_at(component, v, w).weight, 0.0);
        }
      }
    }
  }
}

TEST_P(NormalsOfBodies, Balance) {
  for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
    const auto along = [&](const Vec3d& n) { return dot(axis, n); };
    EXPECT_NEAR(integral_over(area_, along), 0.0, 1e-12 * m_.surface_area);
    EXPECT_NEAR(integral_over(curvature_, along), 0.0, 1e-12 * m_.integrated_mean_curvature);
  }
}

TEST_P(NormalsOfBodies, GiveTheVolumeAsAThirdOfTheHeights) {
  const double scale = m_.surface_area * shape_.body.circumradius();
  EXPECT_NEAR(integral_over(area_, [&](const Vec3d& n) { return height(n); }) / 3.0, m_.volume,
              quadrature_error() * scale);
}

TEST_P(NormalsOfBodies, GiveTheSurfaceByMinkowskisFormula) {
  const double scale = m_.integrated_mean_curvature * shape_.body.circumradius();
  EXPECT_NEAR(integral_over(curvature_, [&](const Vec3d& n) { return height(n); }), m_.surface_area,
              quadrature_error() * scale);
}

INSTANTIATE_TEST_SUITE_P(Bodies, NormalsOfBodies, testing::ValuesIn(every_test_body()), [](const auto& body) {
  return test_name({body.param, ""});
});
INSTANTIATE_TEST_SUITE_P(RoundedOnes, NormalsOfBodies,
                         testing::Values("rounded:0.1,rounded:0.2,cone:1,0.5", "rounded:0.3,ellipsoid:0.5,1,2",
                                         "rounded:0.2,icosahedron:0.7", "rounded:1,needle:2", "rounded:0.5,disc:2",
                                         "rounded:0.1,capsule:1,0.25"),
                         [](const auto& body) {
                           return test_name({body.param, ""});
                         });

TEST(NormalMeasure, OfARoundedNeedleIsThatOfACapsule) {
  const Body capsule = parse_shape("capsule:2,0.5"), rounded = parse_shape("rounded:0.5,needle:2");
  const auto square_of_z = [](const Vec3d& n) { return n.z * n.z; };
  EXPECT_NEAR(integral_over(capsule.normals.area(), square_of_z), std::numbers::pi / 3.0, 1e-13);
  EXPECT_NEAR(integral_over(rounded.normals.area(), square_of_z), std::numbers::pi / 3.0, 1e-13);
}

TEST(NormalMeasure, OfACylinderIsTheSumOfADiscsAndANeedlesInMeanCurvature) {
  // Mixed volumes are linear in H: 3 V(K, B, L) of the cylinder is the disc's and the needle's together.
  const auto heights_of = [](const char* text) {
    return [body = parse_shape(text).body](const Vec3d& n) { return dot(n, body.support(n)); };
  };
  const auto curvature_of = [](const char* text) { return parse_shape(text).normals.mean_curvature(); };
  const auto other = heights_of("ellipsoid:1,2,3");
  EXPECT_NEAR(integral_over(curvature_of("cylinder:2,0.5"), other),
              integral_over(curvature_of("disc:0.5"), other) + integral_over(curvature_of("needle:2"), other), 1e-12);
}

TEST(NormalMeasure, IsSymmetricInWhatIsWeighedAndWhatWeighs) {
  // 3 V(K, B, L) = 3 V(L, B, K): the heights of one over the other's mean curvature.
  const Body k = parse_shape("ellipsoid:1,2,3"), l = parse_shape("rounded:0.5,cylinder:1,0.7");
  const auto heights = [](const Body& shape) {
    return [&shape](const Vec3d& n) { return dot(n, shape.body.support(n)); };
  };
  const double one = integral_over(k.normals.mean_curvature(), heights(l));
  const double other = integral_over(l.normals.mean_curvature(), heights(k));
  EXPECT_NEAR(one, other, 1e-2 * other);  // the heights of a cylinder have a kink, which no quadrature loves
}

}  // namespace
}  // namespace vex
