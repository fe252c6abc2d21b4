#include "engine/query/overlap_backend.h"

#include <algorithm>
#include <array>

#include "engine/numeric/expect.h"
#include "engine/query/overlap.h"

namespace vex {
namespace {

class GjkBackend final : public OverlapBackend {
 public:
  GjkBackend(const ConvexBody& a, const ConvexBody& b, PacketKernel kernel)
      : a_(a), b_(b), packets_(make_packet_overlap(kernel, a, b)) {}

  void decide(std::span<const Transformd> a_from_b, std::span<Verdict> verdicts) override {
    VEX_EXPECT(a_from_b.size() == verdicts.size());
    if (!packets_) {
      for (std::size_t k = 0; k < a_from_b.size(); ++k) verdicts[k] = overlap(a_, b_, a_from_b[k]);
      return;
    }
    for (std::size_t first = 0; first < a_from_b.size(); first += PacketOverlap::kMostTrials) {
      const std::size_t n = std::min(PacketOverlap::kMostTrials, a_from_b.size() - first);
      for (std::size_t k = 0; k < n; ++k) set_pose(columns_[0], PacketOverlap::kStride, k, a_from_b[first + k]);
      decide_table({columns_[0], PacketOverlap::kStride, n}, verdicts.subspan(first, n));
    }
  }

  void decide_table(const PoseTable& a_from_b, std::span<Verdict> verdicts) override {
    if (!packets_) {
      OverlapBackend::decide_table(a_from_b, verdicts);
      return;
    }
    VEX_EXPECT(a_from_b.n == verdicts.size() && a_from_b.n <= PacketOverlap::kMostTrials);
    packets_->decide(a_from_b, answers_.data());
    for (std::size_t k = 0; k < a_from_b.n; ++k) {
      switch (answers_[k]) {
        case PacketAnswer::disjoint: verdicts[k] = Verdict::disjoint(DecidedBy::gjk); break;
        case PacketAnswer::overlap: verdicts[k] = Verdict::overlap(DecidedBy::gjk); break;
        case PacketAnswer::open: verdicts[k] = overlap(a_, b_, a_from_b.pose(k)); break;
      }
    }
  }

 private:
  const ConvexBody& a_;
  const ConvexBody& b_;
  std::unique_ptr<PacketOverlap> packets_;
  std::array<PacketAnswer, PacketOverlap::kMostTrials> answers_{};
  alignas(64) double columns_[kPoseColumns][PacketOverlap::kStride] = {};
};

}  // namespace

void OverlapBackend::decide_table(const PoseTable& a_from_b, std::span<Verdict> verdicts) {
  VEX_EXPECT(a_from_b.n == verdicts.size() && a_from_b.n <= PacketOverlap::kMostTrials);
  std::array<Transformd, PacketOverlap::kMostTrials> poses;
  for (std::size_t k = 0; k < a_from_b.n; ++k) poses[k] = a_from_b.pose(k);
  decide(std::span<const Transformd>(poses).first(a_from_b.n), verdicts);
}

BackendKind gjk_backend(InstructionSet set) { return gjk_backend_with(packet_kernel(set)); }

BackendKind gjk_backend_with(PacketKernel kernel) {
  return {"gjk",
          false,
          [kernel](const ConvexBody& a, const ConvexBody& b) { return std::make_unique<GjkBackend>(a, b, kernel); },
          {}};
}

}  // namespace vex
