// Packets to and from memory that is not in columns: lanes moved together, lanes that read each at a place of its own.
#pragma once

#include "engine/numeric/packet.h"

namespace vex {
namespace VEX_ISA {

/// Moves the lanes that are on side by side, of as many packets as wanted.
template <int W>
class Compaction {
 public:
  explicit Compaction(const PacketMask<W>& mask) : on_(lanes_on(mask)) {
#if defined(__AVX2__) && !defined(__AVX512F__)
    for (std::size_t k = 0; k < kParts<W>; ++k) {
      order_[k] = _mm256_load_si256(reinterpret_cast<const __m256i*>(kOrders[(on_ >> (4 * k)) & 15u]));
    }
#endif
  }

  int n() const { return __builtin_popcount(on_); }

  /// What is behind the n values is rubbish; room for W must be there.
  void store(double* to, const Packet<W>& a) const { store_lanes(reinterpret_cast<char*>(to), a); }
  void store(std::uint64_t* to, const PacketBits<W>& a) const {
    store_lanes(reinterpret_cast<char*>(to), from_bits(a));
  }

 private:
  void store_lanes(char* to, const Packet<W>& a) const {
    for (std::size_t k = 0; k < kParts<W>; ++k) {
      const unsigned on = (on_ >> (k * std::size_t{kRegisterLanes})) & ((1u << kRegisterLanes) - 1u);
#if defined(__AVX512F__)
      const __m512d moved = _mm512_maskz_compress_pd(static_cast<__mmask8>(on), reinterpret_cast<__m512d>(a.part[k]));
      _mm512_storeu_pd(to, moved);
#elif defined(__AVX2__)
      const __m256 moved = _mm256_permutevar8x32_ps(reinterpret_cast<__m256>(a.part[k]), order_[k]);
      _mm256_storeu_ps(reinterpret_cast<float*>(to), moved);
#else
      char* next = to;
      for (int j = 0; j < kRegisterLanes; ++j) {
        const double lane = a.part[k][j];
        __builtin_memcpy(next, &lane, sizeof lane);
        next += sizeof lane * ((on >> j) & 1u);
      }
#endif
      to += sizeof(double) * static_cast<std::size_t>(__builtin_popcount(on));
    }
  }

  unsigned on_;
#if defined(__AVX2__) && !defined(__AVX512F__)
  // Of the four doubles as eight words: those of the lanes that are on first.
  alignas(32) static constexpr std::int32_t kOrders[16][8] = {
      {0, 0, 0, 0, 0, 0, 0, 0}, {0, 1, 0, 0, 0, 0, 0, 0}, {2, 3, 0, 0, 0, 0, 0, 0}, {0, 1, 2, 3, 0, 0, 0, 0},
      {4, 5, 0, 0, 0, 0, 0, 0}, {0, 1, 4, 5, 0, 0, 0, 0}, {2, 3, 4, 5, 0, 0, 0, 0}, {0, 1, 2, 3, 4, 5, 0, 0},
      {6, 7, 0, 0, 0, 0, 0, 0}, {0, 1, 6, 7, 0, 0, 0, 0}, {2, 3, 6, 7, 0, 0, 0, 0}, {0, 1, 2, 3, 6, 7, 0, 0},
      {4, 5, 6, 7, 0, 0, 0, 0}, {0, 1, 4, 5, 6, 7, 0, 0}, {2, 3, 4, 5, 6, 7, 0, 0}, {0, 1, 2, 3, 4, 5, 6, 7}};
  __m256i order_[kParts<W>];
#endif
};

/// The element of `table` at each lane's index; the indices are whole numbers held in lanes.
template <int W>
Packet<W> gather(const double* table, const Packet<W>& index) {
  return each_part<Packet<W>>([&](std::size_t k) {
    Register r;
    for (int j = 0; j < kRegisterLanes; ++j) r[j] = table[static_cast<std::size_t>(index.part[k][j])];
    return r;
  });
}

template <int W>
PacketBits<W> gather(const std::uint64_t* table, const PacketBits<W>& index) {
  return each_part<PacketBits<W>>([&](std::size_t k) {
    BitsRegister r;
    for (int j = 0; j < kRegisterLanes; ++j) r[j] = table[index.part[k][j]];
    return r;
  });
}

/// Where each lane reads in a table of rows of four doubles.
template <int W>
class RowOfEach {
 public:
  RowOfEach(const double* table, const PacketBits<W>& row) {
    for (std::size_t k = 0; k < kParts<W>; ++k) {
      for (int j = 0; j < kRegisterLanes; ++j)
        at_[k * std::size_t{kRegisterLanes} + static_cast<std::size_t>(j)] = table + 4 * row.part[k][j];
    }
  }

