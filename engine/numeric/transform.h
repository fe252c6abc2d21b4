// The pose of one body in another's frame.
#pragma once

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

}  // namespace vex
