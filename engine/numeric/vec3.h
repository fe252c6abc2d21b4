// Three lanes: a point or a direction for each trial of a packet. No Eigen: these run inside the kernels.
//
// Sums of products are written out in a fixed order, because the exact meaning of a placed vertex (and so of a verdict)
// depends on it: docs/derivations.md, "What the input is".
#pragma once

#include "engine/numeric/lane.h"

namespace vex {

template <class L>
struct Vec3 {
  L x{0.0}, y{0.0}, z{0.0};
};

using Vec3d = Vec3<double>;

template <class L>
Vec3<L> operator+(const Vec3<L>& a, const Vec3<L>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class L>
Vec3<L> operator-(const Vec3<L>& a, const Vec3<L>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class L>
Vec3<L> operator-(const Vec3<L>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class L>
Vec3<L> operator*(const L& s, const Vec3<L>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class L>
L dot(const Vec3<L>& a, const Vec3<L>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class L>
Vec3<L> cross(const Vec3<L>& a, const Vec3<L>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class L>
L norm(const Vec3<L>& a) {
  return square_root(dot(a, a));
}
/// |x| + |y| + |z|, never below the Euclidean norm.
template <class L>
L norm_1(const Vec3<L>& a) {
  return (absolute(a.x) + absolute(a.y)) + absolute(a.z);
}
/// a times the power of two that brings its largest coordinate into [1, 2): exact, and safe from over- and underflow in
/// what follows. Zero stays zero; coordinates from 2^1023 up, infinite ones and NaNs give nothing usable.
template <class L>
Vec3<L> scaled_to_unit_exponent(const Vec3<L>& a) {
  const L largest = larger(absolute(a.x), larger(absolute(a.y), absolute(a.z)));
  const BitsOf<L> exponent = bits_of(largest) >> 52;  // biased; the sign bit is 0
  const L scale = from_bits((BitsOf<L>(2046) - exponent) << 52);
  return {scale * a.x, scale * a.y, scale * a.z};
}
inline bool is_finite(const Vec3d& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }
/// a * 2^exponent: exact but for under- and overflow, however large the exponent is.
inline Vec3d times_power_of_two(const Vec3d& a, int exponent) {
  // A product is rounded once, as ldexp is.
  if (exponent > -1022 && exponent < 1023) return from_bits(static_cast<std::uint64_t>(1023 + exponent) << 52) * a;
  return {std::ldexp(a.x, exponent), std::ldexp(a.y, exponent), std::ldexp(a.z, exponent)};
}
/// The length of one vector whose square may over- or underflow; the bits of `norm` where it does not.
inline double safe_norm(const Vec3d& a) {
  const double length = norm(a);
  if (length > 0x1p-480 && length < 0x1p500) return length;
  const double largest = larger(std::fabs(a.x), larger(std::fabs(a.y), std::fabs(a.z)));
  if (!(largest > 0.0)) return length;
  const int exponent = std::ilogb(largest);
  return std::ldexp(norm(times_power_of_two(a, -exponent)), exponent);
}
template <class L>
Vec3<L> select(const MaskOf<L>& condition, const Vec3<L>& if_true, const Vec3<L>& if_false) {
  return {select(condition, if_true.x, if_false.x), select(condition, if_true.y, if_false.y),
          select(condition, if_true.z, if_false.z)};
}
/// Of one-lane types, without a jump.
template <class L>
Vec3<L> blend(bool condition, const Vec3<L>& if_true, const Vec3<L>& if_false) {
  return {blend(condition, if_true.x, if_false.x), blend(condition, if_true.y, if_false.y),
          blend(condition, if_true.z, if_false.z)};
}
/// The same vector in every lane.
template <class L>
Vec3<L> broadcast(const Vec3d& a) {
  return {L(a.x), L(a.y), L(a.z)};
}

}  // namespace vex
