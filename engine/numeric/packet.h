// W doubles as one lane type, through the compilers' vector extensions: SSE2, AVX2, AVX-512 or NEON registers, whatever
// the file that includes this is compiled for.
//
// Everything is in a namespace of the instruction set (VEX_ISA, given by the build), and so has every template over it
// a name of its own: no inline function that was compiled for one set is ever linked into code for another. A packet is
// one register or several; several hide each other's latency.
#pragma once

#include "engine/numeric/registers.h"
#include "engine/numeric/vec3.h"

// Of one set there are kernels that may fuse operations and kernels that may not, and of two functions of one name the
// linker would keep one: what both take is in a namespace of how they round besides, which the build names.
#ifndef VEX_ROUNDING
#define VEX_ROUNDING unfused
#endif

namespace vex {
namespace VEX_ISA {

template <int W>
inline constexpr std::size_t kParts = static_cast<std::size_t>(W / kRegisterLanes);

/// A truth value a lane.
template <int W>
struct PacketMask : Registers<MaskRegister, kParts<W>> {
  PacketMask() = default;
  explicit PacketMask(bool all) {
    for (MaskRegister& p : this->part) p = static_cast<MaskRegister>(MaskRegister{} - (all ? 1 : 0));
  }
  /// The first n lanes.
  static PacketMask first(std::size_t n) {
    PacketMask m;
#if defined(__AVX512F__)
    const unsigned on = n < std::size_t{W} ? (1u << n) - 1u : ~0u;
    for (std::size_t k = 0; k < kParts<W>; ++k) m.part[k] = static_cast<MaskRegister>(on >> (k * kRegisterLanes));
#else
    alignas(64) static constexpr std::int64_t kOn[32] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                                         -1, -1, -1, -1, -1, -1, -1, -1};
    const std::int64_t* const from = kOn + (16 - (n < 16 ? n : 16));
    for (std::size_t k = 0; k < kParts<W>; ++k) m.part[k] = load_register<MaskRegister>(from + k * kRegisterLanes);
#endif
    static_assert(W <= 16);
    return m;
  }
};

template <int W>
struct PacketBits : Registers<BitsRegister, kParts<W>> {
  PacketBits() = default;
  explicit PacketBits(std::uint64_t all) {
    for (BitsRegister& p : this->part) p = BitsRegister{} + all;
  }
  static PacketBits load(const std::uint64_t* from) {
    PacketBits p;
    for (std::size_t k = 0; k < kParts<W>; ++k) p.part[k] = load_register<BitsRegister>(from + k * kRegisterLanes);
    return p;
  }
  void store(std::uint64_t* to) const {
    for (std::size_t k = 0; k < kParts<W>; ++k) store_register(to + k * kRegisterLanes, this->part[k]);
  }
  /// first, first + 1, ... from lane to lane.
  static PacketBits numbers_from(std::uint64_t first) {
    alignas(64) static constexpr std::uint64_t kNumbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    static_assert(W <= 16);
    PacketBits p(first);
    for (std::size_t k = 0; k < kParts<W>; ++k) p.part[k] += load_register<BitsRegister>(kNumbers + k * kRegisterLanes);
    return p;
  }
};

template <int W>
struct Packet : Registers<Register, kParts<W>> {
  static_assert(W % kRegisterLanes == 0);

  Packet() : Packet(0.0) {}
  explicit Packet(double all) {
    for (Register& p : this->part) p = all - Register{};  // x - 0 is x, the sign of a zero too
  }

