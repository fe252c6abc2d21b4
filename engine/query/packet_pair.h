// A pair of bodies as the packet kernels take it, with its owners.
#pragma once

#include <memory>
#include <optional>

#include "engine/query/core_form.h"
#include "engine/query/packet_overlap.h"
#include "engine/support/convex_body.h"

namespace vex {

class PacketPair {
 public:
  /// Null where kernels do not take the pair: cores of another form, or lengths whose products could over- or
  /// underflow.
  static std::unique_ptr<PacketPair> make(const ConvexBody& a, const ConvexBody& b);

  /// None as long as a body that needs its table of directions has not been asked often enough to have it. Refers to
  /// this.
  std::optional<PacketPairForms> forms();

 private:
  PacketPair(const ConvexBody& a, const ConvexBody& b, CoreForm core_a, CoreForm core_b);

  ConvexBody a_, b_;  // the tables' owners
  CoreForm core_a_, core_b_;
};

}  // namespace vex
