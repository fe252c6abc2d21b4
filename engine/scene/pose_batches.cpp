#include "engine/scene/pose_batches.h"

#include <algorithm>
#include <array>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/query/separation_from_guess.h"
#include "engine/query/separation_of_many.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

// As many poses as packets decide at a time, and of which a thread has at least one lot.
constexpr std::size_t kPosesALot = ManySeparations::kMostPoses;

void require_batch(std::size_t n_poses, std::size_t n_answers, int n_threads) {
  if (n_poses != n_answers) {
    throw UsageError("a query has " + std::to_string(n_poses) + " poses, and " + std::to_string(n_answers) +
                     " motions or places for answers - give spans of one length");
  }
  if (n_threads < 1) throw UsageError("a query has no threads (" + std::to_string(n_threads) + ") - give one at least");
}

void answer_batch(const ConvexBody& a, const ConvexBody& b, std::span<const Pose> poses, std::span<Separation> out,
                  SeparationGoal goal, const SeparationSettings& settings, int n_threads) {
  require_usable(settings);  // though there be no pose
  require_batch(poses.size(), out.size(), n_threads);
  share_range(n_threads, poses.size(), kPosesALot, [&](std::size_t first, std::size_t last) {
    ManySeparations many(a, b, goal, settings);
    std::array<double, kPoseColumns * PacketOverlap::kStride> columns{};
    for (std::size_t begin = first; begin < last; begin += kPosesALot) {
      const std::size_t n = std::min(kPosesALot, last - begin);
      for (std::size_t k = 0; k < n; ++k) {
        set_pose(columns.data(), PacketOverlap::kStride, k, poses[begin + k].a_from_b());
      }
      many.answer({columns.data(), PacketOverlap::kStride, n}, out.subspan(begin, n));
    }
  });
}

}  // namespace

void signed_distance(const ConvexBody& a, const ConvexBody& b, std::span<const Pose> a_from_b,
                     std::span<Separation> out, const SeparationSettings& settings, int n_threads) {
  answer_batch(a, b, a_from_b, out, SeparationGoal::signed_distance, settings, n_threads);
}
void distance(const ConvexBody& a, const ConvexBody& b, std::span<const Pose> a_from_b, std::span<Separation> out,
              const SeparationSettings& settings, int n_threads) {
  answer_batch(a, b, a_from_b, out, SeparationGoal::distance, settings, n_threads);
}
void penetration_depth(const ConvexBody& a, const ConvexBody& b, std::span<const Pose> a_from_b,
                       std::span<Separation> out, const SeparationSettings& settings, int n_threads) {
  answer_batch(a, b, a_from_b, out, SeparationGoal::depth, settings, n_threads);
}

void linear_cast(const ConvexBody& a, const ConvexBody& b, std::span<const Pose> a_from_b,
                 std::span<const Vec3d> motions, std::span<FirstContact> out, double until, int n_threads) {
  require_batch(a_from_b.size(), out.size(), n_threads);
  require_batch(a_from_b.size(), motions.size(), n_threads);
  share_range(n_threads, a_from_b.size(), kPosesALot, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) out[k] = linear_cast(a, b, a_from_b[k], motions[k], until);
  });
}

}  // namespace vex
