#include "engine/sampling/poses/pose_columns.h"

namespace vex {

DrawPoses pose_kernel(InstructionSet set) {
#define VEX_KERNEL_SET(name) \
  if (set == InstructionSet::name) return name::draw_poses;
#include "engine/numeric/kernel_sets.inc"
  return nullptr;
}

}  // namespace vex