  /// W doubles, aligned to themselves only.
  static Packet load(const double* from) {
    Packet p;
    for (std::size_t k = 0; k < kParts<W>; ++k) p.part[k] = load_register<Register>(from + k * kRegisterLanes);
    return p;
  }
  void store(double* to) const {
    for (std::size_t k = 0; k < kParts<W>; ++k) store_register(to + k * kRegisterLanes, this->part[k]);
  }
};

/// f(k) makes part k of the result.
template <class Result, class F>
inline __attribute__((always_inline)) Result each_part(F f) {
  Result r;
  for (std::size_t k = 0; k < sizeof r.part / sizeof r.part[0]; ++k) r.part[k] = f(k);
  return r;
}

#define VEX_PACKET_BINARY(type, result, name, expression)                   \
  template <int W>                                                          \
  result<W> name(const type<W>& a, const type<W>& b) {                      \
    return each_part<result<W>>([&](std::size_t k) { return expression; }); \
  }
VEX_PACKET_BINARY(Packet, Packet, operator+, a.part[k] + b.part[k])
VEX_PACKET_BINARY(Packet, Packet, operator-, a.part[k] - b.part[k])
VEX_PACKET_BINARY(Packet, Packet, operator*, a.part[k] * b.part[k])
VEX_PACKET_BINARY(Packet, Packet, operator/, a.part[k] / b.part[k])
#if defined(__AVX512F__)
#define VEX_PACKET_COMPARISON(sign, predicate) \
  VEX_PACKET_BINARY(                           \
      Packet, PacketMask, operator sign,       \
      _mm512_cmp_pd_mask(reinterpret_cast<__m512d>(a.part[k]), reinterpret_cast<__m512d>(b.part[k]), predicate))
#else
#define VEX_PACKET_COMPARISON(sign, predicate) \
  VEX_PACKET_BINARY(Packet, PacketMask, operator sign, a.part[k] sign b.part[k])
#endif
VEX_PACKET_COMPARISON(<, _CMP_LT_OS)
VEX_PACKET_COMPARISON(<=, _CMP_LE_OS)
VEX_PACKET_COMPARISON(>, _CMP_GT_OS)
VEX_PACKET_COMPARISON(>=, _CMP_GE_OS)
VEX_PACKET_COMPARISON(==, _CMP_EQ_OQ)
#undef VEX_PACKET_COMPARISON
VEX_PACKET_BINARY(PacketMask, PacketMask, both, static_cast<MaskRegister>(a.part[k] & b.part[k]))
VEX_PACKET_BINARY(PacketMask, PacketMask, either, static_cast<MaskRegister>(a.part[k] | b.part[k]))
VEX_PACKET_BINARY(PacketMask, PacketMask, but_not, static_cast<MaskRegister>(a.part[k] & ~b.part[k]))
VEX_PACKET_BINARY(PacketBits, PacketBits, operator+, a.part[k] + b.part[k])
VEX_PACKET_BINARY(PacketBits, PacketBits, operator-, a.part[k] - b.part[k])
VEX_PACKET_BINARY(PacketBits, PacketBits, operator&, a.part[k] & b.part[k])
VEX_PACKET_BINARY(PacketBits, PacketBits, operator|, a.part[k] | b.part[k])
VEX_PACKET_BINARY(PacketBits, PacketBits, operator^, a.part[k] ^ b.part[k])
#undef VEX_PACKET_BINARY

template <int W>
Packet<W> operator-(const Packet<W>& a) {
  return each_part<Packet<W>>([&](std::size_t k) { return -a.part[k]; });
}
template <int W>
PacketMask<W> negation(const PacketMask<W>& a) {
  return each_part<PacketMask<W>>([&](std::size_t k) { return static_cast<MaskRegister>(~a.part[k]); });
}
template <int W>
PacketBits<W> operator>>(const PacketBits<W>& a, int n) {
  return each_part<PacketBits<W>>([&](std::size_t k) { return a.part[k] >> n; });
}
template <int W>
PacketBits<W> operator<<(const PacketBits<W>& a, int n) {
  return each_part<PacketBits<W>>([&](std::size_t k) { return a.part[k] << n; });
}

/// A bit for each lane that is on, the first lane's lowest.
template <int W>
unsigned lanes_on(const PacketMask<W>& a) {
  unsigned on = 0;
  for (std::size_t k = 0; k < kParts<W>; ++k) {
    unsigned of_part = 0;
#if defined(__AVX512F__)
    of_part = a.part[k];
#elif defined(__AVX2__)
    of_part = static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(a.part[k])));
#elif defined(__SSE2__)
    of_part = static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(a.part[k])));
