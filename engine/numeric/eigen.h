// Eigen at the public face: callers pass Eigen's types; inside, the kernels see only Vec3 and Transform.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "engine/numeric/transform.h"

namespace vex {

inline Vec3d from_eigen(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

inline Transformd from_eigen(const Eigen::Isometry3d& a_from_b) {
  const Eigen::Matrix3d r = a_from_b.linear();
  return {{r(0, 0), r(0, 1), r(0, 2)},
          {r(1, 0), r(1, 1), r(1, 2)},
          {r(2, 0), r(2, 1), r(2, 2)},
          from_eigen(Eigen::Vector3d(a_from_b.translation()))};
}

}  // namespace vex
