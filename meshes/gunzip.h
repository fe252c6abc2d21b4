// Unpacks gzip.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "meshes/file_bytes.h"

namespace vex {

/// Nothing is unpacked to more than this many times its size (and a megabyte): text of meshes packs into a twentieth,
/// and binary STL of equal triangles into a hundredth; more is made to exhaust memory.
inline constexpr std::uint64_t kMostInflation = 256;

/// All members of `packed`, one behind another, as gzip unpacks them. `name`: what messages call the file. Throws
/// InputError for anything but whole members with the right check sums and nothing behind them, for what unpacks to
/// more than kMostInflation allows, and for more than the machine has memory for.
FileBytes gunzip(std::string_view packed, const std::string& name);

}  // namespace vex
