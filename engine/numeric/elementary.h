// sincospi, cbrt and a logarithm from + - * / and square root alone, over lanes.
//
// A trial's pose must be the same bits on every machine, compiler and register width, or the same seed would not give
// the same hits; the C library's functions promise no such thing. Errors are proven in docs/derivations.md: at most 4 u
// for sincospi (E3), 2 u for cbrt (E4) and 8 u for the logarithm (E12), all within 2^-50 relative.
#pragma once

#include "engine/numeric/expect.h"
#include "engine/numeric/lane.h"

namespace vex {

template <class L>
struct SinCos {
  L sin;
  L cos;
};

/// sin(pi x) and cos(pi x) for 0 <= x <= 2, each within 4 u of its true value, relative (E3).
///
/// The argument is reduced exactly: x = q/2 + r with |r| <= 1/4, and the truncated series of sin(pi r) and cos(pi r)
/// follow.
template <class L>
SinCos<L> sincospi(L x) {
  const L shifted = (x + x) + L(0x1.8p52);  // its last bits are those of the nearest whole number, q
  const L r = x - L(0.5) * (shifted - L(0x1.8p52));
  const L y = r * r;
  // (-1)^k pi^(2k+1) / (2k+1)!, rounded to nearest
  L s = L(-0x1.6fadb9f155744p-16);
  s = L(0x1.e8f434d018d63p-12) + y * s;
  s = L(-0x1.e3074fde8871fp-8) + y * s;
  s = L(0x1.50783487ee782p-4) + y * s;
  s = L(-0x1.32d2cce62bd86p-1) + y * s;
  s = L(0x1.466bc6775aae2p+1) + y * s;
  s = L(-0x1.4abbce625be53p+2) + y * s;
  s = L(0x1.921fb54442d18p+1) + y * s;
  s = r * s;
  // (-1)^k pi^(2k) / (2k)!, rounded to nearest
  L c = L(0x1.20c62c2f2d7f5p-18);
  c = L(-0x1.b6e24f44b128fp-14) + y * c;
  c = L(0x1.f9d38a3763cc3p-10) + y * c;
  c = L(-0x1.a6d1f2a204a8cp-6) + y * c;
  c = L(0x1.e1f506891babbp-3) + y * c;
  c = L(-0x1.55d3c7e3cbffap+0) + y * c;
  c = L(0x1.03c1f081b5ac4p+2) + y * c;
  c = L(-0x1.3bd3cc9be45dep+2) + y * c;
  c = L(1.0) + y * c;
  // sin and cos of q/2 half turns: a quarter turn swaps them, and q = 4 is q = 0 again. The lowest bit of q is put
  // where the sign is, and so is the second, of q and of q + 1.
  const BitsOf<L> sign(0x8000000000000000u), q = bits_of(shifted);
  const L quarter = from_bits(q << 63);
  const BitsOf<L> sin_sign = (q << 62) & sign, cos_sign = ((q + BitsOf<L>(1u)) << 62) & sign;
  return {from_bits(bits_of(select_by_sign(quarter, c, s)) ^ sin_sign),
          from_bits(bits_of(select_by_sign(quarter, s, c)) ^ cos_sign)};
}

/// The cube root of a normal x > 0, within 2 u relative (E4).
///
/// A third of the exponent field is a guess within 5 % (Kahan; FreeBSD's s_cbrt.c); each of three Halley steps cubes
/// the error, and the last is written as a small correction, so that only its final addition rounds at full size.
template <class L>
L cube_root(L x) {
  // floor(high / 3) for a 32-bit high word: 0xAAAAAAAB / 2^33 exceeds 1/3 by less than 2^-33 / 3 (E4).
  const BitsOf<L> high = bits_of(x) >> 32;
  const BitsOf<L> guess = ((high * BitsOf<L>(0xAAAAAAABu)) >> 33) + BitsOf<L>(715094163u);
  L t = from_bits(guess << 32);
  for (int step = 0; step < 3; ++step) {
    const L cube = t * t * t;
    t = t + t * ((x - cube) / ((cube + cube) + x));
  }
  return t;
}

/// -log(1 - t) for 0 <= t <= 1 - 2^-53, within 8 u relative (E12), also where t is so small that 1 - t rounds to 1.
///
/// 1 - t = x + c with x rounded and c exact; x = 2^k m with m in [sqrt(1/2), sqrt(2)); log m is the series of
/// 2 artanh((m - 1)/(m + 1)), and c adds c/x.
template <class L>
L minus_log_of_complement(L t) {
  const L one = L(1.0);
  const L x = one - t;
  const L c = (one - x) - t;
  // Adding 1 - sqrt(1/2), in units of the last place, carries into the exponent from sqrt(1/2) on.
  const BitsOf<L> bits = bits_of(x);
  const BitsOf<L> exponent = (bits + BitsOf<L>(0x3ff0000000000000u - 0x3fe6a09e667f3bcdu)) >> 52;  // k + 1023
  const L k = from_bits(exponent + BitsOf<L>(0x4330000000000000u)) - L(0x1p52 + 1023.0);
  const L m = from_bits((bits - (exponent << 52)) + BitsOf<L>(0x3ff0000000000000u));
  const L f = m - one;  // exact
  const L s = f / (m + one);
  const L y = s * s;
  L series = L(1.0 / 21.0);
  series = L(1.0 / 19.0) + y * series;
  series = L(1.0 / 17.0) + y * series;
  series = L(1.0 / 15.0) + y * series;
  series = L(1.0 / 13.0) + y * series;
  series = L(1.0 / 11.0) + y * series;
  series = L(1.0 / 9.0) + y * series;
  series = L(1.0 / 7.0) + y * series;
  series = L(1.0 / 5.0) + y * series;
  series = L(1.0 / 3.0) + y * series;
  const L log_m = (s + s) + (s + s) * (y * series);
  return -(L(0x1.62e42fefa39efp-1) * k + (log_m + c / x));
}

}  // namespace vex
