#include "apps/common/text.h"

#include <algorithm>
#include <cstdio>

namespace vex {

namespace {

// Bytes of the character of UTF-8 that the text begins with; 0 where it begins with none (Unicode 15.0, table 3-7).
std::size_t size_of_character(std::string_view text) {
  const auto byte = [text](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
  const auto follows = [byte](std::size_t k) { return byte(k) >= 0x80 && byte(k) <= 0xbf; };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  if (first < 0xc2 || first > 0xf4 || !follows(1)) return 0;
  if (first < 0xe0) return 2;
  // Neither longer than needed, nor a surrogate, nor beyond U+10FFFF.
  if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f)) return 0;
  if ((first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f)) return 0;
  if (!follows(2)) return 0;
  if (first < 0xf0) return 3;
  return follows(3) ? 4 : 0;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t size = size_of_character(text);
    const auto byte = static_cast<unsigned char>(text.front());
    if (size == 0) {
      result += "\xef\xbf\xbd";  // U+FFFD, as JSON has it
    } else if (size > 1 || (byte >= 0x20 && byte != 0x7f)) {
      result += text.substr(0, size);
    } else {
      char code[8];
      std::snprintf(code, sizeof code, "\\x%02x", byte);
      result += code;
    }
    text.remove_prefix(std::max<std::size_t>(1, size));
  }
  return result;
}

std::string_view first_bytes(std::string_view text, std::size_t n_most) {
  std::size_t n = 0;
  while (n < text.size()) {
    const std::size_t next = n + std::max<std::size_t>(1, size_of_character(text.substr(n)));
    if (next > n_most) break;
    n = next;
  }
  return text.substr(0, n);
}

std::string table_text(const std::vector<std::vector<std::string>>& lines, std::size_t gap) {
  std::vector<std::size_t> widths;
  for (const std::vector<std::string>& line : lines) {
    widths.resize(std::max(widths.size(), line.size()), 0);
    for (std::size_t k = 0; k < line.size(); ++k) widths[k] = std::max(widths[k], line[k].size());
  }
  std::string text;
  for (const std::vector<std::string>& line : lines) {
    std::string row = "  ";
    for (std::size_t k = 0; k < line.size(); ++k) {
      const std::string padding(widths[k] - line[k].size(), ' ');
      row += k == 0 ? line[k] + padding : std::string(gap, ' ') + padding + line[k];
    }
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + "\n";
  }
  return text;
}

std::string plural(std::uint64_t n, const std::string& one, const std::string& many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

}  // namespace vex
