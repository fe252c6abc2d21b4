#include "engine/query/packet_overlap.h"

#include <optional>

#include "engine/query/overlap_filter.h"
#include "engine/query/query_error.h"

namespace vex {
namespace {

// The kernel and the forms it refers to.
class OwningPacketOverlap final : public PacketOverlap {
 public:
  OwningPacketOverlap(PacketKernel kernel, const ConvexBody& a, const ConvexBody& b, CoreForm core_a, CoreForm core_b)
      : core_a_(std::move(core_a)), core_b_(std::move(core_b)) {
    const QueryError<double> own = query_error(a, b, Transformd{});
    const double inradii = a.inradius() + b.inradius();
    kernel_.reset(
        kernel({&core_a_, &core_b_, a.centre(), b.centre(), inradii * kStartOffset, a.ball_radius() + b.ball_radius(),
                own.reach, own.support - 40.0 * kUnitRoundoff * own.reach * (1.0 - 8.0 * kUnitRoundoff)}));
  }

  void decide(const PoseTable& poses, PacketAnswer* answers) override { kernel_->decide(poses, answers); }

 private:
  CoreForm core_a_, core_b_;
  std::unique_ptr<PacketOverlap> kernel_;
};

bool is_within(const ConvexBody& a, const ConvexBody& b) {
  const double reach = query_error(a, b, Transformd{}).reach;
  return reach > kLeastPacketReach && reach < kLargestPacketReach;
}

}  // namespace

PacketOverlap::~PacketOverlap() = default;

PacketKernel packet_kernel(InstructionSet set) {
#define VEX_KERNEL_SET(name) \
  if (set == InstructionSet::name) return name::new_packet_overlap;
#include "engine/numeric/kernel_sets.inc"
  return nullptr;
}

std::unique_ptr<PacketOverlap> make_packet_overlap(PacketKernel kernel, const ConvexBody& a, const ConvexBody& b) {
  if (kernel == nullptr || !is_within(a, b)) return nullptr;
  std::optional<CoreForm> core_a = core_form(a), core_b = core_form(b);
  if (!core_a || !core_b) return nullptr;
  return std::make_unique<OwningPacketOverlap>(kernel, a, b, std::move(*core_a), std::move(*core_b));
}

}  // namespace vex
