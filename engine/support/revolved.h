// The support mappings that bodies of revolution about the z axis are made of, for numbers and for packets. They are
// inlined: kernels for different sets of instructions share no code.
#pragma once

#include "engine/numeric/vec3.h"

namespace vex {

/// radius * dir / |dir|; the zero vector where dir is zero.
template <class L>
[[gnu::always_inline]] inline Vec3<L> ball_support(const L& radius, const Vec3<L>& dir) {
  const L length = norm(dir);
  return (radius / select(length > L(0.0), length, L(1.0))) * dir;
}

/// radius * (d_x, d_y, 0) / |(d_x, d_y)|: the rim of a disc about the z axis. The middle of the disc where dir has no
/// such part; below 2^-450 its square would lose its digits, and the middle is as good as the rim to 2^-450 of radius.
template <class L>
[[gnu::always_inline]] inline Vec3<L> disc_support(double radius, const Vec3<L>& dir) {
  const L across_sq = dir.x * dir.x + dir.y * dir.y;
  const MaskOf<L> has_rim = across_sq > L(0x1p-900);
  const L across = square_root(select(has_rim, across_sq, L(1.0)));
  // Of a large radius, over what may be small, the quotient is no number.
  const bool is_large = radius > 0x1p500;
  const L scale = select(has_rim, is_large ? L(1.0) : L(radius), L(0.0)) / across;
  const Vec3<L> rim{scale * dir.x, scale * dir.y, L(0.0)};
  return is_large ? L(radius) * rim : rim;
}

}  // namespace vex
