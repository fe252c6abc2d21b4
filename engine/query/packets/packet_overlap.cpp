#include "engine/query/packets/packet_overlap.h"

#include <utility>

#include "engine/query/packets/packet_pair.h"

namespace vex {
namespace {

// A kernel is compiled for an instruction set and owns nothing: with it goes the pair that it refers to.
class OwningPacketOverlap final : public PacketOverlap {
 public:
  OwningPacketOverlap(std::unique_ptr<PacketPair> pair, PacketKernel kernel)
      : pair_(std::move(pair)), kernel_(kernel(pair_->forms())) {}

  void decide(const PoseTable& poses, PacketAnswer* answers, PacketClearances* clearances) override {
    kernel_->decide(poses, answers, clearances);
  }

 private:
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
  if (pair == nullptr) return nullptr;
  return std::make_unique<OwningPacketOverlap>(std::move(pair), kernel);
}

}  // namespace vex
