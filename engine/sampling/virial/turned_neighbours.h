// Neighbours of bodies whose orientations are given: for laws of one body, of which a chain of bodies is no power of
// B2.
//
// Each body of a cluster is turned by the law on its own. Of two that are to overlap the places of B are drawn
// uniformly from a set that holds all of them (fitted_domain.h), a fixed number of times; where h of n overlap, the
// first of them is taken, and counts for h/n of the set's volume. That is V_ex at these orientations on average, and
// hangs on no place, so the mean over the draws of anything that a place counts for is its integral over all places
// that overlap: exactly, whatever is not known. Set and places of one pair hang on no other pair's, so the product
// along a chain or a tree is the product of the integrals.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/sampling/poses/fitted_domain.h"
#include "engine/sampling/virial/overlapping_pairs.h"

namespace vex {

/// <V_ex> of two bodies over their orientations, length^3, to within the relative error; NaN where it is not known.
struct KnownExcludedVolume {
  double value = std::numeric_limits<double>::quiet_NaN();
  double relative_error = 0.0;
};

/// Serves one thread.
class TurnedNeighbours {
 public:
  /// The bodies must outlive it.
  TurnedNeighbours(const ConvexBody& a, const ConvexBody& b, double excluded_volume, InstructionSet set);

  /// `poses` come as B's rotations in A's frame and leave with places at which B overlaps A; `factors` is what each
  /// counts for, in units of <V_ex>, 0 where no place was found. Trials first, first + 1, ... of the seed are used,
  /// kPlaces for each. Undecided places are taken for `undecided`, and counted.
  void draw(std::uint64_t seed, std::uint64_t first, Outcome undecided, std::span<Transformd> poses,
            std::span<double> factors, PairQuestions& questions);
  static constexpr std::size_t kPlaces = 4;

  /// No factor is larger: the largest set's volume in units of <V_ex>.
  double largest_factor() const { return fitted_.largest_volume() / excluded_volume_; }

 private:
  static constexpr std::size_t kPoses = 32, kCandidates = kPoses * kPlaces, kStride = kCandidates + 32;

  void draw_some(std::uint64_t seed, std::uint64_t first, Outcome undecided, std::span<Transformd> poses,
                 std::span<double> factors, PairQuestions& questions);

  const ConvexBody& a_;
  const ConvexBody& b_;
  double excluded_volume_;
  InstructionSet set_;
  FittedDomain fitted_;
  PairDecider decider_;
  std::vector<double> points_, open_poses_;
  std::vector<std::size_t> open_;
  std::vector<Vec3d> places_;
  std::vector<Outcome> outcomes_;
};

}  // namespace vex
