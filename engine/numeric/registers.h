// The vector registers of the instruction set that the including file is compiled for (VEX_ISA, given by the build).
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace vex {
namespace VEX_ISA {

#if defined(__AVX512F__)
inline constexpr int kRegisterLanes = 8;
#elif defined(__AVX2__)
inline constexpr int kRegisterLanes = 4;
#else
inline constexpr int kRegisterLanes = 2;
#endif

typedef double Register __attribute__((vector_size(8 * kRegisterLanes)));
#if defined(__AVX512F__)
typedef __mmask8 MaskRegister;  // a bit a lane: there are registers for such
#else
typedef std::int64_t MaskRegister __attribute__((vector_size(8 * kRegisterLanes)));  // all bits of a lane, or none
#endif
typedef std::uint64_t BitsRegister __attribute__((vector_size(8 * kRegisterLanes)));

/// A register at any address of an element. Not by memcpy, which g++ 12 may do by halves, and a load of both halves
/// then waits for the stores to reach the cache.
template <class R>
struct Unaligned {
  typedef R Type __attribute__((aligned(8), may_alias));
};
template <class R>
R load_register(const void* from) {
  return *static_cast<const typename Unaligned<R>::Type*>(from);
}
template <class R>
void store_register(void* to, R value) {
  *static_cast<typename Unaligned<R>::Type*>(to) = value;
}

/// N registers' worth of one element type.
template <class R, std::size_t N>
struct Registers {
  R part[N];
};

}  // namespace VEX_ISA
}  // namespace vex
