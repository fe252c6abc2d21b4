#include "apps/common/checksum.h"

#include <zlib.h>

#include <algorithm>

namespace vex {

Checksum::Checksum() : sum_(::crc32(0, nullptr, 0)) {}

void Checksum::add(std::string_view text) {
  constexpr std::size_t kMost = 1u << 30;
  for (; !text.empty(); text.remove_prefix(std::min(kMost, text.size()))) {
    sum_ = ::crc32(sum_, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(std::min(kMost, text.size())));
  }
}

std::string Checksum::digits() const {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (int shift = 28; shift >= 0; shift -= 4) text += kDigits[(sum_ >> shift) & 15u];
  return text;
}

std::string end_line(const Checksum& sum) { return std::string(kEndOfFile) + ", crc32 " + sum.digits(); }

}  // namespace vex
