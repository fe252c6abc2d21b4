// Poses of many trials at once, as columns: what the kernels draw, bit for bit the poses of PoseSampler.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/numeric/instruction_set.h"
#include "engine/query/packet_overlap.h"
#include "engine/sampling/domain.h"
#include "engine/sampling/orientation_law.h"
#include "engine/scene/quick_verdict.h"

namespace vex {

/// What a run's poses are made of. Refers to its parts; the domain is no fitted one.
struct PoseRecipe {
  std::uint64_t seed;
  const OrientationLaw* law;
  const Domain* domain;
  Vec3d centre_b;
  const QuickVerdict* quick;  // or none
};

/// Up to PacketOverlap::kMostTrials poses; kPoseColumns of `kStride` values each.
struct PoseColumns {
  static constexpr std::size_t kStride = PacketOverlap::kStride;
  alignas(64) double all[kPoseColumns][kStride] = {};   // of trial first + k in row k
  alignas(64) double open[kPoseColumns][kStride] = {};  // of those that the quick verdict leaves open
  alignas(64) double open_index[kStride] = {};          // their rows in `all`
  std::size_t n_open = 0;
  PacketAnswer quick[kStride] = {};  // of every trial
};

/// Draws the trials first ... first + n - 1.
using DrawPoses = void (*)(const PoseRecipe& recipe, std::uint64_t first, std::size_t n, PoseColumns& poses);

/// None for `scalar`.
DrawPoses pose_kernel(InstructionSet set);

namespace sse2 {
void draw_poses(const PoseRecipe& recipe, std::uint64_t first, std::size_t n, PoseColumns& poses);
}
namespace avx2 {
void draw_poses(const PoseRecipe& recipe, std::uint64_t first, std::size_t n, PoseColumns& poses);
}
namespace avx512 {
void draw_poses(const PoseRecipe& recipe, std::uint64_t first, std::size_t n, PoseColumns& poses);
}

}  // namespace vex
