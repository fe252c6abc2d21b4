// A line segment on the z axis with its middle at the origin: what a capsule is inflated from.
#pragma once

#include "engine/numeric/expect.h"
#include "engine/support/support_mapping.h"

namespace vex {

class Segment {
 public:
  explicit Segment(double length) : half_length_(0.5 * length) { VEX_EXPECT(length > 0.0); }

  /// One of the two ends: exact.
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return {L(0.0), L(0.0), copy_sign(L(half_length_), dir.z)};
  }
  double support_error() const { return 0.0; }
  Vec3d centre() const { return {}; }
  double circumradius() const { return half_length_; }
  double inradius() const { return 0.0; }

  double length() const { return 2.0 * half_length_; }

 private:
  double half_length_;
};

}  // namespace vex
