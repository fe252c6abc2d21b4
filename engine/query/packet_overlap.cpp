#include "engine/query/packet_overlap.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/query/packet_pair.h"

namespace vex {
namespace {

// The kernel and the pair it refers to. As long as a body has not its table of directions, all is left open: to be
// asked.
class OwningPacketOverlap final : public PacketOverlap {
 public:
  OwningPacketOverlap(PacketKernel kernel, std::unique_ptr<PacketPair> pair)
      : make_kernel_(kernel), pair_(std::move(pair)) {
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
  bool make_kernel() {
    const std::optional<PacketPairForms> forms = pair_->forms();
    if (forms) kernel_.reset(make_kernel_(*forms));
    return forms.has_value();
  }

  PacketKernel make_kernel_;
  std::unique_ptr<PacketPair> pair_;
  std::unique_ptr<PacketOverlap> kernel_;
};

}  // namespace

PacketOverlap::~PacketOverlap() = default;

PacketKernel packet_kernel(InstructionSet set) {
#define VEX_KERNEL_SET(name) \
  if (set == InstructionSet::name) return name::new_packet_overlap;
#include "engine/numeric/kernel_sets.inc"
  return nullptr;
}

std::unique_ptr<PacketOverlap> make_packet_overlap(PacketKernel kernel, const ConvexBody& a, const ConvexBody& b) {
  if (kernel == nullptr) return nullptr;
  std::unique_ptr<PacketPair> pair = PacketPair::make(a, b);
  return pair == nullptr ? nullptr : std::make_unique<OwningPacketOverlap>(kernel, std::move(pair));
}

}  // namespace vex
