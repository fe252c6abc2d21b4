// Sorts what is mostly short: the pairs of one body (internal).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace vex {

/// By insertion where there are few.
template <class T, class ComesBefore>
void sort_short(std::span<T> values, const ComesBefore& comes_before) {
  constexpr std::size_t kFew = 16;
  if (values.size() > kFew) {
    std::sort(values.begin(), values.end(), comes_before);
    return;
  }
  for (std::size_t k = 1; k < values.size(); ++k) {
    const T value = values[k];
    std::size_t to = k;
    for (; to > 0 && comes_before(value, values[to - 1]); --to) values[to] = values[to - 1];
    values[to] = value;
  }
}

}  // namespace vex
