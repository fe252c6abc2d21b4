#include "engine/sampling/points/sobol.h"

#include <boost/random/sobol.hpp>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/sampling/points/random_stream.h"

namespace vex {

SobolPoints::SobolPoints(int dimension) : dimension_(dimension) {
  if (dimension < 1 || dimension > kMaxDimension) {
    throw UsageError("a sequence of " + std::to_string(dimension) + " dimensions - from 1 to " +
                     std::to_string(kMaxDimension) + " there are points");
  }
  const auto n_coordinates = static_cast<std::size_t>(dimension);
  directions_.resize(n_coordinates * kBits);
  low_.resize(n_coordinates * kLow);
  for (std::size_t k = 0; k < kBits; ++k) {
    // Boost goes in Gray code's order and leaves out the first point: its point 2^k - 1 is the exclusive or of the
    // directions k and k - 1.
    boost::random::sobol_engine<std::uint64_t, kBits> sequence(n_coordinates);
    sequence.seed((std::uint64_t{1} << k) - 1);
    for (std::size_t d = 0; d < n_coordinates; ++d) {
      const std::uint32_t point = reversed(static_cast<std::uint32_t>(sequence()));
      directions_[d * kBits + k] = k == 0 ? point : point ^ directions_[d * kBits + k - 1];
    }
  }
  for (std::size_t d = 0; d < n_coordinates; ++d) {
    for (std::size_t index = 1; index < kLow; ++index) {
      std::size_t top = 0;
      while (index >> (top + 1) != 0) ++top;
      low_[d * kLow + index] = low_[d * kLow + (index ^ std::size_t{1} << top)] ^ directions_[d * kBits + top];
    }
  }
}

SobolPoints::Scrambling SobolPoints::scrambling(std::uint64_t seed, std::uint64_t replicate) const {
  Scrambling keys;
  for (int d = 0; d < dimension_; ++d) {
    const RandomWords words = random_words(seed, Stream::scrambling, replicate, static_cast<std::uint32_t>(d));
    keys.push_back({words[0], words[1] | 1u, std::uint64_t{words[2]} << 20 | words[3] >> 12});
  }
  return keys;
}

void SobolPoints::scrambled(const Scrambling& keys, std::uint64_t index, std::span<double> coordinates) const {
  VEX_EXPECT(coordinates.size() == keys.size() && keys.size() == static_cast<std::size_t>(dimension_));
  VEX_EXPECT(index >> kBits == 0);
  for (std::size_t d = 0; d < coordinates.size(); ++d) {
    const std::uint32_t bits = low_bits(d)[index % kLow] ^ high_bits(d, index / kLow);
    const std::uint64_t upper = reversed(nested(bits, keys[d]));
    coordinates[d] = (static_cast<double>((upper << 20) ^ keys[d].flips) + 0.5) * 0x1p-52;
  }
}

}  // namespace vex
