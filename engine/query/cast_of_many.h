// Casts of one pair of bodies from many poses, for who hands them out: pose_batches.h is for callers.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "engine/query/first_contact.h"
#include "engine/query/packets/cast_guess.h"
#include "engine/query/packets/packet_overlap.h"

namespace vex {

class OverlapBackend;
class PacketPair;

/// Asks packets first (overlap_backend.h): where they prove that the bodies are apart at the start a search begins
/// where they guess that these meet, or pass each other by (packets/cast_guess.h). An answer hangs on its pose and
/// motion alone. One instance serves one thread; the bodies must outlive it.
class ManyCasts {
 public:
  static constexpr std::size_t kMostPoses = PacketOverlap::kMostTrials;

  ManyCasts(const ConvexBody& a, const ConvexBody& b, double until);
  ~ManyCasts();
  ManyCasts(const ManyCasts&) = delete;
  ManyCasts& operator=(const ManyCasts&) = delete;

  /// out[k] of pose k, of poses as Pose::unchecked takes them, and motion k; up to kMostPoses.
  void answer(const PoseTable& poses, std::span<const Vec3d> motions, std::span<FirstContact> out);

 private:
  static constexpr std::size_t kStride = CastGuesses::kStride;

  void guess(const PoseTable& poses, std::span<const Vec3d> motions, std::span<const Verdict> verdicts);

  const ConvexBody &a_, &b_;
  double until_;
  std::unique_ptr<OverlapBackend> backend_;  // with the pair
  std::unique_ptr<PacketPair> pair_;         // null of bodies that packets do not take, or that have no exact form
  double gap_ = 0.0;
  GuessCasts guess_;
  std::array<double, kPoseColumns * kStride> columns_{};
  std::array<double, 3 * kStride> motions_{};
  CastGuesses found_;
};

}  // namespace vex