#else
    for (int j = 0; j < kRegisterLanes; ++j) of_part |= a.part[k][j] != 0 ? 1u << j : 0u;
#endif
    on |= of_part << (k * std::size_t{kRegisterLanes});
  }
  return on;
}
template <int W>
bool any(const PacketMask<W>& a) {
  return lanes_on(a) != 0;
}
template <int W>
bool all(const PacketMask<W>& a) {
  return lanes_on(a) == (1u << W) - 1u;
}

template <int W>
Packet<W> select(const PacketMask<W>& m, const Packet<W>& a, const Packet<W>& b) {
#if defined(__AVX512F__)
  return each_part<Packet<W>>([&](std::size_t k) {
    return reinterpret_cast<Register>(
        _mm512_mask_blend_pd(m.part[k], reinterpret_cast<__m512d>(b.part[k]), reinterpret_cast<__m512d>(a.part[k])));
  });
#else
  return each_part<Packet<W>>([&](std::size_t k) { return m.part[k] ? a.part[k] : b.part[k]; });
#endif
}

/// By the sign bit, that of a zero too.
inline Register select_by_sign(Register sign, Register if_set, Register otherwise) {
#if defined(__AVX2__) && !defined(__AVX512F__)
  return reinterpret_cast<Register>(_mm256_blendv_pd(
      reinterpret_cast<__m256d>(otherwise), reinterpret_cast<__m256d>(if_set), reinterpret_cast<__m256d>(sign)));
#elif defined(__AVX512F__)
  return reinterpret_cast<Register>(_mm512_mask_blend_pd(_mm512_movepi64_mask(reinterpret_cast<__m512i>(sign)),
                                                         reinterpret_cast<__m512d>(otherwise),
                                                         reinterpret_cast<__m512d>(if_set)));
#else
  return reinterpret_cast<MaskRegister>(sign) < 0 ? if_set : otherwise;
#endif
}
template <int W>
Packet<W> select_by_sign(const Packet<W>& sign, const Packet<W>& if_set, const Packet<W>& otherwise) {
  return each_part<Packet<W>>(
      [&](std::size_t k) { return select_by_sign(sign.part[k], if_set.part[k], otherwise.part[k]); });
}

inline Register root_of(Register a) {
#if defined(__AVX512F__)
  // The forms with a mask: in those without, g++ 12 warns of a register that they leave undefined on purpose.
  return reinterpret_cast<Register>(_mm512_maskz_sqrt_pd(0xff, reinterpret_cast<__m512d>(a)));
#elif defined(__AVX2__)
  return reinterpret_cast<Register>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(a)));
#elif defined(__SSE2__)
  return reinterpret_cast<Register>(_mm_sqrt_pd(reinterpret_cast<__m128d>(a)));
#else
  for (int j = 0; j < kRegisterLanes; ++j) a[j] = __builtin_sqrt(a[j]);
  return a;
#endif
}
/// a > b ? a : b: b where one is a NaN.
inline Register larger_of(Register a, Register b) {
#if defined(__AVX512F__)
  return reinterpret_cast<Register>(
      _mm512_maskz_max_pd(0xff, reinterpret_cast<__m512d>(a), reinterpret_cast<__m512d>(b)));
#elif defined(__AVX2__)
  return reinterpret_cast<Register>(_mm256_max_pd(reinterpret_cast<__m256d>(a), reinterpret_cast<__m256d>(b)));
#elif defined(__SSE2__)
  return reinterpret_cast<Register>(_mm_max_pd(reinterpret_cast<__m128d>(a), reinterpret_cast<__m128d>(b)));
#else
  return a > b ? a : b;
#endif
}
template <int W>
Packet<W> square_root(const Packet<W>& a) {
  return each_part<Packet<W>>([&](std::size_t k) { return root_of(a.part[k]); });
}

