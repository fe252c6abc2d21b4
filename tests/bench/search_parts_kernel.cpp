// Compiled once for each instruction set, as packet_kernel.cpp is.
#include "engine/query/packets/packet_search.h"
#include "tests/bench/search_parts.h"

namespace vex {
namespace VEX_ISA {
namespace {

constexpr int W = kRegisterLanes;

// Counts how often it is asked.
struct CountedCore : TableCore {
  explicit CountedCore(const CoreForm& form) : TableCore(form) {}

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    n_asked += static_cast<std::size_t>(LaneTraits<L>::width);
    return TableCore::support(dir);
  }

  inline static std::size_t n_asked = 0;
};

std::size_t n_supports(const PacketPairForms& forms, const PoseTable& poses) {
  PacketAnswer answers[PacketOverlap::kStride];
  PacketSearch<W, CountedCore> search(forms);
  CountedCore::n_asked = 0;
  search.template decide<false>(poses.columns, poses.stride, poses.n, answers, nullptr);
  return CountedCore::n_asked / 2;  // of A and of B
}

__attribute__((flatten)) std::size_t ask(const PacketPairForms& forms, const PoseTable& poses,
                                         const double* directions) {
  using Pair = PacketDifference<W, TableCore>;
  const Pair pair(forms);
  std::size_t n_apart = 0;
  for (std::size_t k = 0; k < poses.n; k += W) {
    const auto direction = [&](std::size_t c) { return Packet<W>::load(directions + c * poses.stride + k); };
    const Vec3<Packet<W>> dir{direction(0), direction(1), direction(2)};
    const Vec3<Packet<W>> w = pair.support(Pair::pose_at(poses.columns, poses.stride, k), dir);
    const Packet<W> slack = Packet<W>(pair.error) * norm_1(dir);
    const PacketMask<W> apart = both(dot(dir, w) < -slack, PacketMask<W>::first(poses.n - k));
    n_apart += static_cast<std::size_t>(__builtin_popcount(lanes_on(apart)));
  }
  return n_apart;
}

}  // namespace

extern const SearchParts kSearchParts = {n_supports, ask};

}  // namespace VEX_ISA
}  // namespace vex
