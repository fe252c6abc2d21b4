// Philox4x32-10 in lanes: the coordinates of random_stream.h, bit for bit, of several packets of trials at once. For
// kernels.
#pragma once

#include <array>
#include <cstdint>

#include "engine/numeric/packet.h"
#include "engine/sampling/points/random_stream.h"

namespace vex {
namespace VEX_ISA {
inline namespace VEX_ROUNDING {

// The keys of the ten rounds, in every lane.
struct PhiloxKeys {
  using Bits = PacketBits<kRegisterLanes>;

  explicit PhiloxKeys(std::uint64_t seed) {
    auto key_0 = static_cast<std::uint32_t>(seed), key_1 = static_cast<std::uint32_t>(seed >> 32);
    for (int round = 0; round < 10; ++round) {
      of_0[round] = Bits(key_0);
      of_1[round] = Bits(key_1);
      key_0 += 0x9E3779B9u;
      key_1 += 0xBB67AE85u;
    }
  }
  Bits of_0[10], of_1[10];
};

// The four words of a block, counter (index, block, stream), as random_stream.cpp has them from Random123. A word is
// the lower half of its lane; what the upper one holds is never read.
struct PhiloxWords {
  PacketBits<kRegisterLanes> w0, w1, w2, w3;
};

// Of several packets at once: a round is a chain of operations that a processor cannot shorten, only fill with others.
constexpr std::size_t kPhiloxAtOnce = 3;
using PhiloxIndices = std::array<PacketBits<kRegisterLanes>, kPhiloxAtOnce>;

inline void philox(const PhiloxKeys& keys, Stream stream, std::uint32_t block, const PhiloxIndices& index,
                   std::array<PhiloxWords, kPhiloxAtOnce>& c) {
  using Bits = PacketBits<kRegisterLanes>;
  for (std::size_t j = 0; j < kPhiloxAtOnce; ++j) {
    c[j] = {index[j], index[j] >> 32, Bits(block), Bits(static_cast<std::uint32_t>(stream))};
  }
  for (int round = 0; round < 10; ++round) {
    for (std::size_t j = 0; j < kPhiloxAtOnce; ++j) {
      const Bits product_0 = product_of_low_words(c[j].w0, Bits(0xD2511F53u));
      const Bits product_1 = product_of_low_words(c[j].w2, Bits(0xCD9E8D57u));
      c[j] = {(product_1 >> 32) ^ (c[j].w1 ^ keys.of_0[round]), product_1,
              (product_0 >> 32) ^ (c[j].w3 ^ keys.of_1[round]), product_0};
    }
  }
}

// The upper 52 of 64 bits, and a half, times 2^-52: exact.
inline Packet<kRegisterLanes> to_unit_interval(const PacketBits<kRegisterLanes>& low,
                                               const PacketBits<kRegisterLanes>& high) {
  using Bits = PacketBits<kRegisterLanes>;
  const Bits upper = ((high << 32) | (low & Bits(0xffffffffu))) >> 12;
  return from_bits(upper | Bits(0x3ff0000000000000u)) - Packet<kRegisterLanes>(1.0 - 0x1p-53);
}

// Coordinates 2 block and 2 block + 1.
inline void draw_two_coordinates(const PhiloxKeys& keys, Stream stream, std::uint32_t block, const PhiloxIndices& index,
                                 double* even, double* odd) {
  std::array<PhiloxWords, kPhiloxAtOnce> words;
  philox(keys, stream, block, index, words);
  for (std::size_t j = 0; j < kPhiloxAtOnce; ++j) {
    to_unit_interval(words[j].w0, words[j].w1).store(even + j * kRegisterLanes);
    to_unit_interval(words[j].w2, words[j].w3).store(odd + j * kRegisterLanes);
  }
}

}  // namespace VEX_ROUNDING
}  // namespace VEX_ISA
}  // namespace vex
