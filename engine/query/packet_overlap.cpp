#include "engine/query/packet_overlap.h"

#include <algorithm>
#include <optional>

#include "engine/query/overlap_filter.h"
#include "engine/query/query_error.h"

namespace vex {
namespace {

// The kernel and the forms it refers to. As long as a body has not been asked often enough to have its table of
// directions, all is left open: to be asked.
class OwningPacketOverlap final : public PacketOverlap {
 public:
  OwningPacketOverlap(PacketKernel kernel, const ConvexBody& a, const ConvexBody& b, CoreForm core_a, CoreForm core_b)
      : make_kernel_(kernel), a_(a), b_(b), core_a_(std::move(core_a)), core_b_(std::move(core_b)) {
    make_kernel();
  }

  void decide(const PoseTable& poses, PacketAnswer* answers) override {
    if (kernel_ == nullptr && !make_kernel()) {
      std::fill_n(answers, poses.n, PacketAnswer::open);
      return;
    }
    kernel_->decide(poses, answers);
  }

 private:
  static bool is_ready(const ConvexBody& body, CoreForm* core) {
    if (core->kind != CoreForm::Kind::table) return true;
    core->table = body.direction_table().value_or(DirectionTable{});
    return core->table.cells != nullptr;
  }

  bool make_kernel() {
    if (!is_ready(a_, &core_a_) || !is_ready(b_, &core_b_)) return false;
    const QueryError<double> own = query_error(a_, b_, Transformd{});
    const double error = own.support + core_a_.support_error + 2.0 * core_b_.support_error;
    const double inradii = a_.inradius() + b_.inradius();
    kernel_.reset(make_kernel_({&core_a_, &core_b_, a_.centre(), b_.centre(), inradii * kStartOffset,
                                a_.ball_radius() + b_.ball_radius(), own.reach,
                                error - 40.0 * kUnitRoundoff * own.reach * (1.0 - 8.0 * kUnitRoundoff)}));
    return true;
  }

  PacketKernel make_kernel_;
  ConvexBody a_, b_;  // the tables' owners
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
