#include "engine/query/radial_packets.h"

#include <utility>

#include "engine/query/packet_pair.h"

namespace vex {
namespace {

// As OwningPacketOverlap of packet_overlap.cpp.
class OwningPacketRays final : public PacketRays {
 public:
  OwningPacketRays(RayKernel make, std::unique_ptr<PacketPair> pair, const BodyPoints& points)
      : kernel_(std::move(pair), [make, points](const PacketPairForms& forms) { return make(forms, points); }) {}

  void find(const RayTable& rays, RadialAnswers& answers) override {
    if (PacketRays* const kernel = kernel_.get()) {
      kernel->find(rays, answers);
    } else {
      answers.open_all(rays.n);
    }
  }

 private:
  KernelOfPair<PacketRays> kernel_;
};

}  // namespace

PacketRays::~PacketRays() = default;

RayKernel ray_kernel(InstructionSet set) {
#define VEX_KERNEL_SET(name) \
  if (set == InstructionSet::name) return name::new_packet_rays;
#include "engine/numeric/kernel_sets.inc"
  return nullptr;
}

std::unique_ptr<PacketRays> make_packet_rays(RayKernel kernel, const ConvexBody& a, const ConvexBody& b,
                                             const BodyPoints& points) {
  if (kernel == nullptr) return nullptr;
  std::unique_ptr<PacketPair> pair = PacketPair::make(a, b);
  return pair == nullptr ? nullptr : std::make_unique<OwningPacketRays>(kernel, std::move(pair), points);
}

}  // namespace vex
