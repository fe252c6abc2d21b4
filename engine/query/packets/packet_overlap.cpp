#include "engine/query/packets/packet_overlap.h"

#include <utility>

#include "engine/query/packets/packet_pair.h"

namespace vex {
namespace {

class OwningPacketOverlap final : public PacketOverlap {
 public:
  explicit OwningPacketOverlap(KernelOfPair<PacketOverlap> kernel) : kernel_(std::move(kernel)) {}

  void decide(const PoseTable& poses, PacketAnswer* answers) override { kernel_.kernel->decide(poses, answers); }

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
  if (pair == nullptr) return nullptr;
  std::unique_ptr<PacketOverlap> made(kernel(pair->forms()));
  return std::make_unique<OwningPacketOverlap>(KernelOfPair<PacketOverlap>{std::move(pair), std::move(made)});
}

}  // namespace vex
