#include "engine/query/overlap_backend.h"

#include <algorithm>
#include <array>

#include "engine/numeric/errors.h"
#include "engine/query/overlap.h"

namespace vex {
namespace {

void require_as_many(std::size_t n_poses, std::size_t n_verdicts) {
  if (n_poses != n_verdicts) throw UsageError("not as many verdicts as poses - give room for one each");
}

class GjkBackend final : public OverlapBackend {
 public:
  GjkBackend(const ConvexBody& a, const ConvexBody& b, PacketKernel kernel)
      : a_(a), b_(b), packets_(make_packet_overlap(kernel, a, b)) {}

  using OverlapBackend::decide;
  void decide(std::span<const Pose> a_from_b, std::span<Verdict> verdicts) override {
    require_as_many(a_from_b.size(), verdicts.size());
    if (!packets_) {
      for (std::size_t k = 0; k < a_from_b.size(); ++k) verdicts[k] = overlap(a_, b_, a_from_b[k]);
      return;
    }
    for (std::size_t first = 0; first < a_from_b.size(); first += PacketOverlap::kMostTrials) {
      const std::size_t n = std::min(PacketOverlap::kMostTrials, a_from_b.size() - first);
      for (std::size_t k = 0; k < n; ++k)
        set_pose(columns_[0], PacketOverlap::kStride, k, a_from_b[first + k].a_from_b());
      decide_table({columns_[0], PacketOverlap::kStride, n}, verdicts.subspan(first, n));
    }
  }

  void decide_table(const PoseTable& a_from_b, std::span<Verdict> verdicts) override {
    if (!packets_) {
      OverlapBackend::decide_table(a_from_b, verdicts);
      return;
    }
    require_as_many(a_from_b.n, verdicts.size());
    // In parts of about the same size, so that the last is not a remainder that fills no packet.
    const std::size_t n_parts = (a_from_b.n + PacketOverlap::kMostTrials - 1) / PacketOverlap::kMostTrials;
    std::size_t first = 0;
    for (std::size_t part = 1; part <= n_parts; ++part) {
      const std::size_t end = part == n_parts ? a_from_b.n : part * a_from_b.n / n_parts;
      decide_part({a_from_b.columns + first, a_from_b.stride, end - first}, verdicts.subspan(first, end - first));
      first = end;
    }
  }

 private:
  void decide_part(const PoseTable& a_from_b, std::span<Verdict> verdicts) {
    static constexpr std::array<Verdict, 3> kVerdicts = {Verdict::undecided(DecidedBy::gjk, UndecidedReason::none),
                                                         Verdict::disjoint(DecidedBy::gjk),
                                                         Verdict::overlap(DecidedBy::gjk)};
    packets_->decide(a_from_b, answers_.data());
    bool any_open = false;
    for (std::size_t k = 0; k < a_from_b.n; ++k) {
      verdicts[k] = kVerdicts[static_cast<std::size_t>(answers_[k])];
      any_open |= answers_[k] == PacketAnswer::open;
    }
    if (!any_open) return;
    for (std::size_t k = 0; k < a_from_b.n; ++k) {
      if (answers_[k] == PacketAnswer::open) verdicts[k] = overlap(a_, b_, Pose::unchecked(a_from_b.pose(k)));
    }
  }

  const ConvexBody& a_;
  const ConvexBody& b_;
  std::unique_ptr<PacketOverlap> packets_;
  std::array<PacketAnswer, PacketOverlap::kMostTrials> answers_{};
  alignas(64) double columns_[kPoseColumns][PacketOverlap::kStride] = {};
};

}  // namespace

void OverlapBackend::decide_table(const PoseTable& a_from_b, std::span<Verdict> verdicts) {
  require_as_many(a_from_b.n, verdicts.size());
  std::array<Pose, 64> poses;
  for (std::size_t first = 0; first < a_from_b.n; first += poses.size()) {
    const std::size_t n = std::min(poses.size(), a_from_b.n - first);
    for (std::size_t k = 0; k < n; ++k) poses[k] = Pose::unchecked(a_from_b.pose(first + k));
    decide(std::span<const Pose>(poses).first(n), verdicts.subspan(first, n));
  }
}

BackendKind gjk_backend(InstructionSet set) { return gjk_backend_with(packet_kernel(set)); }

BackendKind gjk_backend_with(PacketKernel kernel) {
  return {"gjk",
          false,
          [kernel](const ConvexBody& a, const ConvexBody& b) { return std::make_unique<GjkBackend>(a, b, kernel); },
          {}};
}

}  // namespace vex
