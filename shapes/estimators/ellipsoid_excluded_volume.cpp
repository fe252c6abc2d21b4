#include "shapes/estimators/ellipsoid_excluded_volume.h"

#include <Eigen/Eigenvalues>
#include <boost/math/special_functions/ellint_rg.hpp>
#include <numbers>

namespace vex {
namespace {

double determinant_of(const Vec3d& axes) { return axes.x * axes.y * axes.z; }

/// det D_K * 4 pi R_G(squares of the singular values of m), m = D_K^-1 R D_L.
double mixed_volume(const Vec3d& axes_k, const Eigen::Matrix3d& m) {
  const Eigen::Matrix3d square = m * m.transpose();
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(square, Eigen::EigenvaluesOnly).eigenvalues().cwiseMax(0.0);
  return determinant_of(axes_k) * 4.0 * std::numbers::pi * boost::math::ellint_rg(values[0], values[1], values[2]);
}

}  // namespace

double ellipsoid_excluded_volume(const Vec3d& semi_axes_a, const Vec3d& semi_axes_b, const Transformd& rotation) {
  const auto [x, y, z, unused] = rotation;
  Eigen::Matrix3d r;
  r << x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z;
  const Eigen::Vector3d a(semi_axes_a.x, semi_axes_a.y, semi_axes_a.z);
  const Eigen::Vector3d b(semi_axes_b.x, semi_axes_b.y, semi_axes_b.z);
  const Eigen::Matrix3d b_over_a = a.cwiseInverse().asDiagonal() * r * b.asDiagonal();
  const Eigen::Matrix3d a_over_b = b.cwiseInverse().asDiagonal() * r.transpose() * a.asDiagonal();
  return 4.0 / 3.0 * std::numbers::pi * (determinant_of(semi_axes_a) + determinant_of(semi_axes_b)) +
         mixed_volume(semi_axes_a, b_over_a) + mixed_volume(semi_axes_b, a_over_b);
}

}  // namespace vex
