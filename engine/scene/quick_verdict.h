// What the circumscribed and inscribed balls already decide, before any support mapping is called.
#pragma once

#include <limits>

#include "engine/numeric/rounding.h"
#include "engine/numeric/transform.h"
#include "engine/support/support_mapping.h"

namespace vex {

/// A's and B's balls about their centres, for many poses of one pair. Proven: E5 in docs/derivations.md.
class QuickVerdict {
 public:
  /// R of every pose must be a rotation to within `rotation_error`: | |R|_2 - 1 | and | |R^-1|_2 - 1 | at most that.
  template <class A, class B>
  QuickVerdict(const A& a, const B& b, double rotation_error)
      : centre_a_(a.centre()),
        centre_b_(b.centre()),
        outer_((a.circumradius() + b.circumradius() * (1.0 + rotation_error)) * (1.0 + gamma(8))),
        inner_((a.inradius() + b.inradius() * (1.0 - rotation_error)) * (1.0 - gamma(8))),
        reach_(norm_1(a.centre()) + 2.0 * norm_1(b.centre())) {
    if (outer_ > 0x1p-400 && outer_ < 0x1p400) return;
    // Squares would over- or underflow: nothing is decided.
    outer_ = std::numeric_limits<double>::infinity();
    inner_ = 0.0;
  }

  template <class L>
  struct Answer {
    MaskOf<L> disjoint;
    MaskOf<L> overlap;
  };

  template <class L>
  Answer<L> operator()(const Transform<L>& a_from_b) const {
    const Vec3<L> between = a_from_b(broadcast<L>(centre_b_)) - broadcast<L>(centre_a_);
    const L distance_sq = dot(between, between);
    const L distance_error = L(16.0 * kUnitRoundoff) * (L(reach_) + norm_1(a_from_b.translation));
    const L outer = L(outer_) + distance_error;
    const L inner = L(inner_) - distance_error;
    return {distance_sq > outer * outer, both(inner > L(0.0), distance_sq < inner * inner)};
  }

 private:
  Vec3d centre_a_, centre_b_;
  double outer_, inner_, reach_;
};

}  // namespace vex
