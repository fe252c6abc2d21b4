// Distances and depths of one pair of bodies in many poses, for who hands them out: pose_batches.h is for callers.
#pragma once

#include <memory>
#include <span>

#include "engine/query/packets/packet_overlap.h"
#include "engine/query/search/core_search.h"
#include "engine/query/separation.h"

namespace vex {

class OverlapBackend;

/// Asks packets first (overlap_backend.h): where they prove that there is no distance, or no depth, nothing is
/// searched, and where they prove that the bodies are apart a search begins where they guess the nearest points
/// (packets/nearest_guess.h). An answer hangs on its pose alone. One instance serves one thread; the bodies must
/// outlive it.
class ManySeparations {
 public:
  static constexpr std::size_t kMostPoses = PacketOverlap::kMostTrials;

  /// Throws UsageError of settings that no query takes.
  ManySeparations(const ConvexBody& a, const ConvexBody& b, SeparationGoal goal, const SeparationSettings& settings);
  ~ManySeparations();
  ManySeparations(const ManySeparations&) = delete;
  ManySeparations& operator=(const ManySeparations&) = delete;

  /// out[k] of pose k, of poses as Pose::unchecked takes them; up to kMostPoses.
  void answer(const PoseTable& poses, std::span<Separation> out);

 private:
  class Guesses;

  const ConvexBody &a_, &b_;
  SeparationGoal goal_;
  SeparationSettings settings_;
  std::unique_ptr<OverlapBackend> backend_;  // null where packets have no say
  std::unique_ptr<Guesses> guesses_;         // null where no search has a use for them
};

}  // namespace vex
