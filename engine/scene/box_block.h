// Eight axis-aligned boxes side by side, coordinate by coordinate: what a tree of boxes compares at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "engine/scene/aabb.h"

namespace vex {

template <class Real>
struct BoxRegister;
template <>
struct BoxRegister<float> {
  typedef float Values __attribute__((vector_size(16)));
  typedef std::int32_t Mask __attribute__((vector_size(16)));
};
template <>
struct BoxRegister<double> {
  typedef double Values __attribute__((vector_size(16)));
  typedef std::int64_t Mask __attribute__((vector_size(16)));
};

using TwoDoubles = BoxRegister<double>::Values;
typedef float TwoFloats __attribute__((vector_size(8)));

/// Of each a float that is not above it: itself where it is one, else one of the two or three next below. A NaN stays
/// one.
inline TwoFloats rounded_down(const TwoDoubles& x) {
  constexpr double kLargest = static_cast<double>(std::numeric_limits<float>::max());
  const TwoDoubles largest = {kLargest, kLargest};
  const TwoDoubles y = x > largest ? largest : x;
  // Floats next to each other near y differ by at most 2^-23 |y|, or by 2^-149, and what is rounded to nearest is off
  // by half of that: what is less than y by all of it is not rounded to more than y.
  const TwoDoubles less = (y - 0x1p-23 * (y < 0.0 ? -y : y)) - 0x1p-149;
  const TwoDoubles nearest = __builtin_convertvector(__builtin_convertvector(y, TwoFloats), TwoDoubles);
  return __builtin_convertvector(nearest > y ? less : y, TwoFloats);
}

/// The same of one number, for floats; itself for doubles.
template <class Real>
Real rounded_down(double x) {
  if constexpr (sizeof(Real) == sizeof(double)) {
    return x;
  } else {
    return rounded_down(TwoDoubles{x, x})[0];
  }
}
template <class Real>
Real rounded_up(double x) {
  return -rounded_down<Real>(-x);
}

/// An Aabb rounded outwards.
template <class Real>
struct RealBox {
  Real lower[3], upper[3];

  static RealBox around(const Aabb& box) {
    return {{rounded_down<Real>(box.lower.x), rounded_down<Real>(box.lower.y), rounded_down<Real>(box.lower.z)},
            {rounded_up<Real>(box.upper.x), rounded_up<Real>(box.upper.y), rounded_up<Real>(box.upper.z)}};
  }
  /// Rounded outwards.
  RealBox moved(const Vec3d& shift) const {
    const double by[3] = {shift.x, shift.y, shift.z};
    RealBox sum;
    for (int k = 0; k < 3; ++k) {
      const double low = static_cast<double>(lower[k]) + by[k], up = static_cast<double>(upper[k]) + by[k];
      // A sum is off by at most 2^-53 of itself; where it is subnormal it is exact.
      sum.lower[k] = rounded_down<Real>(low - 0x1p-52 * (low < 0.0 ? -low : low));
      sum.upper[k] = rounded_up<Real>(up + 0x1p-52 * (up < 0.0 ? -up : up));
    }
    return sum;
  }
};

/// Boxes 0 ... 7. Those that are missing have NaNs for coordinates: they meet nothing.
template <class Real>
struct alignas(64) BoxBlock {
  static constexpr std::size_t kWidth = 8;

  Real lower[3][kWidth], upper[3][kWidth];

  static BoxBlock empty() {
    BoxBlock block;
    for (std::size_t k = 0; k < kWidth; ++k) block.clear(k);
    return block;
  }
  RealBox<Real> box(std::size_t k) const {
    return {{lower[0][k], lower[1][k], lower[2][k]}, {upper[0][k], upper[1][k], upper[2][k]}};
  }
  void set(std::size_t k, const RealBox<Real>& box) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis][k] = box.lower[axis];
      upper[axis][k] = box.upper[axis];
    }
  }
  void clear(std::size_t k) {
    constexpr Real kNaN = std::numeric_limits<Real>::quiet_NaN();
    set(k, {{kNaN, kNaN, kNaN}, {kNaN, kNaN, kNaN}});
  }
  /// These boxes, rounded outwards.
  void set(const BoxBlock<double>& boxes) {
    if constexpr (sizeof(Real) == sizeof(double)) {
      *this = boxes;
    } else {
      for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t k = 0; k < kWidth; k += 2) {
          TwoDoubles low, up;
          std::memcpy(&low, boxes.lower[axis] + k, sizeof low);
          std::memcpy(&up, boxes.upper[axis] + k, sizeof up);
          const TwoFloats down = rounded_down(low), above = -rounded_down(-up);
          std::memcpy(lower[axis] + k, &down, sizeof down);
          std::memcpy(upper[axis] + k, &above, sizeof above);
        }
      }
    }
  }
  /// Of those that are there: comparisons with a NaN are false, so it is passed over. Without any, lower > upper.
  RealBox<Real> hull() const {
    constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
    constexpr std::size_t kLanes = 4;
    RealBox<Real> hull;
    for (int axis = 0; axis < 3; ++axis) {
      Real low[kLanes] = {kInfinity, kInfinity, kInfinity, kInfinity};
      Real up[kLanes] = {-kInfinity, -kInfinity, -kInfinity, -kInfinity};
      for (std::size_t first = 0; first < kWidth; first += kLanes) {
        for (std::size_t k = 0; k < kLanes; ++k) {
          low[k] = lower[axis][first + k] < low[k] ? lower[axis][first + k] : low[k];
          up[k] = upper[axis][first + k] > up[k] ? upper[axis][first + k] : up[k];
        }
      }
      for (std::size_t half = kLanes / 2; half > 0; half /= 2) {
        for (std::size_t k = 0; k < half; ++k) {
          low[k] = low[k + half] < low[k] ? low[k + half] : low[k];
          up[k] = up[k + half] > up[k] ? up[k + half] : up[k];
        }
      }
      hull.lower[axis] = low[0];
      hull.upper[axis] = up[0];
    }
    return hull;
  }
};

/// Bit k of it: whether lane k is all ones; the others are 0.
inline unsigned bits_of_lanes(const BoxRegister<float>::Mask& mask) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  const BoxRegister<float>::Mask bits = mask & BoxRegister<float>::Mask{1, 2, 4, 8};
  return static_cast<unsigned>((bits[0] | bits[1]) | (bits[2] | bits[3]));
#endif
}
inline unsigned bits_of_lanes(const BoxRegister<double>::Mask& mask) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(mask)));
#else
  return static_cast<unsigned>((mask[0] & 1) | (mask[1] & 2));
#endif
}

/// Bit k of it: whether the box meets box k of the block.
template <class Real>
unsigned meeting_bits(const RealBox<Real>& box, const BoxBlock<Real>& block) {
  using Values = typename BoxRegister<Real>::Values;
  using Mask = typename BoxRegister<Real>::Mask;
  constexpr std::size_t kLanes = sizeof(Values) / sizeof(Real);
  unsigned bits = 0;
  for (std::size_t first = 0; first < BoxBlock<Real>::kWidth; first += kLanes) {
    Mask meets = ~Mask{};
    for (int axis = 0; axis < 3; ++axis) {
      Values lower, upper;
      std::memcpy(&lower, block.lower[axis] + first, sizeof lower);
      std::memcpy(&upper, block.upper[axis] + first, sizeof upper);
      meets &= (lower <= box.upper[axis]) & (upper >= box.lower[axis]);
    }
    bits |= bits_of_lanes(meets) << first;
  }
  return bits;
}

}  // namespace vex
