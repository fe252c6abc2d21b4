#include "engine/query/radial_packets.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/query/packet_pair.h"

namespace vex {
namespace {

// As OwningPacketOverlap of packet_overlap.cpp.
class OwningPacketRays final : public PacketRays {
 public:
  OwningPacketRays(RayKernel kernel, std::unique_ptr<PacketPair> pair, const BodyPoints& points)
      : make_kernel_(kernel), pair_(std::move(pair)), points_(points) {
    make_kernel();
  }

  void find(const RayTable& rays, RadialAnswers& answers) override {
    if (kernel_ == nullptr && !make_kernel()) {
      std::fill_n(answers.cube, rays.n, std::nan(""));
      std::fill_n(answers.inner, rays.n, 0.0);
      std::fill_n(answers.outer, rays.n, 0.0);
      return;
    }
    kernel_->find(rays, answers);
  }

 private:
  bool make_kernel() {
    const std::optional<PacketPairForms> forms = pair_->forms();
    if (forms) kernel_.reset(make_kernel_(*forms, points_));
    return forms.has_value();
  }

  RayKernel make_kernel_;
  std::unique_ptr<PacketPair> pair_;
  BodyPoints points_;
  std::unique_ptr<PacketRays> kernel_;
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
