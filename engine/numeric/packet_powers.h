// Logarithms, and exponentials of what is not positive, over packets, to within what E32 proves: by their series, whose
// ends are bounded by hand. A kernel that may not fuse operations has the same bits on every machine.
#pragma once

#include "engine/numeric/packet.h"

namespace vex {
namespace VEX_ISA {
inline namespace VEX_ROUNDING {

/// The natural logarithm of a normal number, to within 8.7 u of itself: k ln 2 + 2 artanh(s), s = (m - 1) / (m + 1),
/// |s| < 0.1716, the series of the latter up to s^19.
template <int W>
inline __attribute__((always_inline)) Packet<W> logarithm(const Packet<W>& x) {
  using L = Packet<W>;
  using Bits = PacketBits<W>;
  // The biased exponent behind the point of 2^52.
  const L exponent = from_bits((bits_of(x) >> 52) | Bits(0x4330000000000000u)) - L(0x1p52 + 1023.0);
  const L m = from_bits((bits_of(x) & Bits(0x000fffffffffffffu)) | Bits(0x3ff0000000000000u));  // from 1 to 2
  const PacketMask<W> is_large = m > L(0x1.6a09e667f3bcdp+0);                                   // the root of 2
  const L f = select(is_large, L(0.5) * m, m) - L(1.0);
  const L s = f / (L(2.0) + f), z = s * s, z_sq = z * z;
  // Every other term by itself: half as long a chain of operations that wait for each other.
  L even(1.0 / 19.0), odd(1.0 / 17.0);
  for (const double k : {15.0, 11.0, 7.0, 3.0}) even = L(1.0 / k) + z_sq * even;
  for (const double k : {13.0, 9.0, 5.0}) odd = L(1.0 / k) + z_sq * odd;
  const L series = even + z * odd;
  const L twice = s + s;
  return select(is_large, exponent + L(1.0), exponent) * L(0x1.62e42fefa39efp-1) + (twice + twice * (z * series));
}

/// e^y of y <= 0, to within 4.8 u of itself; of y below -700 that of -700, which is next to nothing. 2^n e^r, |r| <
/// 0.3467, the series of the latter up to r^13.
template <int W>
inline __attribute__((always_inline)) Packet<W> exponential(const Packet<W>& y) {
  using L = Packet<W>;
  const L in_range = larger(y, L(-700.0));
  const L n = nearest_whole(in_range * L(0x1.71547652b82fep+0));
  // The first 32 bits of ln 2, whose product with n is exact, and the rest.
  const L r = (in_range - n * L(0x1.62e42feep-1)) - n * L(0x1.a39ef35793c76p-33);
  const L r_sq = r * r;
  double factorial = 479001600.0;  // 12!
  L even(1.0 / factorial), odd(1.0 / (13.0 * factorial));
  for (int k = 12; k > 0; k -= 2) {
    odd = L(k / factorial) + r_sq * odd;  // 1/(k - 1)!
    factorial /= k * (k - 1);
    even = L(1.0 / factorial) + r_sq * even;
  }
  const L series = even + r * odd;
  const PacketBits<W> exponent = bits_of(n + L(0x1p52 + 1023.0)) << 52;
  return series * from_bits(exponent);
}

}  // namespace VEX_ROUNDING
}  // namespace VEX_ISA
}  // namespace vex
