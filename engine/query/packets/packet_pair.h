// A pair of bodies as the packet kernels take it, with its owners.
#pragma once

#include <memory>

#include "engine/query/packets/core_form.h"
#include "engine/query/packets/packet_overlap.h"
#include "engine/support/convex_body.h"

namespace vex {

class PacketPair {
 public:
  /// Null where kernels do not take the pair: cores of another form, or lengths whose products could over- or
  /// underflow. That hangs on the bodies alone: tables of directions that the bodies do not have yet are made here, so
  /// that whether a kernel answers a trial is no matter of what was asked before, or of time.
  static std::unique_ptr<PacketPair> make(const ConvexBody& a, const ConvexBody& b);

  /// Whether both cores' support points are vertices, exactly.
  bool are_polytopes() const;
  /// Refers to this.
  PacketPairForms forms() const;

 private:
  PacketPair(const ConvexBody& a, const ConvexBody& b, CoreForm core_a, CoreForm core_b);

  ConvexBody a_, b_;  // the tables' owners
  CoreForm core_a_, core_b_;
};

}  // namespace vex
