// Sorts what is mostly short: the pairs of one body (internal).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

/// Of numbers, no two of them alike. Where they go is as good as random: each goes to where the number of those below
/// it says, by no jump.
inline void sort_short(std::span<std::uint64_t> numbers) {
  constexpr std::size_t kFew = 16;
  const std::size_t n = numbers.size();
  if (n > kFew) {
    std::sort(numbers.begin(), numbers.end());
    return;
  }
  if (n == 2) {
    const std::uint64_t a = numbers[0], b = numbers[1];
    numbers[0] = std::min(a, b);
    numbers[1] = std::max(a, b);
  } else if (n > 2) {
    std::uint64_t copies[kFew];
    std::copy_n(numbers.begin(), n, copies);
    for (std::size_t j = 0; j < n; ++j) {
      std::size_t n_below = 0;
      for (std::size_t k = 0; k < n; ++k) n_below += copies[k] < copies[j] ? 1u : 0u;
      numbers[n_below] = copies[j];
    }
  }
}

}  // namespace vex
