// Poses for tests, by the same inversion map as the driver's but from the test's own generator.
#pragma once

#include <array>
#include <random>

#include "engine/sampling/poses/pose_map.h"

namespace vex {

inline double random_in_unit_interval(std::mt19937_64& random) {
  return (static_cast<double>(random() >> 12) + 0.5) * 0x1p-52;
}

inline Vec3d random_direction(std::mt19937_64& random) {
  while (true) {
    const Vec3d d{2.0 * random_in_unit_interval(random) - 1.0, 2.0 * random_in_unit_interval(random) - 1.0,
                  2.0 * random_in_unit_interval(random) - 1.0};
    if (norm(d) > 0.1 && norm(d) < 1.0) return d;
  }
}

inline Transformd random_rotation(std::mt19937_64& random) {
  const double u = random_in_unit_interval(random), v = random_in_unit_interval(random);
  return uniform_rotation(u, v, random_in_unit_interval(random));
}

/// B's centre anywhere in the domain.
inline Transformd random_pose(std::mt19937_64& random, const Domain& domain, const ConvexBody& b) {
  std::array<double, kPoseDimension> point;
  for (double& u : point) u = random_in_unit_interval(random);
  return pose_at(point, OrientationLaw::isotropic(), domain, b.centre());
}

}  // namespace vex
