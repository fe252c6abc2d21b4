// Poses of many trials at once, as columns: what the kernels draw, bit for bit the poses of PoseSampler.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/numeric/instruction_set.h"
#include "engine/query/packets/packet_overlap.h"
#include "engine/query/packets/quick_verdict.h"
#include "engine/sampling/domain.h"
#include "engine/sampling/poses/fitted_domain.h"
#include "engine/sampling/poses/orientation_law.h"
#include "engine/sampling/poses/pose_map.h"

namespace vex {

/// Of a fitted domain; one thread's.
struct FittedRecipe {
  FittedRecipe(const ConvexBody& a, const ConvexBody& b, const FittedDomain& domain)
      : pair(&domain.pair()), heights_a(a), heights_b(b) {}

  const FittedPair* pair;
  KernelHeights heights_a, heights_b;
};

/// What a run's poses are made of. Refers to its parts.
struct PoseRecipe {
  std::uint64_t seed;
  const OrientationLaw* law;
  const Domain* domain;
  Vec3d centre_b;
  const QuickVerdict* quick;             // or none
  const FittedRecipe* fitted = nullptr;  // where the domain is such
  /// The points of the trials, coordinate by coordinate, each at PoseColumns::kStride from the one before; or none:
  /// they are drawn from (seed, Stream::pose, index).
  const double* points = nullptr;
};

/// Of up to kMostTrials trials those that the quick verdict leaves open, in their order, and how many it decided.
struct PoseColumns {
  static constexpr std::size_t kMostTrials = 512;
  static constexpr std::size_t kStride = kMostTrials + 32;

  alignas(64) double poses[kPoseColumns][kStride] = {};
  std::uint64_t row[kStride] = {};  // of the open ones: trial `first + row`
  std::size_t n_open = 0, n_disjoint = 0, n_overlap = 0;
  // Of a fitted domain, PosedTrial::domain_share: of the open ones, and of those decided, in their order.
  double share[kStride] = {}, share_disjoint[kStride] = {}, share_overlap[kStride] = {};

  // The kernel's own: of the unit cube, and of angles.
  alignas(64) double coordinates[kPoseDimension][kStride] = {};
  alignas(64) double sine[2][kStride] = {}, cosine[2][kStride] = {};
  // Of a fitted domain, for some trials at a time: normals in both frames, and heights (fitted_kernel.h).
  static constexpr std::size_t kFittedColumns = 42, kMostFitted = 64, kFittedStride = kMostFitted + 16;
  alignas(64) double fitted[kFittedColumns][kFittedStride] = {};
};

/// Draws the trials first ... first + n - 1.
using DrawPoses = void (*)(const PoseRecipe& recipe, std::uint64_t first, std::size_t n, PoseColumns& columns);

/// None for `scalar`.
DrawPoses pose_kernel(InstructionSet set);

namespace sse2 {
void draw_poses(const PoseRecipe& recipe, std::uint64_t first, std::size_t n, PoseColumns& columns);
}
namespace avx2 {
void draw_poses(const PoseRecipe& recipe, std::uint64_t first, std::size_t n, PoseColumns& columns);
}
namespace avx512 {
void draw_poses(const PoseRecipe& recipe, std::uint64_t first, std::size_t n, PoseColumns& poses);
}

}  // namespace vex
