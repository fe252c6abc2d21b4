// Sobol' points, scrambled: quasi-random points of the unit cube that give an unbiased mean and an honest error.
//
// Points and direction numbers: I. M. Sobol' (1967) in the form of S. Joe and F. Y. Kuo (SIAM J. Sci. Comput. 30, 2635,
// 2008), from Boost.Random. Scrambling: A. B. Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences" (1995); its
// error for smooth integrands falls like N^-1.5 (Owen, Ann. Statist. 25, 1541, 1997), and never is much above that of
// as many random points. Each scrambled point is uniform in the cube, so the mean over them is unbiased; the spread of
// the means over independent scramblings gives its standard error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vex {

/// The first 2^32 Sobol' points, and nested scramblings of them.
class SobolPoints {
 public:
  static constexpr int kMaxDimension = 64;
  static constexpr int kBits = 32;

  /// `dimension` from 1 to kMaxDimension; any other is a UsageError.
  explicit SobolPoints(int dimension);

  int dimension() const { return dimension_; }

  /// What scrambles one coordinate.
  struct Keys {
    std::uint32_t add, multiply;  // the latter odd
    std::uint64_t flips;          // 52 bits
  };
  /// Of every coordinate, from the words of Philox for (seed, Stream::scrambling, replicate, coordinate).
  using Scrambling = std::vector<Keys>;
  Scrambling scrambling(std::uint64_t seed, std::uint64_t replicate) const;

  /// One point: a function of the scrambling and of the point's index, below 2^32. Coordinates are odd multiples of
  /// 2^-53: never 0 or 1, each exact. The first 2^m points, and each 2^m from a multiple of 2^m on, are a net.
  ///
  /// Of the first 32 bits each is flipped by a hash of those above it, which is Owen's nested scrambling as far as the
  /// hash is random (B. Burley, "Practical hash-based Owen scrambling", J. Comput. Graph. Tech. 9, 4, 2020, after S.
  /// Laine and T. Karras). Then all 52 bits are flipped by a random number of the coordinate's own: that makes each
  /// point exactly uniform, whatever the hash does, and flips keep a net a net.
  void scrambled(const Scrambling& keys, std::uint64_t index, std::span<double> coordinates) const;

  /// For kernels, which do the same for many points. The 32 bits of a coordinate, the first bit the lowest, are
  /// low_bits(d)[index % kLow] ^ high_bits(d, index / kLow).
  static constexpr std::size_t kLow = 256;
  const std::uint32_t* low_bits(std::size_t d) const { return &low_[d * kLow]; }
  std::uint32_t high_bits(std::size_t d, std::uint64_t index_over_low) const {
    std::uint32_t bits = 0;
    for (std::size_t k = d * kBits + kLowBits; index_over_low != 0; ++k, index_over_low >>= 1) {
      bits ^= (index_over_low & 1u) != 0 ? directions_[k] : 0u;
    }
    return bits;
  }
  /// The hash: bits of the sum, product or exclusive or of numbers depend on none above them, and the first bit is the
  /// lowest. Constants: N. Vegdahl, "Building a better LK hash" (2021).
  static std::uint32_t nested(std::uint32_t bits, const Keys& keys) {
    bits += keys.add;
    bits ^= bits * 0x3d20adeau;
    bits *= keys.multiply;
    bits ^= bits * 0x05526c56u;
    bits ^= bits * 0x53a22864u;
    return bits;
  }
  static std::uint32_t reversed(std::uint32_t bits) {
    bits = bits >> 16 | bits << 16;
    bits = (bits >> 8 & 0x00ff00ffu) | (bits & 0x00ff00ffu) << 8;
    bits = (bits >> 4 & 0x0f0f0f0fu) | (bits & 0x0f0f0f0fu) << 4;
    bits = (bits >> 2 & 0x33333333u) | (bits & 0x33333333u) << 2;
    return (bits >> 1 & 0x55555555u) | (bits & 0x55555555u) << 1;
  }

 private:
  static constexpr int kLowBits = 8;

  int dimension_;
  std::vector<std::uint32_t> directions_;  // the first bit the lowest; coordinate by coordinate
  std::vector<std::uint32_t> low_;
};

}  // namespace vex
