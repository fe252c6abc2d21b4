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

/// The first 2^m Sobol' points, and nested uniform scramblings of them.
class SobolPoints {
 public:
  static constexpr int kMaxDimension = 64;
  static constexpr int kMaxLog2Points = 24;

  /// `dimension` from 1 to kMaxDimension, `log2_n_points` (m) from 0 to kMaxLog2Points.
  SobolPoints(int dimension, int log2_n_points);

  int dimension() const { return dimension_; }
  std::size_t n_points() const { return std::size_t{1} << log2_n_points_; }

  /// One point of the scrambling that belongs to (seed, replicate): a function of these, of the point's index and of
  /// nothing else. Coordinates are odd multiples of 2^-53: never 0 or 1, each exact.
  ///
  /// Each of the m bits that tell the points apart is flipped by a hash of (seed, replicate, dimension, the bits above
  /// it); the bits below, which are all zero before, become one hash of all m. That is Owen's nested scrambling as far
  /// as a hash is random.
  void scrambled(std::uint64_t seed, std::uint64_t replicate, std::size_t index, std::span<double> coordinates) const;

 private:
  int dimension_;
  int log2_n_points_;
  std::vector<std::uint32_t> leading_bits_;  // the m bits of each coordinate, point by point
};

}  // namespace vex
