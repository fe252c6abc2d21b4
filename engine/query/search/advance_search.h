// How long what moves is proven to stay apart along a normal: the length of an advance.
#pragma once

#include <cmath>

#include "engine/numeric/rounding.h"
#include "engine/numeric/vec3.h"

namespace vex {

/// Of one motion, of two bodies (rigid_sweep.h) or over a plane (plane_sweep.h). Holds a reference.
template <class Sweep>
class AdvanceSearch {
 public:
  /// `size`: R_A + R_B.
  AdvanceSearch(Sweep& sweep, double size) : sweep_(sweep), size_(size) {}

  /// The longest time, nearly, from `from` on in which the bodies are proven to stay apart along the normal, where they
  /// are by `gap`; a little more than what remains where that is until `until`.
  double longest(const Vec3d& unit_normal, double from, double until, double gap);

 private:
  static constexpr int kMostTrials = 10;

  // Where a parabola has fallen by so much that begins with this slope and bends downwards by so much of a square.
  static double where_fallen(double by, double slope, double square) {
    return 2.0 * by / (std::sqrt(std::fmax(0.0, slope * slope + 4.0 * square * by)) - slope);
  }

  Sweep& sweep_;
  double size_;
  double last_share_ = 4.0;  // of the last advance, in times in which the gap would close at the highest speed
};

// A search for where the sweep's bound is next to nought, as near to it as the gap after it will be. The bound falls
// about as a parabola: through the gap and one trial with the sweep's own bend, or through the gap and both ends. The
// first trial is as long as the last advance was, for a motion goes on as it did.
template <class Sweep>
double AdvanceSearch<Sweep>::longest(const Vec3d& normal, double from, double until, double gap) {
  const double most_speed = sweep_.most_speed(normal), remaining = until - from;
  const double near_enough = gap * std::fmin(0.125, gap / size_) + sweep_.rounding_at(from);
  double proven = 0.0, gap_proven = gap, failed = remaining * (1.0 + 4.0 * kUnitRoundoff), gap_failed = 0.0;
  bool has_failed = false;
  if (!(gap < most_speed * remaining)) return failed;
  const double to_target = gap - 0.5 * near_enough, surely = gap / most_speed;
  double trial = std::fmin(failed, last_share_ * surely);
  for (int k = 0; k < kMostTrials; ++k) {
    const double found = sweep_.gap_during(normal, from, trial);
    if (found > 0.0) {
      if (trial >= failed) return trial;
      proven = trial;
      gap_proven = found;
    } else {
      failed = trial;
      gap_failed = found;
      has_failed = true;
    }
    if (gap_proven < near_enough || !(proven < failed * (1.0 - 0x1p-40))) break;
    const bool has_both = has_failed && proven > 0.0;
    const double of_trial = (found - gap) / trial;
    const double other = found > 0.0 ? failed : proven, gap_at_other = found > 0.0 ? gap_failed : gap_proven;
    const double square =
        has_both ? (of_trial - (gap_at_other - gap) / other) / (other - trial) : 0.125 * sweep_.bend();
    const double next = where_fallen(to_target, of_trial + square * trial, square);
    const bool is_between = next > proven && next < failed;
    if (has_failed) {
      // Where one end stays for long the middle is taken.
      trial = is_between && k % 4 != 3 ? next : proven + 0.5 * (failed - proven);
    } else {
      trial = std::fmin(failed, is_between ? std::fmin(next, 4.0 * proven) : 4.0 * proven);
    }
  }
  if (proven > 0.0) last_share_ = std::fmax(1.0, proven / surely);
  // Added to the time it is rounded: gaps above the pose's own rounding are worth more than that.
  return std::fmax(proven, surely * (1.0 - gamma(8)) - 2.0 * kUnitRoundoff * (from + surely));
}

}  // namespace vex
