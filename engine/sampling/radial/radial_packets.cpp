#include "engine/sampling/radial/radial_packets.h"

#include <utility>

#include "engine/query/packets/packet_pair.h"

namespace vex {
namespace {

// As OwningPacketOverlap.
class OwningPacketRays final : public PacketRays {
 public:
  OwningPacketRays(std::unique_ptr<PacketPair> pair, RayKernel kernel, const BodyPoints& points)
      : pair_(std::move(pair)), kernel_(kernel(pair_->forms(), points)) {}

  void find(const RayTable& rays, RadialAnswers& answers) override { kernel_->find(rays, answers); }
  void close_in(const RayTable& rays, RadialAnswers& answers) override { kernel_->close_in(rays, answers); }
  void decide(RadialAnswers& answers) override { kernel_->decide(answers); }

 private:
  std::unique_ptr<PacketPair> pair_;
  std::unique_ptr<PacketRays> kernel_;
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
  return std::make_unique<OwningPacketRays>(std::move(pair), kernel, points);
}

}  // namespace vex
