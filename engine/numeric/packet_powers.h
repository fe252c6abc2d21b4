// Logarithms, and exponentials of what is not positive, over packets, to within what E32 proves: by their series, whose
// ends are bounded by hand. A kernel that may not fuse operations has the same bits on every machine.
//
// Each is a long chain of operations that wait for each other, so several are taken side by side, step by step.
#pragma once

#include <array>
#include <cstddef>

#include "engine/numeric/packet.h"

namespace vex {
namespace VEX_ISA {
inline namespace VEX_ROUNDING {

/// The natural logarithms of normal numbers, each to within 8.7 u of itself: k ln 2 + 2 artanh(s), s = (m - 1) /
/// (m + 1), |s| < 0.1716, the series of the latter up to s^19.
template <int W, std::size_t N>
inline __attribute__((always_inline)) std::array<Packet<W>, N> logarithms(const std::array<Packet<W>, N>& x) {
  using L = Packet<W>;
  using Bits = PacketBits<W>;
  std::array<L, N> exponent, s, z, z_sq, even, odd, found;
  for (std::size_t i = 0; i < N; ++i) {
    // The biased exponent behind the point of 2^52.
    const L whole = from_bits((bits_of(x[i]) >> 52) | Bits(0x4330000000000000u)) - L(0x1p52 + 1023.0);
    const L m = from_bits((bits_of(x[i]) & Bits(0x000fffffffffffffu)) | Bits(0x3ff0000000000000u));  // from 1 to 2
    const PacketMask<W> is_large = m > L(0x1.6a09e667f3bcdp+0);                                      // the root of 2
    const L f = select(is_large, L(0.5) * m, m) - L(1.0);
    exponent[i] = select(is_large, whole + L(1.0), whole);
    s[i] = f / (L(2.0) + f);
  }
  for (std::size_t i = 0; i < N; ++i) {
    z[i] = s[i] * s[i];
    z_sq[i] = z[i] * z[i];
    // Every other term by itself: half as long a chain.
    even[i] = L(1.0 / 19.0);
    odd[i] = L(1.0 / 17.0);
  }
  for (const double k : {15.0, 11.0, 7.0, 3.0}) {
    for (std::size_t i = 0; i < N; ++i) {
      even[i] = L(1.0 / k) + z_sq[i] * even[i];
      if (k > 3.0) odd[i] = L(1.0 / (k - 2.0)) + z_sq[i] * odd[i];
    }
  }
  for (std::size_t i = 0; i < N; ++i) {
    const L series = even[i] + z[i] * odd[i], twice = s[i] + s[i];
    found[i] = exponent[i] * L(0x1.62e42fefa39efp-1) + (twice + twice * (z[i] * series));
  }
  return found;
}

/// e^y of each y <= 0, to within 4.8 u of itself; of y below -700 that of -700, which is next to nothing. 2^n e^r, |r|
/// < 0.3467, the series of the latter up to r^13.
template <int W, std::size_t N>
inline __attribute__((always_inline)) std::array<Packet<W>, N> exponentials(const std::array<Packet<W>, N>& y) {
  using L = Packet<W>;
  std::array<L, N> n, r, r_sq, even, odd, found;
  double factorial = 479001600.0;  // 12!
  for (std::size_t i = 0; i < N; ++i) {
    const L in_range = larger(y[i], L(-700.0));
    n[i] = nearest_whole(in_range * L(0x1.71547652b82fep+0));
    // The first 32 bits of ln 2, whose product with n is exact, and the rest.
    r[i] = (in_range - n[i] * L(0x1.62e42feep-1)) - n[i] * L(0x1.a39ef35793c76p-33);
    r_sq[i] = r[i] * r[i];
    even[i] = L(1.0 / factorial);
    odd[i] = L(1.0 / (13.0 * factorial));
  }
  for (int k = 12; k > 0; k -= 2) {
    for (std::size_t i = 0; i < N; ++i) odd[i] = L(k / factorial) + r_sq[i] * odd[i];  // 1/(k - 1)!
    factorial /= k * (k - 1);
    for (std::size_t i = 0; i < N; ++i) even[i] = L(1.0 / factorial) + r_sq[i] * even[i];
  }
  for (std::size_t i = 0; i < N; ++i) {
    const L series = even[i] + r[i] * odd[i];
    const PacketBits<W> exponent = bits_of(n[i] + L(0x1p52 + 1023.0)) << 52;
    found[i] = series * from_bits(exponent);
  }
  return found;
}

template <int W>
inline __attribute__((always_inline)) Packet<W> logarithm(const Packet<W>& x) {
  return logarithms(std::array{x})[0];
}
template <int W>
inline __attribute__((always_inline)) Packet<W> exponential(const Packet<W>& y) {
  return exponentials(std::array{y})[0];
}

}  // namespace VEX_ROUNDING
}  // namespace VEX_ISA
}  // namespace vex
