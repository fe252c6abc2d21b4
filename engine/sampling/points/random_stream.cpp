#include "engine/sampling/points/random_stream.h"

#include <Random123/philox.h>

namespace vex {
namespace {

double to_unit_interval(std::uint32_t low, std::uint32_t high) {
  const std::uint64_t bits = (std::uint64_t{high} << 32) | low;
  return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
}

constexpr std::uint32_t low_word(std::uint64_t x) { return static_cast<std::uint32_t>(x & 0xffffffffu); }
constexpr std::uint32_t high_word(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }

}  // namespace

RandomWords random_words(std::uint64_t seed, Stream stream, std::uint64_t index, std::uint32_t block) {
  const r123::Philox4x32::key_type key = {{low_word(seed), high_word(seed)}};
  const r123::Philox4x32::ctr_type counter = {
      {low_word(index), high_word(index), block, static_cast<std::uint32_t>(stream)}};
  const r123::Philox4x32::ctr_type words = r123::Philox4x32()(counter, key);
  return {words[0], words[1], words[2], words[3]};
}

void draw_unit_cube(std::uint64_t seed, Stream stream, std::uint64_t index, std::span<double> coordinates) {
  for (std::size_t k = 0; k < coordinates.size(); k += 2) {
    const RandomWords words = random_words(seed, stream, index, static_cast<std::uint32_t>(k / 2));
    coordinates[k] = to_unit_interval(words[0], words[1]);
    if (k + 1 < coordinates.size()) coordinates[k + 1] = to_unit_interval(words[2], words[3]);
  }
}

}  // namespace vex
