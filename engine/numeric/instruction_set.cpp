#include "engine/numeric/instruction_set.h"

#include <vector>

namespace vex {
namespace {

std::vector<InstructionSet> found() {
  std::vector<InstructionSet> sets = {InstructionSet::scalar};
#ifdef VEX_HAS_SSE2_KERNELS
  sets.push_back(InstructionSet::sse2);
#endif
#ifdef VEX_HAS_AVX2_KERNELS
  if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0) sets.push_back(InstructionSet::avx2);
#endif
#ifdef VEX_HAS_AVX512_KERNELS
  if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
      __builtin_cpu_supports("avx512vl") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
      __builtin_cpu_supports("fma") != 0) {
    sets.push_back(InstructionSet::avx512);
  }
#endif
  return sets;
}

}  // namespace

std::span<const InstructionSet> instruction_sets() {
  static const std::vector<InstructionSet> sets = found();
  return sets;
}

InstructionSet best_instruction_set() { return instruction_sets().back(); }

}  // namespace vex