  /// The lanes read W rows that stand one behind the other.
  explicit RowOfEach(const double* first) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(W); ++j) at_[j] = first + 4 * j;
  }
  const double* at(std::size_t lane) const { return at_[lane]; }

  /// The first three numbers of each lane's row, taken `ahead` rows behind where it begins; and the fourth.
  Vec3<Packet<W>> read(std::size_t ahead, Packet<W>* fourth) const {
    Vec3<Packet<W>> v;
    for (std::size_t k = 0; k < kParts<W>; ++k) {
      const double* const* const at = at_ + k * std::size_t{kRegisterLanes};
#if defined(__AVX2__) && !defined(__AVX512F__)
      // Four rows as two times two halves: half the shuffles go to the loads.
      const auto halves = [&](std::size_t low, std::size_t high, std::size_t column) {
        const __m128d first = _mm_loadu_pd(at[low] + 4 * ahead + column);
        return _mm256_insertf128_pd(_mm256_castpd128_pd256(first), _mm_loadu_pd(at[high] + 4 * ahead + column), 1);
      };
      const __m256d xy_02 = halves(0, 2, 0), xy_13 = halves(1, 3, 0);
      v.x.part[k] = reinterpret_cast<Register>(_mm256_unpacklo_pd(xy_02, xy_13));
      v.y.part[k] = reinterpret_cast<Register>(_mm256_unpackhi_pd(xy_02, xy_13));
      const __m256d zw_02 = halves(0, 2, 2), zw_13 = halves(1, 3, 2);
      v.z.part[k] = reinterpret_cast<Register>(_mm256_unpacklo_pd(zw_02, zw_13));
      fourth->part[k] = reinterpret_cast<Register>(_mm256_unpackhi_pd(zw_02, zw_13));
#elif defined(__AVX512F__)
      // Eight rows as four times two, j and j + 4. (gcc 12 takes what the intrinsics do for the use of uninitialised
      // registers.)
      typedef double HalfRegister __attribute__((vector_size(32), aligned(8), may_alias));
      const auto two = [&](std::size_t j) -> Register {
        const auto row = [&](std::size_t lane) { return *reinterpret_cast<const HalfRegister*>(at[lane] + 4 * ahead); };
        return __builtin_shufflevector(row(j), row(j + 4), 0, 1, 2, 3, 4, 5, 6, 7);
      };
      const Register row_04 = two(0), row_15 = two(1), row_26 = two(2), row_37 = two(3);
      const Register xz_01 = __builtin_shufflevector(row_04, row_15, 0, 8, 2, 10, 4, 12, 6, 14);
      const Register yw_01 = __builtin_shufflevector(row_04, row_15, 1, 9, 3, 11, 5, 13, 7, 15);
      const Register xz_23 = __builtin_shufflevector(row_26, row_37, 0, 8, 2, 10, 4, 12, 6, 14);
      const Register yw_23 = __builtin_shufflevector(row_26, row_37, 1, 9, 3, 11, 5, 13, 7, 15);
      v.x.part[k] = __builtin_shufflevector(xz_01, xz_23, 0, 1, 8, 9, 4, 5, 12, 13);
      v.y.part[k] = __builtin_shufflevector(yw_01, yw_23, 0, 1, 8, 9, 4, 5, 12, 13);
      v.z.part[k] = __builtin_shufflevector(xz_01, xz_23, 2, 3, 10, 11, 6, 7, 14, 15);
      fourth->part[k] = __builtin_shufflevector(yw_01, yw_23, 2, 3, 10, 11, 6, 7, 14, 15);
#else
      for (int j = 0; j < kRegisterLanes; ++j) {
        v.x.part[k][j] = at[j][4 * ahead];
        v.y.part[k][j] = at[j][4 * ahead + 1];
        v.z.part[k][j] = at[j][4 * ahead + 2];
        fourth->part[k][j] = at[j][4 * ahead + 3];
      }
#endif
    }
    return v;
  }

 private:
  const double* at_[static_cast<std::size_t>(W)];
};

}  // namespace VEX_ISA
}  // namespace vex
