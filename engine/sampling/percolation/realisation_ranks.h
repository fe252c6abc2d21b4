// Realisations that other ranks make (internal): what they are given, and what they hand in.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/sampling/percolation/realisation.h"
#include "engine/sampling/ranks.h"

namespace vex {

/// Realisations of a size as trials of ranks: those of one size have numbers of their own.
constexpr std::uint64_t number_of_realisation(std::uint32_t size, std::uint32_t realisation) {
  return std::uint64_t{size} << 32 | realisation;
}

/// What a block brought: of one size, realisations first, first + 1, ...
struct MadeRealisations {
  std::uint32_t size = 0, first = 0;
  std::vector<WrappingNumbers> numbers;
  PercolationCounts counts;  // of all of them
};
std::string made_text(const MadeRealisations& made);
/// Throws InputError for a text that is none.
MadeRealisations read_made(std::string_view text);

}  // namespace vex
