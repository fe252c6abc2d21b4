// The pose seen from the other body.
#pragma once

#include "engine/numeric/transform.h"

namespace vex {

/// R^T and -R^T t: rounded, so answers agree to within rounding only.
inline Transformd inverse(const Transformd& a_from_b) {
  Transformd b_from_a;
  b_from_a.row_x = {a_from_b.row_x.x, a_from_b.row_y.x, a_from_b.row_z.x};
  b_from_a.row_y = {a_from_b.row_x.y, a_from_b.row_y.y, a_from_b.row_z.y};
  b_from_a.row_z = {a_from_b.row_x.z, a_from_b.row_y.z, a_from_b.row_z.z};
  b_from_a.translation = -a_from_b.direction_to_b(a_from_b.translation);
  return b_from_a;
}

}  // namespace vex
