#include "engine/query/packet_overlap.h"

#include <algorithm>
#include <utility>

#include "engine/query/packet_pair.h"

namespace vex {
namespace {

// As long as a body has not its table of directions, all is left open: to be asked.
class OwningPacketOverlap final : public PacketOverlap {
 public:
  OwningPacketOverlap(PacketKernel make, std::unique_ptr<PacketPair> pair) : kernel_(std::move(pair), make) {}

  void decide(const PoseTable& poses, PacketAnswer* answers) override {
    if (PacketOverlap* const kernel = kernel_.get()) {
      kernel->decide(poses, answers);
    } else {
      std::fill_n(answers, poses.n, PacketAnswer::open);
    }
  }

 private:
  KernelOfPair<PacketOverlap> kernel_;
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
