#include "engine/scene/large_vector.h"

#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace vex {

void* allocate_large(std::size_t n_bytes) {
  void* const memory = ::operator new (n_bytes, std::align_val_t{kHugePage});
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  // Whole pages alone: what else is in the last one is not ours. A request that is refused changes nothing.
  static_cast<void>(madvise(memory, n_bytes / kHugePage * kHugePage, MADV_HUGEPAGE));
#endif
  return memory;
}

void deallocate_large(void* memory, std::size_t /*n_bytes*/) {
  ::operator delete(memory, std::align_val_t{kHugePage});
}

}  // namespace vex