template <int W>
PacketBits<W> bits_of(const Packet<W>& a) {
  return each_part<PacketBits<W>>([&](std::size_t k) { return reinterpret_cast<BitsRegister>(a.part[k]); });
}
template <int W>
PacketBits<W> bits_of(const PacketMask<W>& a) {
#if defined(__AVX512F__)
  return each_part<PacketBits<W>>(
      [&](std::size_t k) { return reinterpret_cast<BitsRegister>(_mm512_movm_epi64(a.part[k])); });
#else
  return each_part<PacketBits<W>>([&](std::size_t k) { return reinterpret_cast<BitsRegister>(a.part[k]); });
#endif
}
/// Of lanes with all bits set, or none.
template <int W>
PacketMask<W> mask_of(const PacketBits<W>& a) {
#if defined(__AVX512F__)
  return each_part<PacketMask<W>>(
      [&](std::size_t k) { return _mm512_movepi64_mask(reinterpret_cast<__m512i>(a.part[k])); });
#else
  return each_part<PacketMask<W>>([&](std::size_t k) { return reinterpret_cast<MaskRegister>(a.part[k]); });
#endif
}
template <int W>
Packet<W> from_bits(const PacketBits<W>& a) {
  return each_part<Packet<W>>([&](std::size_t k) { return reinterpret_cast<Register>(a.part[k]); });
}

/// Of the lower 32 bits of each lane, whatever is above them.
inline BitsRegister product_of_low_words(BitsRegister a, BitsRegister b) {
#if defined(__AVX512F__)
  return reinterpret_cast<BitsRegister>(
      _mm512_maskz_mul_epu32(0xff, reinterpret_cast<__m512i>(a), reinterpret_cast<__m512i>(b)));
#elif defined(__AVX2__)
  return reinterpret_cast<BitsRegister>(_mm256_mul_epu32(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(b)));
#elif defined(__SSE2__)
  return reinterpret_cast<BitsRegister>(_mm_mul_epu32(reinterpret_cast<__m128i>(a), reinterpret_cast<__m128i>(b)));
#else
  return (a & 0xffffffffu) * (b & 0xffffffffu);
#endif
}
template <int W>
PacketBits<W> product_of_low_words(const PacketBits<W>& a, const PacketBits<W>& b) {
  return each_part<PacketBits<W>>([&](std::size_t k) { return product_of_low_words(a.part[k], b.part[k]); });
}
/// For factors below 2^32, as all are in engine/numeric.
template <int W>
PacketBits<W> operator*(const PacketBits<W>& a, const PacketBits<W>& b) {
  return product_of_low_words(a, b);
}

template <int W>
Packet<W> absolute(const Packet<W>& a) {
  return from_bits(bits_of(a) & PacketBits<W>(0x7fffffffffffffffu));
}
template <int W>
Packet<W> copy_sign(const Packet<W>& magnitude, const Packet<W>& sign) {
  return from_bits((bits_of(magnitude) & PacketBits<W>(0x7fffffffffffffffu)) |
                   (bits_of(sign) & PacketBits<W>(0x8000000000000000u)));
}
template <int W>
Packet<W> larger(const Packet<W>& a, const Packet<W>& b) {
  return each_part<Packet<W>>([&](std::size_t k) { return larger_of(a.part[k], b.part[k]); });
}

/// a < b ? a : b: b where one is a NaN.
template <int W>
Packet<W> smaller(const Packet<W>& a, const Packet<W>& b) {
#if defined(__AVX2__) && !defined(__AVX512F__)
  return each_part<Packet<W>>([&](std::size_t k) {
    return reinterpret_cast<Register>(
        _mm256_min_pd(reinterpret_cast<__m256d>(a.part[k]), reinterpret_cast<__m256d>(b.part[k])));
  });
#else
  return select(a < b, a, b);
#endif
}

}  // namespace VEX_ISA

template <int W>
struct LaneTraits<VEX_ISA::Packet<W>> {
  using Mask = VEX_ISA::PacketMask<W>;
  using Bits = VEX_ISA::PacketBits<W>;
  static constexpr int width = W;
};

}  // namespace vex
