// The packet kernel without its proofs, for the pairs of vex_overlap_bench alone: a body and its like. All pairs would
// take as long to compile as a whole instruction set of the engine's.
#include "engine/query/packets/packet_overlap.h"
#include "engine/query/packets/packet_search.h"

namespace vex {
namespace VEX_ISA {
namespace {

template <class Core>
class Kernel final : public PacketOverlap {
 public:
  explicit Kernel(const PacketPairForms& forms) : search_(forms) {}

  void decide(const PoseTable& poses, PacketAnswer* answers, PacketClearances* clearances) override {
    if (clearances != nullptr) __builtin_trap();  // no bench asks for them
    search_.template decide<false>(poses.columns, poses.stride, poses.n, answers, nullptr);
  }

 private:
  PacketSearch<kRegisterLanes, Core, Core> search_;
};

}  // namespace

PacketOverlap* new_packet_overlap(const PacketPairForms& forms) {
  if (forms.a->kind != forms.b->kind) __builtin_trap();  // a bench that asks for another pair has to add it here
  switch (forms.a->kind) {
    case CoreForm::Kind::box: return new Kernel<BoxCore>(forms);
    case CoreForm::Kind::ellipsoid: return new Kernel<EllipsoidCore>(forms);
    case CoreForm::Kind::table: return new Kernel<TableCore>(forms);
    case CoreForm::Kind::pieces: return new Kernel<PiecesCore>(forms);
    case CoreForm::Kind::vertices: break;
  }
  return new Kernel<VerticesCore>(forms);
}

}  // namespace VEX_ISA
}  // namespace vex
