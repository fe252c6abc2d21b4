// Whether the gap of two bodies is at most a margin: of bodies that are widened by it, with every rounding known.
#pragma once

#include <optional>

#include "engine/numeric/pose.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

/// The bodies with a margin about one of them, whose exact size is between `least` and `most`.
struct WidenedPair {
  ConvexBody a, b;
  double least = 0.0, most = 0.0;
};

/// A margin of two bodies. The radius of a body's ball part and the margin add up rounded; where no body has a sum that
/// is exact, there are two pairs, one with the sum rounded down, the other one with it rounded up.
class MarginPairs {
 public:
  MarginPairs(const ConvexBody& a, const ConvexBody& b, double margin);

  /// The gap is at most the margin, if these overlap.
  const WidenedPair& narrow() const { return narrow_; }
  /// The gap is larger, if these are disjoint. The same bodies, if no sum is rounded.
  const WidenedPair& wide() const { return wide_ ? *wide_ : narrow_; }
  bool is_rounded() const { return wide_.has_value(); }

 private:
  WidenedPair narrow_;
  std::optional<WidenedPair> wide_;
};

/// Whether the gap is at most the margin of the pair; undecided where neither pair's verdict tells. Overlap where the
/// margin is 0 and the bodies share a point.
Verdict within_margin(const MarginPairs& pairs, const Pose& pose);

/// Margins beside one that, added to a radius, give no more than the exact sum, and no less.
double margin_rounded_down(double radius, double margin);
double margin_rounded_up(double radius, double margin);

}  // namespace vex
