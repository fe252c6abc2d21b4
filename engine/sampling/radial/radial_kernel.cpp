// Compiled once for each instruction set, with VEX_ISA its namespace, and never with fused operations: what is averaged
// is the same bits everywhere.
#include "engine/sampling/radial/radial_packets.h"
#include "engine/sampling/radial/radial_search.h"

namespace vex {
namespace VEX_ISA {
namespace {

class Kernel final : public PacketRays {
 public:
  Kernel(const PacketPairForms& forms, const BodyPoints& points) : search_(forms, points) {}

  void find(const RayTable& rays, RadialAnswers& answers) override { search_.find(rays, answers); }
  void close_in(const RayTable& rays, RadialAnswers& answers) override { search_.close_in(rays, answers); }
  void decide(RadialAnswers& answers) override { search_.decide(answers); }

 private:
  RadialSearch<kRegisterLanes> search_;
};

}  // namespace

PacketRays* new_packet_rays(const PacketPairForms& forms, const BodyPoints& points) {
  return new Kernel(forms, points);
}

}  // namespace VEX_ISA
}  // namespace vex
