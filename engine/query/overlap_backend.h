// A way to decide overlap: the engine's own, or a peer library behind the same interface.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "engine/numeric/pose.h"
#include "engine/query/packets/packet_overlap.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Decides many poses of one pair of bodies. One instance serves one thread.
class OverlapBackend {
 public:
  virtual ~OverlapBackend() = default;
  /// verdicts[k] for a_from_b[k]; the spans have the same length.
  virtual void decide(std::span<const Pose> a_from_b, std::span<Verdict> verdicts) = 0;
  /// The same of poses in columns, which are taken as they are, as Pose::unchecked takes them.
  virtual void decide_table(const PoseTable& a_from_b, std::span<Verdict> verdicts);
  Verdict decide(const Pose& a_from_b) {
    Verdict verdict;
    decide({&a_from_b, 1}, {&verdict, 1});
    return verdict;
  }
};

/// Names a backend and makes its instances. The bodies must outlive them.
struct BackendKind {
  std::string name;
  /// A peer answers every pose itself: no quick verdict is put before it.
  bool is_peer = false;
  std::function<std::unique_ptr<OverlapBackend>(const ConvexBody& a, const ConvexBody& b)> make;
  /// Whether it has a test of this pair, in this order; empty where it takes every two support mappings.
  std::function<bool(const ConvexBody& a, const ConvexBody& b)> takes_pair = {};

  bool takes(const ConvexBody& a, const ConvexBody& b) const { return !takes_pair || takes_pair(a, b); }
};

/// The engine's own: `overlap` of engine/query/overlap.h, with packets of the instruction set before it where there is
/// a kernel for the pair. The outcomes are the same for every set; which stage spoke may differ within rounding of
/// contact, where the sets' searches leave different poses open. Of a pair without exact forms nothing decides what all
/// searches leave open: so near to contact one set may say `undecided` where another one proves something.
BackendKind gjk_backend(InstructionSet set = best_instruction_set());
/// The same with this kernel, or none where it is null.
BackendKind gjk_backend_with(PacketKernel kernel);

}  // namespace vex
