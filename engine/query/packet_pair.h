// A pair of bodies as the packet kernels take it, with its owners.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

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

/// A kernel of the pair and the pair it refers to: made as soon as the bodies have what it needs.
template <class Kernel>
class KernelOfPair {
 public:
  using Make = std::function<Kernel*(const PacketPairForms& forms)>;

  KernelOfPair(std::unique_ptr<PacketPair> pair, Make make) : pair_(std::move(pair)), make_(std::move(make)) { get(); }

  /// Null before.
  Kernel* get() {
    if (kernel_ != nullptr) return kernel_.get();
    if (const std::optional<PacketPairForms> forms = pair_->forms()) kernel_.reset(make_(*forms));
    return kernel_.get();
  }

 private:
  std::unique_ptr<PacketPair> pair_;
  Make make_;
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace vex
