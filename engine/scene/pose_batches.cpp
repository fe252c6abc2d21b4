#include "engine/scene/pose_batches.h"

#include <algorithm>
#include <array>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/query/overlap_backend.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

// As many poses as packets decide at a time, and of which a thread has at least one lot.
constexpr std::size_t kPosesALot = 256;

void require_batch(std::size_t n_poses, std::size_t n_answers, int n_threads) {
  if (n_poses != n_answers) {
    throw UsageError("a query has " + std::to_string(n_poses) + " poses, and " + std::to_string(n_answers) +
                     " motions or places for answers - give spans of one length");
  }
  if (n_threads < 1) throw UsageError("a query has no threads (" + std::to_string(n_threads) + ") - give one at least");
}

// What the query of one pose says where it has nothing to tell but the verdict.
Separation nothing_but_verdict(const Verdict& verdict) {
  Separation found;
  found.verdict = verdict;
  (verdict.outcome == Outcome::overlap ? found.upper : found.lower) = 0.0;
  return found;
}

// The query of one pose, but where packets prove that it has nothing to tell.
template <class Ask>
void screened(const ConvexBody& a, const ConvexBody& b, std::span<const Pose> poses, std::span<Separation> out,
              int n_threads, Outcome nothing_to_tell, const Ask& ask) {
  require_batch(poses.size(), out.size(), n_threads);
  // Of a body without an exact form a distance may prove less, or more, than `overlap` does.
  const bool is_screened = a.exact_form().has_value() && b.exact_form().has_value();
  const BackendKind packets = gjk_backend();
  share_range(n_threads, poses.size(), kPosesALot, [&](std::size_t first, std::size_t last) {
    const std::unique_ptr<OverlapBackend> backend = is_screened ? packets.make(a, b) : nullptr;
    std::array<Verdict, kPosesALot> verdicts;
    for (std::size_t begin = first; begin < last; begin += kPosesALot) {
      const std::size_t n = std::min(kPosesALot, last - begin);
      verdicts.fill(Verdict());
      if (backend != nullptr) backend->decide(poses.subspan(begin, n), std::span(verdicts).first(n));
      for (std::size_t k = 0; k < n; ++k) {
        out[begin + k] = backend != nullptr && verdicts[k].outcome == nothing_to_tell ? nothing_but_verdict(verdicts[k])
                                                                                      : ask(poses[begin + k]);
      }
    }
  });
}

// What a query of one pose refuses is refused of many, also where none of them asks it.
void require_settings(const SeparationSettings& settings) {
  if (!(settings.relative_gap >= 0.0) || !(settings.max_distance >= 0.0) || settings.max_support_calls < 1) {
    throw UsageError(
        "a distance has a gap or an end that is negative or no number, or no support calls - see "
        "SeparationSettings");
  }
}

}  // namespace

void signed_distance(const ConvexBody& a, const ConvexBody& b, std::span<const Pose> a_from_b,
                     std::span<Separation> out, const SeparationSettings& settings, int n_threads) {
  require_batch(a_from_b.size(), out.size(), n_threads);
  share_range(n_threads, a_from_b.size(), kPosesALot, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) out[k] = signed_distance(a, b, a_from_b[k], settings);
  });
}

void distance(const ConvexBody& a, const ConvexBody& b, std::span<const Pose> a_from_b, std::span<Separation> out,
              const SeparationSettings& settings, int n_threads) {
  require_settings(settings);
  screened(a, b, a_from_b, out, n_threads, Outcome::overlap,
           [&](const Pose& pose) { return distance(a, b, pose, settings); });
}

void penetration_depth(const ConvexBody& a, const ConvexBody& b, std::span<const Pose> a_from_b,
                       std::span<Separation> out, const SeparationSettings& settings, int n_threads) {
  require_settings(settings);
  screened(a, b, a_from_b, out, n_threads, Outcome::disjoint,
           [&](const Pose& pose) { return penetration_depth(a, b, pose, settings); });
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
