// Compiled once for each instruction set, with VEX_ISA its namespace: the points of many trials, bit for bit those that
// are made one by one.
#include "engine/sampling/points/philox_packets.h"
#include "engine/sampling/points/trial_points.h"

namespace vex {
namespace VEX_ISA {

__attribute__((flatten)) void random_columns(std::uint64_t seed, Stream stream, std::uint64_t first, int log2_step,
                                             int dimension, std::size_t n, double* columns, std::size_t stride) {
  using Bits = PacketBits<kRegisterLanes>;
  const PhiloxKeys keys(seed);
  for (int block = 0; 2 * block < dimension; ++block) {
    double* const even = columns + static_cast<std::size_t>(2 * block) * stride;
    double* const odd = even + stride;
    for (std::size_t k = 0; k < n; k += kPhiloxAtOnce * kRegisterLanes) {
      PhiloxIndices index;
      for (std::size_t j = 0; j < kPhiloxAtOnce; ++j) {
        index[j] = Bits(first) + (Bits::numbers_from(k + j * kRegisterLanes) << log2_step);
      }
      draw_two_coordinates(keys, stream, static_cast<std::uint32_t>(block), index, even + k, odd + k);
    }
  }
}

__attribute__((flatten)) void sobol_columns(const SobolPoints& points, const SobolPoints::Keys* keys,
                                            std::uint64_t first, std::size_t n, double* columns, std::size_t stride) {
  for (int d = 0; d < points.dimension(); ++d) {
    const SobolPoints::Keys of_d = keys[d];
    const std::uint32_t* const low = points.low_bits(static_cast<std::size_t>(d));
    double* const column = columns + static_cast<std::size_t>(d) * stride;
    for (std::size_t k = 0; k < n;) {
      // To where the higher bits change.
      const std::uint64_t index = first + k;
      const std::uint32_t high = points.high_bits(static_cast<std::size_t>(d), index / SobolPoints::kLow);
      const std::size_t in_block = index % SobolPoints::kLow;
      const std::size_t n_here = n - k < SobolPoints::kLow - in_block ? n - k : SobolPoints::kLow - in_block;
      for (std::size_t j = 0; j < n_here; ++j) {
        const std::uint64_t upper = SobolPoints::reversed(SobolPoints::nested(low[in_block + j] ^ high, of_d));
        const std::uint64_t bits = ((upper << 20) ^ of_d.flips) | 0x3ff0000000000000u;
        column[k + j] = __builtin_bit_cast(double, bits) - (1.0 - 0x1p-53);
      }
      k += n_here;
    }
  }
}

}  // namespace VEX_ISA
}  // namespace vex
