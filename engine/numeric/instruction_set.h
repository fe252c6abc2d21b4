// The instruction sets that kernels are compiled for, and which of them this machine has.
#pragma once

#include <span>
#include <string_view>

namespace vex {

enum class InstructionSet {
  scalar,  // no kernels: one trial at a time, as on a machine without any of the others
  sse2,    // two doubles a register: every x86-64
  avx2,    // four
  avx512,  // eight
};

constexpr std::string_view name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::sse2: return "sse2";
    case InstructionSet::avx2: return "avx2";
    case InstructionSet::avx512: return "avx512";
    case InstructionSet::scalar: break;
  }
  return "scalar";
}

/// Those that this build has kernels for and this machine runs, the slowest first; `scalar` is always there.
std::span<const InstructionSet> instruction_sets();

/// The last of them.
InstructionSet best_instruction_set();

}  // namespace vex
