// A plain packet of W doubles: the second lane type, by which tests hold every algorithm to its promise that one source
// serves any width. Nothing here is fast.
#pragma once

#include <array>
#include <cstdint>

#include "engine/numeric/transform.h"

namespace vex {

template <int W>
struct ArrayMask {
  std::array<bool, std::size_t{W}> on{};
  explicit ArrayMask(bool all = false) { on.fill(all); }
};

template <int W>
struct ArrayBits {
  std::array<std::uint64_t, std::size_t{W}> word{};
  explicit ArrayBits(std::uint64_t all = 0) { word.fill(all); }
};

template <int W>
struct ArrayLanes {
  std::array<double, std::size_t{W}> lane{};
  ArrayLanes() = default;
  explicit ArrayLanes(double all) { lane.fill(all); }
};

template <int W>
struct LaneTraits<ArrayLanes<W>> {
  using Mask = ArrayMask<W>;
  using Bits = ArrayBits<W>;
  static constexpr int width = W;
};

namespace array_lanes_detail {
template <class R, int W, class F>
R each(F f) {
  R result;
  for (int k = 0; k < W; ++k) f(result, static_cast<std::size_t>(k));
  return result;
}
}  // namespace array_lanes_detail

#define VEX_LANE_BINARY(op)                                                   \
  template <int W>                                                            \
  ArrayLanes<W> operator op(const ArrayLanes<W>& a, const ArrayLanes<W>& b) { \
    return array_lanes_detail::each<ArrayLanes<W>, W>(                        \
        [&](auto& r, std::size_t k) { r.lane[k] = a.lane[k] op b.lane[k]; }); \
  }
VEX_LANE_BINARY(+)
VEX_LANE_BINARY(-)
VEX_LANE_BINARY(*)
VEX_LANE_BINARY(/)
#undef VEX_LANE_BINARY

#define VEX_LANE_COMPARE(op)                                                 \
  template <int W>                                                           \
  ArrayMask<W> operator op(const ArrayLanes<W>& a, const ArrayLanes<W>& b) { \
    return array_lanes_detail::each<ArrayMask<W>, W>(                        \
        [&](auto& r, std::size_t k) { r.on[k] = a.lane[k] op b.lane[k]; });  \
  }
VEX_LANE_COMPARE(<)
VEX_LANE_COMPARE(<=)
VEX_LANE_COMPARE(>)
VEX_LANE_COMPARE(>=)
VEX_LANE_COMPARE(==)
#undef VEX_LANE_COMPARE

template <int W>
ArrayLanes<W> operator-(const ArrayLanes<W>& a) {
  return array_lanes_detail::each<ArrayLanes<W>, W>([&](auto& r, std::size_t k) { r.lane[k] = -a.lane[k]; });
}

#define VEX_MASK_FUNCTION(name, expression)                                                                  \
  template <int W>                                                                                           \
  ArrayMask<W> name(const ArrayMask<W>& a, const ArrayMask<W>& b) {                                          \
    return array_lanes_detail::each<ArrayMask<W>, W>([&](auto& r, std::size_t k) { r.on[k] = expression; }); \
  }
VEX_MASK_FUNCTION(both, a.on[k] && b.on[k])
VEX_MASK_FUNCTION(either, a.on[k] || b.on[k])
VEX_MASK_FUNCTION(but_not, a.on[k] && !b.on[k])
#undef VEX_MASK_FUNCTION

template <int W>
ArrayMask<W> negation(const ArrayMask<W>& a) {
  return array_lanes_detail::each<ArrayMask<W>, W>([&](auto& r, std::size_t k) { r.on[k] = !a.on[k]; });
}
template <int W>
bool any(const ArrayMask<W>& a) {
  for (const bool on : a.on) {
    if (on) return true;
  }
  return false;
}
template <int W>
bool all(const ArrayMask<W>& a) {
  return !any(negation(a));
}

template <int W>
ArrayLanes<W> select(const ArrayMask<W>& m, const ArrayLanes<W>& a, const ArrayLanes<W>& b) {
  return array_lanes_detail::each<ArrayLanes<W>, W>(
      [&](auto& r, std::size_t k) { r.lane[k] = m.on[k] ? a.lane[k] : b.lane[k]; });
}
template <int W>
ArrayLanes<W> select_by_sign(const ArrayLanes<W>& sign, const ArrayLanes<W>& a, const ArrayLanes<W>& b) {
  return array_lanes_detail::each<ArrayLanes<W>, W>(
      [&](auto& r, std::size_t k) { r.lane[k] = select_by_sign(sign.lane[k], a.lane[k], b.lane[k]); });
}
template <int W>
ArrayLanes<W> square_root(const ArrayLanes<W>& a) {
  return array_lanes_detail::each<ArrayLanes<W>, W>([&](auto& r, std::size_t k) { r.lane[k] = std::sqrt(a.lane[k]); });
}
template <int W>
ArrayLanes<W> absolute(const ArrayLanes<W>& a) {
  return array_lanes_detail::each<ArrayLanes<W>, W>([&](auto& r, std::size_t k) { r.lane[k] = std::fabs(a.lane[k]); });
}
template <int W>
ArrayLanes<W> larger(const ArrayLanes<W>& a, const ArrayLanes<W>& b) {
  return array_lanes_detail::each<ArrayLanes<W>, W>(
      [&](auto& r, std::size_t k) { r.lane[k] = larger(a.lane[k], b.lane[k]); });
}
template <int W>
ArrayLanes<W> copy_sign(const ArrayLanes<W>& a, const ArrayLanes<W>& b) {
  return array_lanes_detail::each<ArrayLanes<W>, W>(
      [&](auto& r, std::size_t k) { r.lane[k] = std::copysign(a.lane[k], b.lane[k]); });
}
template <int W>
ArrayLanes<W> gather(const double* table, const ArrayLanes<W>& index) {
  return array_lanes_detail::each<ArrayLanes<W>, W>(
      [&](auto& r, std::size_t k) { r.lane[k] = table[static_cast<std::size_t>(index.lane[k])]; });
}

template <int W>
ArrayBits<W> bits_of(const ArrayLanes<W>& a) {
  return array_lanes_detail::each<ArrayBits<W>, W>([&](auto& r, std::size_t k) { r.word[k] = bits_of(a.lane[k]); });
}
template <int W>
ArrayLanes<W> from_bits(const ArrayBits<W>& a) {
  return array_lanes_detail::each<ArrayLanes<W>, W>([&](auto& r, std::size_t k) { r.lane[k] = from_bits(a.word[k]); });
}
template <int W>
ArrayBits<W> operator>>(const ArrayBits<W>& a, int n) {
  return array_lanes_detail::each<ArrayBits<W>, W>([&](auto& r, std::size_t k) { r.word[k] = a.word[k] >> n; });
}
template <int W>
ArrayBits<W> operator<<(const ArrayBits<W>& a, int n) {
  return array_lanes_detail::each<ArrayBits<W>, W>([&](auto& r, std::size_t k) { r.word[k] = a.word[k] << n; });
}
template <int W>
ArrayBits<W> operator*(const ArrayBits<W>& a, const ArrayBits<W>& b) {
  return array_lanes_detail::each<ArrayBits<W>, W>([&](auto& r, std::size_t k) { r.word[k] = a.word[k] * b.word[k]; });
}
template <int W>
ArrayBits<W> operator-(const ArrayBits<W>& a, const ArrayBits<W>& b) {
  return array_lanes_detail::each<ArrayBits<W>, W>([&](auto& r, std::size_t k) { r.word[k] = a.word[k] - b.word[k]; });
}
template <int W>
ArrayBits<W> operator+(const ArrayBits<W>& a, const ArrayBits<W>& b) {
  return array_lanes_detail::each<ArrayBits<W>, W>([&](auto& r, std::size_t k) { r.word[k] = a.word[k] + b.word[k]; });
}
template <int W>
ArrayBits<W> operator&(const ArrayBits<W>& a, const ArrayBits<W>& b) {
  return array_lanes_detail::each<ArrayBits<W>, W>([&](auto& r, std::size_t k) { r.word[k] = a.word[k] & b.word[k]; });
}
template <int W>
ArrayBits<W> operator^(const ArrayBits<W>& a, const ArrayBits<W>& b) {
  return array_lanes_detail::each<ArrayBits<W>, W>([&](auto& r, std::size_t k) { r.word[k] = a.word[k] ^ b.word[k]; });
}

/// Puts one vector, or one pose, into lane k.
template <int W>
void set_lane(Vec3<ArrayLanes<W>>& wide, std::size_t k, const Vec3d& one) {
  wide.x.lane[k] = one.x;
  wide.y.lane[k] = one.y;
  wide.z.lane[k] = one.z;
}
template <int W>
void set_lane(Transform<ArrayLanes<W>>& wide, std::size_t k, const Transformd& one) {
  set_lane(wide.row_x, k, one.row_x);
  set_lane(wide.row_y, k, one.row_y);
  set_lane(wide.row_z, k, one.row_z);
  set_lane(wide.translation, k, one.translation);
}

}  // namespace vex
