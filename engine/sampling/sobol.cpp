#include "engine/sampling/sobol.h"

#include <boost/random/sobol.hpp>

#include "engine/numeric/expect.h"

namespace vex {
namespace {

// The last step of SplitMix64 (D. Stafford's thirteenth mixer): a bijection that lets each bit depend on all.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

constexpr std::uint64_t kOddStep = 0x9e3779b97f4a7c15u;

std::uint64_t chained(std::uint64_t key, std::uint64_t x) { return mixed(key + kOddStep * (x + 1)); }

}  // namespace

SobolPoints::SobolPoints(int dimension, int log2_n_points) : dimension_(dimension), log2_n_points_(log2_n_points) {
  VEX_EXPECT(dimension >= 1 && dimension <= kMaxDimension);
  VEX_EXPECT(log2_n_points >= 0 && log2_n_points <= kMaxLog2Points);
  constexpr unsigned kBits = 32;
  const auto n_coordinates = static_cast<std::size_t>(dimension);
  leading_bits_.reserve(n_points() * n_coordinates);
  leading_bits_.assign(n_coordinates, 0);  // the first point, which Boost leaves out
  boost::random::sobol_engine<std::uint64_t, kBits> sequence(n_coordinates);
  while (leading_bits_.size() < n_points() * n_coordinates) {
    // In Gray code's order, another order of the same 2^m points; below their m leading bits there is nothing.
    const std::uint64_t bits = sequence();
    leading_bits_.push_back(static_cast<std::uint32_t>(bits >> (kBits - static_cast<unsigned>(log2_n_points))));
  }
}

void SobolPoints::scrambled(std::uint64_t seed, std::uint64_t replicate, std::size_t index,
                            std::span<double> coordinates) const {
  VEX_EXPECT(coordinates.size() == static_cast<std::size_t>(dimension_) && index < n_points());
  const std::uint64_t replicate_key = chained(mixed(seed), replicate);
  const std::uint32_t* const bits = &leading_bits_[index * coordinates.size()];
  for (std::size_t d = 0; d < coordinates.size(); ++d) {
    const std::uint64_t key = chained(replicate_key, d);
    // `node` is a one and then the bits so far: every node of the binary tree has its own number, the root has 1.
    std::uint64_t node = 1;
    std::uint64_t flips = 0;
    for (int k = log2_n_points_ - 1; k >= 0; --k) {
      flips = (flips << 1) | (chained(key, node) >> 63);
      node = (node << 1) | ((bits[d] >> k) & 1u);
    }
    const int n_lower_bits = 52 - log2_n_points_;
    const std::uint64_t upper = bits[d] ^ flips;
    const std::uint64_t lower = chained(key, node) >> (64 - n_lower_bits);
    coordinates[d] = (static_cast<double>((upper << n_lower_bits) | lower) + 0.5) * 0x1p-52;
  }
}

}  // namespace vex
