// Poses of a body that overlaps another one: drawn independently, each as likely as any other, from all at which they
// overlap.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/numeric/instruction_set.h"
#include "engine/query/overlap_backend.h"
#include "engine/sampling/domain.h"
#include "engine/sampling/poses/orientation_law.h"
#include "engine/sampling/poses/pose_columns.h"
#include "engine/support/convex_body.h"

namespace vex {

/// How pairs of placed bodies were decided.
struct PairQuestions {
  std::uint64_t n_by_balls = 0;  // by circumscribed and inscribed balls
  std::uint64_t n_searched = 0;  // by packets and what is behind them
  std::uint64_t n_undecided = 0;
};

/// By so much inscribed balls are taken for smaller, and circumscribed ones for larger, where they alone decide: far
/// more than what places of poses are off by, and than what centres may be outside of their bodies.
double margin_of_balls(const ConvexBody& a, const ConvexBody& b);

/// Decides overlaps of one pair of bodies. Serves one thread.
class PairDecider {
 public:
  PairDecider(const ConvexBody& a, const ConvexBody& b, InstructionSet set);

  /// What the balls tell, from where B's centre is seen from A's; undecided where they tell nothing. No branch: which
  /// way it goes is for a processor to guess in vain.
  Outcome by_balls(const Vec3d& from_a_to_b) const {
    const double distance_sq = dot(from_a_to_b, from_a_to_b);
    const unsigned code = (distance_sq > outer_sq_ ? 1u : 0u) + (distance_sq < inner_sq_ ? 2u : 0u);
    constexpr Outcome kOutcomes[] = {Outcome::undecided, Outcome::disjoint, Outcome::overlap};
    return kOutcomes[code];
  }
  /// The rest, many at once: outcomes that stand until the next search. Undecided poses are taken for `undecided`, and
  /// counted.
  std::span<const Outcome> search(const PoseTable& poses, Outcome undecided, PairQuestions& questions);

 private:
  // Beyond the one and within the other, squared, the answer is certain. Places of a cluster are off by less than 2^-40
  // of the bodies' reach: they lie within eight of these from each other, and rotations are composed of seven at most,
  // each one to within 2^-46 (E6).
  double outer_sq_ = 0.0, inner_sq_ = 0.0;
  std::unique_ptr<OverlapBackend> backend_;
  std::vector<Verdict> verdicts_;
  std::vector<Outcome> outcomes_;
};

/// The poses of one pair of bodies. Serves one thread.
///
/// By rejection: of poses of the law and a domain, of a fitted one each counted by its share, those that overlap. Among
/// them every pose is as likely as any other, and their density is 1 / <V_ex>, which nobody has to know.
class OverlappingPairs {
 public:
  /// The bodies must outlive it. `law` is isotropic or aligned.
  OverlappingPairs(const ConvexBody& a, const ConvexBody& b, const OrientationLaw& law, InstructionSet set);

  /// Of the trials first, first + 1, ... of this seed the first that overlap, as many as there is room for: B's poses
  /// in A's frame. Undecided poses are taken for `undecided`, and counted. Throws InputError where next to none
  /// overlaps.
  void draw(std::uint64_t seed, std::uint64_t first, Outcome undecided, std::span<Transformd> poses,
            PairQuestions& questions);

 private:
  void draw_candidates(std::uint64_t seed, std::uint64_t first);
  void decide_candidates(Outcome undecided, PairQuestions& questions);
  double acceptance_of(const Domain& domain);

  static constexpr std::size_t kCandidates = 64, kStride = PoseColumns::kStride;

  const ConvexBody& a_;
  const ConvexBody& b_;
  OrientationLaw law_;
  InstructionSet set_;
  PairDecider decider_;
  Domain domain_;
  std::optional<FittedDomain> fitted_;
  std::optional<FittedRecipe> recipe_of_fitted_;
  PoseRecipe recipe_;
  DrawPoses draw_poses_;
  // Of a batch of candidates: points of the unit cube, the last coordinate to decide by a share; poses; who overlaps.
  std::vector<double> points_;
  std::unique_ptr<PoseColumns> columns_;
  std::vector<double> open_poses_;
  std::vector<std::size_t> open_;
  std::vector<bool> overlaps_;
};

}  // namespace vex
