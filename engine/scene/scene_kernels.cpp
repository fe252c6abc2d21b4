#include "engine/scene/scene_kernel.h"

namespace vex {

SceneKernel scene_kernel(InstructionSet set) {
#define VEX_KERNEL_SET(name) \
  if (set == InstructionSet::name) return {name::find_near, name::find_in_blocks, name::place_pairs};
#include "engine/numeric/kernel_sets.inc"
  static_cast<void>(set);
  return {baseline::find_near, baseline::find_in_blocks, baseline::place_pairs};
}

}  // namespace vex
