// Compiled once for each instruction set, with VEX_ISA its namespace. Operations may be fused here: what is proven is
// proven either way (E1, E18), and what is true does not depend on it.
#include "engine/query/packets/packet_overlap.h"
#include "engine/query/packets/packet_search.h"

namespace vex {
namespace VEX_ISA {
namespace {

template <class A, class B>
inline constexpr bool kAreAlike = false;
template <class A>
inline constexpr bool kAreAlike<A, A> = true;

template <class CoreA, class CoreB>
class Kernel final : public PacketOverlap {
 public:
  explicit Kernel(const PacketPairForms& forms) : search_(forms) {}

  void decide(const PoseTable& poses, PacketAnswer* answers, PacketClearances* clearances) override {
    // Cores of one form alone: for all pairs of forms it would take twice as long to compile.
    if constexpr (kAreAlike<CoreA, CoreB>) {
      if (clearances != nullptr) {
        search_.template decide<true>(poses.columns, poses.stride, poses.n, answers, clearances);
        return;
      }
    }
    search_.template decide<false>(poses.columns, poses.stride, poses.n, answers, nullptr);
    for (std::size_t k = 0; clearances != nullptr && k < poses.n; ++k) clearances->length[k] = 0.0;
  }

 private:
  PacketSearch<kRegisterLanes, CoreA, CoreB> search_;
};

template <class CoreA>
PacketOverlap* with_a(const PacketPairForms& forms) {
  switch (forms.b->kind) {
    case CoreForm::Kind::box: return new Kernel<CoreA, BoxCore>(forms);
    case CoreForm::Kind::ellipsoid: return new Kernel<CoreA, EllipsoidCore>(forms);
    case CoreForm::Kind::table: return new Kernel<CoreA, TableCore>(forms);
    case CoreForm::Kind::pieces: return new Kernel<CoreA, PiecesCore>(forms);
    case CoreForm::Kind::vertices: break;
  }
  return new Kernel<CoreA, VerticesCore>(forms);
}

}  // namespace

PacketOverlap* new_packet_overlap(const PacketPairForms& forms) {
  switch (forms.a->kind) {
    case CoreForm::Kind::box: return with_a<BoxCore>(forms);
    case CoreForm::Kind::ellipsoid: return with_a<EllipsoidCore>(forms);
    case CoreForm::Kind::table: return with_a<TableCore>(forms);
    case CoreForm::Kind::pieces: return with_a<PiecesCore>(forms);
    case CoreForm::Kind::vertices: break;
  }
  return with_a<VerticesCore>(forms);
}

}  // namespace VEX_ISA
}  // namespace vex
