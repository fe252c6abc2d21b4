// How much memory there is to use, so that a mesh which does not fit is refused and not swapped to death.
#pragma once

#include <cstdint>

namespace vex {

inline constexpr std::uint64_t kMiB = std::uint64_t{1} << 20U;

/// Bytes of memory of this machine, or of the container, batch job or other control group of this process where that is
/// less.
std::uint64_t machine_memory();

/// Bytes of address space that this process has now.
std::uint64_t own_address_space();

}  // namespace vex
