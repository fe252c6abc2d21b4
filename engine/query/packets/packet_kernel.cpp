// Compiled once for each instruction set, with VEX_ISA its namespace. Operations may be fused here: what is proven is
// proven either way (E1, E18), and what is true does not depend on it.
#include "engine/query/packets/any_core.h"
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
    if (clearances != nullptr) {
      search_.template decide<true>(poses.columns, poses.stride, poses.n, answers, clearances);
    } else {
      search_.template decide<false>(poses.columns, poses.stride, poses.n, answers, nullptr);
    }
  }

 private:
  PacketSearch<kRegisterLanes, Core> search_;
};

}  // namespace

PacketOverlap* new_packet_overlap(const PacketPairForms& forms) {
  if (forms.a->kind != forms.b->kind) return new Kernel<AnyCore>(forms);
  switch (forms.a->kind) {
    case CoreForm::Kind::box: return new Kernel<BoxCore>(forms);
    case CoreForm::Kind::ellipsoid: return new Kernel<EllipsoidCore>(forms);
    case CoreForm::Kind::table: return new Kernel<TableCore>(forms);
    case CoreForm::Kind::pieces: return new Kernel<PiecesCore>(forms);
    case CoreForm::Kind::powers:
    case CoreForm::Kind::profile: return new Kernel<AnyCore>(forms);  // rare
    case CoreForm::Kind::vertices: break;
  }
  return new Kernel<VerticesCore>(forms);
}

}  // namespace VEX_ISA
}  // namespace vex
