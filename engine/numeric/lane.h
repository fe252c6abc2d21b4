// The lane type: what the steps of the searches, the support mappings and the maps from points to poses are written
// over, so that one source serves one trial, in double or double-double, or a register full of them. What goes from
// step to step is written twice, for one trial and for many (docs/decisions/0002).
//
// Such a step is a template over a lane type L. `double` is the one-lane case and is defined here; a
// packet of W doubles is another, which provides the same names (tests/referees/array_lanes.h is a plain one, and a
// test demands of it bit for bit what `double` gives). A lane type has
//   + - * / and unary minus, each one IEEE operation on each lane, never fused;
//   < <= > >= ==, which give a MaskOf<L>, one truth value a lane;
//   construction from double, which fills every lane;
// and the functions below. Masks are combined by the named functions, because && and || cannot act lane by lane and ~
// of a bool is not its negation.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace vex {

/// Tells of a lane type its mask, its bits as unsigned integers, and how many lanes it has.
template <class L>
struct LaneTraits;

template <>
struct LaneTraits<double> {
  using Mask = bool;
  using Bits = std::uint64_t;
  static constexpr int width = 1;
};

/// How far an operation of this lane type may be off, relative to its result: 2^-53 unless its traits say otherwise.
template <class L>
constexpr double unit_roundoff() {
  if constexpr (requires { LaneTraits<L>::unit_roundoff; }) {
    return LaneTraits<L>::unit_roundoff;
  } else {
    return 0x1p-53;
  }
}

template <class L>
using MaskOf = typename LaneTraits<L>::Mask;

template <class L>
using BitsOf = typename LaneTraits<L>::Bits;

// --- masks of the one-lane case
inline bool both(bool a, bool b) { return a && b; }
inline bool either(bool a, bool b) { return a || b; }
inline bool but_not(bool a, bool b) { return a && !b; }
inline bool negation(bool a) { return !a; }
inline bool any(bool a) { return a; }
inline bool all(bool a) { return a; }

// --- arithmetic of the one-lane case
inline double select(bool condition, double if_true, double if_false) { return condition ? if_true : if_false; }
/// By the sign bit, that of a zero too.
inline double select_by_sign(double sign, double if_set, double otherwise) {
  return std::signbit(sign) ? if_set : otherwise;
}
/// The same as `select`, without a jump: for conditions that nothing foretells. Of one-lane types only, for packets
/// never jump.
inline std::uint64_t blend(bool condition, std::uint64_t if_true, std::uint64_t if_false) {
  return if_false ^ ((if_true ^ if_false) & (std::uint64_t{0} - std::uint64_t{condition}));
}
/// In vector registers, where the numbers are: to have them moved to others and back takes longer than the choice.
inline double blend(bool condition, double if_true, double if_false) {
  typedef double Pair __attribute__((vector_size(16)));
  typedef std::int64_t Bits __attribute__((vector_size(16)));
  const std::int64_t all = -std::int64_t{condition};
  const Bits chosen = {all, all};
  const Bits yes = std::bit_cast<Bits>(Pair{if_true, if_true}), no = std::bit_cast<Bits>(Pair{if_false, if_false});
  return std::bit_cast<Pair>((yes & chosen) | (no & ~chosen))[0];
}
inline double square_root(double x) { return std::sqrt(x); }
inline double absolute(double x) { return std::fabs(x); }
inline double copy_sign(double magnitude, double sign) { return std::copysign(magnitude, sign); }
inline double larger(double a, double b) { return a > b ? a : b; }
inline double smaller(double a, double b) { return a < b ? a : b; }

/// The element of `table` at each lane's index; the indices are whole numbers held in lanes.
inline double gather(const double* table, double index) { return table[static_cast<std::size_t>(index)]; }

inline std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }
inline double from_bits(std::uint64_t bits) { return std::bit_cast<double>(bits); }

/// The nearest whole number, ties to even, for |x| < 2^51: adding 1.5 * 2^52 leaves no room for a fraction.
template <class L>
L nearest_whole(L x) {
  const L magic = L(0x1.8p52);
  return (x + magic) - magic;
}

}  // namespace vex
