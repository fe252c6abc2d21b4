#include "engine/numeric/number_text.h"

#include <array>
#include <charconv>

namespace vex {

std::string shortest_number(double value) {
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), result.ptr};
}

}  // namespace vex
