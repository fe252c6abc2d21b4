// A key for hash tables of what a file holds.
#pragma once

#include <cstdint>
#include <random>

namespace vex {

/// An odd number that no file can foresee: whoever knows how places in a table are computed can write thousands of
/// points that all want the same one, and finding a place then takes as long as there are points. What is found does
/// not depend on it.
inline std::uint64_t hash_key() {
  std::random_device source;
  return (std::uint64_t{source()} << 32U | std::uint64_t{source()}) | 1U;
}

}  // namespace vex
