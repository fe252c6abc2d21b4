#include "apps/common/text.h"

#include <cstdio>

namespace vex {

std::string printable(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f) {
      result += c;
    } else {
      char code[8];
      std::snprintf(code, sizeof code, "\\x%02x", byte);
      result += code;
    }
  }
  return result;
}

}  // namespace vex
