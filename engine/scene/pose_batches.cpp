#include "engine/scene/pose_batches.h"

#include <algorithm>
#include <array>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/query/cast_of_many.h"
#include "engine/query/motion_input.h"
#include "engine/query/separation_from_guess.h"
#include "engine/query/separation_of_many.h"
#include "engine/scene/threads.h"
#include "engine/support/point_body.h"

namespace vex {
namespace {

// As many poses as packets decide at a time, and of which a thread has at least one lot.
constexpr std::size_t kPosesALot = ManySeparations::kMostPoses;
static_assert(kPosesALot <= ManyCasts::kMostPoses);

void require_batch(std::size_t n_poses, std::size_t n_answers, int n_threads) {
  if (n_poses != n_answers) {
    throw UsageError("a query has " + std::to_string(n_poses) + " poses, and " + std::to_string(n_answers) +
                     " motions or places for answers - give spans of one length");
  }
  if (n_threads < 1) throw UsageError("a query has no threads (" + std::to_string(n_threads) + ") - give one at least");
}

// Each lot of the poses pose(k) is answered by what `make` makes for its thread: answer(many, table, first).
template <class PoseOf, class Make, class Answer>
void answer_lots(std::size_t n_poses, int n_threads, const PoseOf& pose, const Make& make, const Answer& answer) {
  share_range(n_threads, n_poses, kPosesALot, [&](std::size_t first, std::size_t last) {
    auto many = make();
    std::array<double, kPoseColumns * PacketOverlap::kStride> columns{};
    for (std::size_t begin = first; begin < last; begin += kPosesALot) {
      const std::size_t n = std::min(kPosesALot, last - begin);
      for (std::size_t k = 0; k < n; ++k) set_pose(columns.data(), PacketOverlap::kStride, k, pose(begin + k));
      answer(many, PoseTable{columns.data(), PacketOverlap::kStride, n}, begin);
    }
  });
}

void answer_batch(const ConvexBody& a, const ConvexBody& b, std::span<const Pose> poses, std::span<Separation> out,
                  SeparationGoal goal, const SeparationSettings& settings, int n_threads) {
  require_usable(settings);  // though there be no pose
  require_batch(poses.size(), out.size(), n_threads);
  answer_lots(
      poses.size(), n_threads, [&](std::size_t k) { return poses[k].a_from_b(); },
      [&] { return ManySeparations(a, b, goal, settings); },
      [&](ManySeparations& many, const PoseTable& lot, std::size_t first) {
        many.answer(lot, out.subspan(first, lot.n));
      });
}

template <class PoseOf>
void cast_batch(const ConvexBody& a, const ConvexBody& b, std::size_t n_poses, const PoseOf& pose,
                std::span<const Vec3d> motions, std::span<FirstContact> out, double until, int n_threads) {
  require_end(until);  // though there be no pose
  require_batch(n_poses, out.size(), n_threads);
  require_batch(n_poses, motions.size(), n_threads);
  answer_lots(
      n_poses, n_threads, pose, [&] { return ManyCasts(a, b, until); },
      [&](ManyCasts& many, const PoseTable& lot, std::size_t first) {
        many.answer(lot, motions.subspan(first, lot.n), out.subspan(first, lot.n));
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
  const auto pose = [&](std::size_t k) { return a_from_b[k].a_from_b(); };
  cast_batch(a, b, a_from_b.size(), pose, motions, out, until, n_threads);
}
void cast_ray(const ConvexBody& a, std::span<const Vec3d> origins, std::span<const Vec3d> dirs,
              std::span<FirstContact> out, double until, int n_threads) {
  const auto pose = [&](std::size_t k) { return Pose(start_of_ray(origins[k])).a_from_b(); };
  cast_batch(a, point_of_ray(), origins.size(), pose, dirs, out, until, n_threads);
}

}  // namespace vex
