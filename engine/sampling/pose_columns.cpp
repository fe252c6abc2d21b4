#include "engine/sampling/pose_columns.h"

namespace vex {

DrawPoses pose_kernel(InstructionSet set) {
  switch (set) {
    case InstructionSet::sse2:
#ifdef VEX_HAS_SSE2_KERNELS
      return sse2::draw_poses;
#else
      return nullptr;
#endif
    case InstructionSet::avx2:
#ifdef VEX_HAS_AVX2_KERNELS
      return avx2::draw_poses;
#else
      return nullptr;
#endif
    case InstructionSet::scalar: break;
  }
  return nullptr;
}

}  // namespace vex
