#include "shapes/closest_word.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vex {
namespace {

char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::size_t n_edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (small(a[i - 1]) == small(b[j - 1]) ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

}  // namespace

std::string closest_word(std::string_view typed, std::span<const std::string> words) {
  constexpr std::size_t kLongest = 100;  // nobody mistypes that much, and the effort is a product
  std::string closest;
  if (typed.size() > kLongest) return closest;
  std::size_t least = typed.size() / 3 + 1;
  for (const std::string& word : words) {
    if (const std::size_t n = n_edits(typed, word); n < least) {
      least = n;
      closest = word;
    }
  }
  return closest;
}

}  // namespace vex
