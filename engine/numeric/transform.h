// The pose of one body in another's frame.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "engine/numeric/vec3.h"

namespace vex {

/// Takes coordinates of frame B to coordinates of frame A: p_a = R p_b + t, named `a_from_b`.
///
/// R's rows are r1, r2, r3. R need not be orthonormal to the last bit: it is taken as it is (docs/derivations.md, "What
/// the input is").
template <class L>
struct Transform {
  Vec3<L> row_x{L(1.0), L(0.0), L(0.0)};
  Vec3<L> row_y{L(0.0), L(1.0), L(0.0)};
  Vec3<L> row_z{L(0.0), L(0.0), L(1.0)};
  Vec3<L> translation;

  /// ((r1*x + r2*y) + r3*z) + t, coordinate by coordinate, each operation rounded: this order *is* the placed vertex.
  Vec3<L> operator()(const Vec3<L>& point) const {
    return {dot(row_x, point) + translation.x, dot(row_y, point) + translation.y, dot(row_z, point) + translation.z};
  }

  /// R^T d: a direction of frame A, seen from frame B.
  Vec3<L> direction_to_b(const Vec3<L>& dir) const {
    return {(row_x.x * dir.x + row_y.x * dir.y) + row_z.x * dir.z,
            (row_x.y * dir.x + row_y.y * dir.y) + row_z.y * dir.z,
            (row_x.z * dir.x + row_y.z * dir.y) + row_z.z * dir.z};
  }
};

using Transformd = Transform<double>;

inline Vec3d from_eigen(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Eigen::Vector3d to_eigen(const Vec3d& v) { return {v.x, v.y, v.z}; }

inline Transformd from_eigen(const Eigen::Isometry3d& a_from_b) {
  const Eigen::Matrix3d r = a_from_b.linear();
  return {{r(0, 0), r(0, 1), r(0, 2)},
          {r(1, 0), r(1, 1), r(1, 2)},
          {r(2, 0), r(2, 1), r(2, 2)},
          from_eigen(Eigen::Vector3d(a_from_b.translation()))};
}

}  // namespace vex
