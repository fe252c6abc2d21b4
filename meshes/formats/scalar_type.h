// Numbers as binary files store them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace vex {

enum class ScalarType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// In bytes.
constexpr std::size_t size_of(ScalarType type) {
  switch (type) {
    case ScalarType::int8:
    case ScalarType::uint8: return 1;
    case ScalarType::int16:
    case ScalarType::uint16: return 2;
    case ScalarType::int32:
    case ScalarType::uint32:
    case ScalarType::float32: return 4;
    default: return 8;
  }
}

constexpr bool is_whole(ScalarType type) { return type != ScalarType::float32 && type != ScalarType::float64; }

namespace scalar_type_internal {

/// The bits of a number of N bytes, which may start anywhere.
template <class Bits>
Bits bits_at(const char* at, bool swapped) {
  Bits bits = 0;
  std::memcpy(&bits, at, sizeof(Bits));
  if constexpr (sizeof(Bits) == 2) return swapped ? __builtin_bswap16(bits) : bits;
  if constexpr (sizeof(Bits) == 4) return swapped ? __builtin_bswap32(bits) : bits;
  if constexpr (sizeof(Bits) == 8) return swapped ? __builtin_bswap64(bits) : bits;
  return bits;
}

}  // namespace scalar_type_internal

/// The whole number at `at`; `swapped`: in the byte order that this machine has not. What is too large for an int64
/// becomes the largest one.
inline std::int64_t load_whole(const char* at, ScalarType type, bool swapped) {
  using scalar_type_internal::bits_at;
  switch (type) {
    case ScalarType::int8: return static_cast<std::int8_t>(*at);
    case ScalarType::uint8: return static_cast<std::uint8_t>(*at);
    case ScalarType::int16: return static_cast<std::int16_t>(bits_at<std::uint16_t>(at, swapped));
    case ScalarType::uint16: return bits_at<std::uint16_t>(at, swapped);
    case ScalarType::int32: return static_cast<std::int32_t>(bits_at<std::uint32_t>(at, swapped));
    case ScalarType::uint32: return bits_at<std::uint32_t>(at, swapped);
    case ScalarType::int64: return static_cast<std::int64_t>(bits_at<std::uint64_t>(at, swapped));
    default: {
      constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
      const auto bits = bits_at<std::uint64_t>(at, swapped);
      return static_cast<std::int64_t>(bits < kMost ? bits : kMost);
    }
  }
}

/// The number of any type at `at`, as the nearest double.
inline double load_number(const char* at, ScalarType type, bool swapped) {
  using scalar_type_internal::bits_at;
  switch (type) {
    case ScalarType::float32: return double{std::bit_cast<float>(bits_at<std::uint32_t>(at, swapped))};
    case ScalarType::float64: return std::bit_cast<double>(bits_at<std::uint64_t>(at, swapped));
    case ScalarType::uint64: return static_cast<double>(bits_at<std::uint64_t>(at, swapped));
    default: return static_cast<double>(load_whole(at, type, swapped));
  }
}

}  // namespace vex
