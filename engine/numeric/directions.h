// Unit vectors, and axes that lean least towards them.
#pragma once

#include "engine/numeric/vec3.h"

namespace vex {

/// Where a search may begin in any direction.
inline constexpr Vec3d kAnyUnitVector{0.6, 0.0, 0.8};

/// dir / |dir|, of any length but 0, to within 4 u.
template <class L>
Vec3<L> unit_along(const Vec3<L>& dir) {
  const Vec3<L> scaled = scaled_to_unit_exponent(dir);
  return (L(1.0) / norm(scaled)) * scaled;
}

/// The coordinate axis along which v is shortest, the first of several. One lane only.
template <class L>
Vec3<L> least_axis(const Vec3<L>& v) {
  const L x = absolute(v.x), y = absolute(v.y), z = absolute(v.z);
  if (x <= y && x <= z) return {L(1.0), L(0.0), L(0.0)};
  return y <= z ? Vec3<L>{L(0.0), L(1.0), L(0.0)} : Vec3<L>{L(0.0), L(0.0), L(1.0)};
}

}  // namespace vex
