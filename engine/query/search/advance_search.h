// How long two bodies that move are proven to stay apart along a normal (rigid_sweep.h): the length of an advance.
#pragma once

#include "engine/query/search/rigid_sweep.h"

namespace vex {

/// Of one motion. Holds a reference.
class AdvanceSearch {
 public:
  /// `size`: R_A + R_B.
  AdvanceSearch(RigidSweep& sweep, double size) : sweep_(sweep), size_(size) {}

  /// The longest time, nearly, from `from` on in which the bodies are proven to stay apart along the normal, where they
  /// are by `gap`; a little more than what remains where that is until `until`.
  double longest(const Vec3d& unit_normal, double from, double until, double gap);

 private:
  RigidSweep& sweep_;
  double size_;
  double last_share_ = 4.0;  // of the last advance, in times in which the gap would close at the highest speed
};

}  // namespace vex
