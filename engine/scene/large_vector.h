// Vectors of one entry a body or a pair, which may be hundreds of megabytes that are read here and there (internal).
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace vex {

/// What is this large begins at a border of a huge page, and the system is asked for such pages: where memory is read
/// here and there, looking up where small pages are costs more than reading. Systems that know no such request go
/// without.
inline constexpr std::size_t kHugePage = std::size_t{1} << 21, kLarge = 2 * kHugePage;
void* allocate_large(std::size_t n_bytes);
void deallocate_large(void* memory, std::size_t n_bytes);

template <class T>
struct LargeMemory {
  using value_type = T;

  LargeMemory() = default;
  template <class U>
  LargeMemory(const LargeMemory<U>&) {}  // NOLINT(google-explicit-constructor): what allocators must have

  T* allocate(std::size_t n) {
    if (n < kLarge / sizeof(T)) return std::allocator<T>().allocate(n);
    if (n > ~std::size_t{0} / 2 / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(allocate_large(n * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t n) {
    if (n < kLarge / sizeof(T)) {
      std::allocator<T>().deallocate(memory, n);
    } else {
      deallocate_large(memory, n * sizeof(T));
    }
  }
  friend bool operator==(const LargeMemory&, const LargeMemory&) { return true; }
};

template <class T>
using LargeVector = std::vector<T, LargeMemory<T>>;

}  // namespace vex
