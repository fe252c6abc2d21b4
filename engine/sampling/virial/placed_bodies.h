// Where bodies of a cluster are, from each other and in a world.
#pragma once

#include "engine/numeric/transform.h"

namespace vex {

/// a_from_b and b_from_c make a_from_c.
inline Transformd composed(const Transformd& a_from_b, const Transformd& b_from_c) {
  const auto row = [&](const Vec3d& r) { return r.x * b_from_c.row_x + r.y * b_from_c.row_y + r.z * b_from_c.row_z; };
  return {row(a_from_b.row_x), row(a_from_b.row_y), row(a_from_b.row_z), a_from_b(b_from_c.translation)};
}

/// a_from_b of two bodies in one world.
inline Transformd relative(const Transformd& world_from_a, const Transformd& world_from_b) {
  const Transformd &a = world_from_a, &b = world_from_b;
  const auto row = [&](double x, double y, double z) { return x * b.row_x + y * b.row_y + z * b.row_z; };
  return {row(a.row_x.x, a.row_y.x, a.row_z.x), row(a.row_x.y, a.row_y.y, a.row_z.y),
          row(a.row_x.z, a.row_y.z, a.row_z.z), a.direction_to_b(b.translation - a.translation)};
}

}  // namespace vex
