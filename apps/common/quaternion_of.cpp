#include "apps/common/quaternion_of.h"

#include <cmath>

namespace vex {

std::array<double, 4> quaternion_of(const Transformd& pose) {
  const Vec3d &x = pose.row_x, &y = pose.row_y, &z = pose.row_z;
  const double trace = x.x + y.y + z.z;
  std::array<double, 4> q{};
  if (trace >= x.x && trace >= y.y && trace >= z.z) {
    q = {1.0 + trace, z.y - y.z, x.z - z.x, y.x - x.y};
  } else if (x.x >= y.y && x.x >= z.z) {
    q = {z.y - y.z, 1.0 + 2.0 * x.x - trace, x.y + y.x, x.z + z.x};
  } else if (y.y >= z.z) {
    q = {x.z - z.x, x.y + y.x, 1.0 + 2.0 * y.y - trace, y.z + z.y};
  } else {
    q = {y.x - x.y, x.z + z.x, y.z + z.y, 1.0 + 2.0 * z.z - trace};
  }
  const double length = std::sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3] + q[0] * q[0]);
  for (double& component : q) component /= length;
  return q;
}

}  // namespace vex
