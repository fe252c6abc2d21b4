#include "engine/query/cast_of_many.h"

#include <algorithm>

#include "engine/numeric/vec3.h"
#include "engine/query/cast_from_guess.h"
#include "engine/query/motion_input.h"
#include "engine/query/overlap_backend.h"
#include "engine/query/packets/packet_pair.h"

namespace vex {
namespace {

// Of the circumradii, how far behind its portal A - B may be: next to rounding, for in lanes a support point is cheap.
constexpr double kGap = 0x1p-46;

}  // namespace

ManyCasts::ManyCasts(const ConvexBody& a, const ConvexBody& b, double until)
    : a_(a), b_(b), until_(until), guess_(cast_guesser(best_instruction_set())) {
  // Of a body without an exact form a cast may prove less, or more, than `overlap` does.
  if (!a.exact_form().has_value() || !b.exact_form().has_value()) return;
  pair_ = PacketPair::make(a, b);
  if (pair_ == nullptr) return;
  backend_ = gjk_backend().make(a, b);
  gap_ = kGap * (a.circumradius() + b.circumradius());
}

ManyCasts::~ManyCasts() = default;

// Of the poses that are apart, one after the other.
void ManyCasts::guess(const PoseTable& poses, std::span<const Vec3d> motions, std::span<const Verdict> verdicts) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < poses.n; ++k) {
    if (verdicts[k].outcome != Outcome::disjoint) continue;
    const Vec3d scaled = scaled_to_unit_exponent(motions[k]);
    motions_[n] = scaled.x;
    motions_[kStride + n] = scaled.y;
    motions_[2 * kStride + n] = scaled.z;
    set_pose(columns_.data(), kStride, n++, poses.pose(k));
  }
  if (n > 0) guess_(pair_->forms(), gap_, {columns_.data(), kStride, n}, motions_.data(), found_);
}

void ManyCasts::answer(const PoseTable& poses, std::span<const Vec3d> motions, std::span<FirstContact> out) {
  for (const Vec3d& motion : motions.first(poses.n)) require_motion(motion, until_);
  std::array<Verdict, kMostPoses> verdicts{};
  if (pair_ != nullptr) backend_->decide_table(poses, std::span(verdicts).first(poses.n));
  for (std::size_t first = 0, n = 0; first < poses.n; first += n) {
    n = std::min(poses.n - first, CastGuesses::kMostPoses);
    const std::span<const Verdict> of_these = std::span(verdicts).subspan(first, n);
    const std::span<const Vec3d> moved = motions.subspan(first, n);
    if (pair_ != nullptr) guess({poses.columns + first, poses.stride, n}, moved, of_these);
    std::size_t next = 0;
    for (std::size_t k = 0; k < n; ++k) {
      CastGuess guess;
      if (pair_ != nullptr && of_these[k].outcome == Outcome::disjoint) guess = found_.of(next++);
      out[first + k] = linear_cast(a_, b_, Pose::unchecked(poses.pose(first + k)), moved[k], until_, guess);
    }
  }
}

}  // namespace vex
