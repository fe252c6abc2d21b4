#include "engine/sampling/radial/radial_packets.h"

#include <utility>

#include "engine/query/packets/packet_pair.h"

namespace vex {
namespace {

class OwningPacketRays final : public PacketRays {
 public:
  explicit OwningPacketRays(KernelOfPair<PacketRays> kernel) : kernel_(std::move(kernel)) {}

  void find(const RayTable& rays, RadialAnswers& answers) override { kernel_.kernel->find(rays, answers); }

 private:
  KernelOfPair<PacketRays> kernel_;
};

}  // namespace

PacketRays::~PacketRays() = default;

RayKernel ray_kernel(InstructionSet set) {
#define VEX_KERNEL_SET(name) \
  if (set == InstructionSet::name) return name::new_packet_rays;
#include "engine/numeric/kernel_sets.inc"
  return baseline::new_packet_rays;
}

std::unique_ptr<PacketRays> make_packet_rays(RayKernel kernel, const ConvexBody& a, const ConvexBody& b,
                                             const BodyPoints& points) {
  std::unique_ptr<PacketPair> pair = PacketPair::make(a, b);
  if (pair == nullptr) return nullptr;
  std::unique_ptr<PacketRays> made(kernel(pair->forms(), points));
  return std::make_unique<OwningPacketRays>(KernelOfPair<PacketRays>{std::move(pair), std::move(made)});
}

}  // namespace vex
