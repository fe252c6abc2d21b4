// Compiled once for each instruction set, with VEX_ISA its namespace. Operations may be fused here: what is proven is
// proven either way (E1, E18), and what is true does not depend on it.
#include "engine/query/packets/any_core.h"
#include "engine/query/packets/packet_formulas.h"
#include "engine/query/packets/packet_overlap.h"
#include "engine/query/packets/packet_search.h"

namespace vex {
namespace VEX_ISA {
namespace {

constexpr int W = kRegisterLanes;

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
  PacketSearch<W, Core> search_;
};

// Of bodies that have a formula. It tells no clearances: who asks for these has the search.
template <class Core, class Formula>
class KernelWithFormula final : public PacketOverlap {
 public:
  KernelWithFormula(const PacketPairForms& forms, const Formula& formula)
      : pair_(forms), formula_(formula), search_(forms) {}

  __attribute__((flatten)) void decide(const PoseTable& poses, PacketAnswer* answers,
                                       PacketClearances* clearances) override {
    if (clearances != nullptr) return search_.decide(poses, answers, clearances);
    std::size_t n_open = 0;
    for (std::size_t k = 0; k < poses.n; k += W) {
      const Transform<Packet<W>> pose = PacketDifference<W, Core>::pose_at(poses.columns, poses.stride, k);
      const FormulaAnswer<W> answer = formula_(pose);
      const PacketMask<W> usual = pair_.is_usual(pose);
      const unsigned disjoint = lanes_on(both(usual, answer.disjoint));
      const unsigned overlap = lanes_on(but_not(both(usual, answer.overlap), answer.disjoint));
      const std::size_t n = poses.n - k < W ? poses.n - k : W;
      for (std::size_t lane = 0; lane < n; ++lane) {
        const unsigned is_disjoint = (disjoint >> lane) & 1u, is_overlap = (overlap >> lane) & 1u;
        answers[k + lane] = static_cast<PacketAnswer>(is_disjoint | (is_overlap << 1));
        open_[n_open] = k + lane;
        n_open += 1u - (is_disjoint | is_overlap);
      }
    }
    if (n_open > 0) search_open(poses, n_open, answers);
  }

 private:
  __attribute__((noinline)) void search_open(const PoseTable& poses, std::size_t n_open, PacketAnswer* answers) {
    for (std::size_t c = 0; c < kPoseColumns; ++c) {
      for (std::size_t j = 0; j < n_open; ++j) left_[c][j] = poses.columns[c * poses.stride + open_[j]];
    }
    search_.decide({left_[0], kStride, n_open}, searched_, nullptr);
    for (std::size_t j = 0; j < n_open; ++j) answers[open_[j]] = searched_[j];
  }

  PacketDifference<W, Core> pair_;
  Formula formula_;
  Kernel<Core> search_;
  std::size_t open_[kMostTrials + 1] = {};  // rows, and room for one behind the last
  alignas(64) double left_[kPoseColumns][kStride] = {};
  PacketAnswer searched_[kStride] = {};
};

}  // namespace

PacketOverlap* new_packet_overlap(const PacketPairForms& forms) {
  const PairFormula& formula = forms.formula;
  const double error = packet_error(forms);
  switch (formula.kind) {
    case PairFormula::Kind::boxes: return new KernelWithFormula<BoxCore, BoxesFormula>(forms, {formula, error});
    case PairFormula::Kind::segments:
      return new KernelWithFormula<BoxCore, SegmentsFormula>(forms, {formula, forms.ball_radius, error});
    case PairFormula::Kind::ellipsoids:
      return new KernelWithFormula<EllipsoidCore, EllipsoidsFormula>(forms, {formula, error});
    case PairFormula::Kind::none: break;
  }
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
