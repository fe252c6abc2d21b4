// The sets that a fitted domain chooses from (fitted_domain.h, which says what they are), over lanes: from the heights
// of the two bodies along the sets' normals.
#pragma once

#include <array>
#include <cstddef>

#include "engine/numeric/transform.h"

namespace vex {

/// The translations t with lower_i <= n_i . t <= lower_i + width_i for three normals n_i.
template <class L>
struct ParallelepipedOf {
  std::array<Vec3<L>, 3> dual;  // n_i . dual_j = 1 for i = j, otherwise 0
  std::array<L, 3> lower{}, width{};
  L volume{0.0};            // length^3
  bool is_upright = false;  // the normals are x, y and z: only ones and zeros to multiply with

  /// For a point of the unit cube.
  Vec3<L> position(const L& u, const L& v, const L& w) const {
    if (is_upright) return {lower[0] + u * width[0], lower[1] + v * width[1], lower[2] + w * width[2]};
    return ((lower[0] + u * width[0]) * dual[0] + (lower[1] + v * width[1]) * dual[1]) +
           (lower[2] + w * width[2]) * dual[2];
  }
};
using Parallelepiped = ParallelepipedOf<double>;

template <class L>
struct IntervalOf {
  L lower, upper;
};
template <class L>
using IntervalsOf = std::array<IntervalOf<L>, 3>;

/// h(n) and h(-n) of one body.
template <class L>
struct Heights {
  L along, against;
};

/// What all sets of a pair have in common.
struct FittedPair {
  double margin;  // what rounding, and R not being quite a rotation, can change of n . t, |n| = 1 (E13)
  IntervalsOf<double> own_a, own_b;           // of each body along its own axes
  std::array<std::size_t, 2> axes_a, axes_b;  // that have a direction of their own
  std::size_t n_axes_a, n_axes_b;
};

/// x, y or z.
constexpr Vec3d frame_axis(std::size_t k) { return {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0}; }

/// The rounding of `ParallelepipedOf::position` and of the dual vectors, relative to the lengths summed (E13).
inline constexpr double kPositionError = 0x1p-48;

/// Below this sine of the angle between u_A and u_B the two choices that are made of their product are left alone: A's
/// axes serve as well, and positions keep more than half of their digits.
inline constexpr double kLeastSine = 0x1p-20;

/// Finds the smallest, `take` being told of each set and where it is better than those before.
template <class L, class Take>
class FittedSets {
 public:
  using Vec = Vec3<L>;

  FittedSets(const FittedPair& pair, const L& best_volume, Take take)
      : pair_(pair), best_volume_(best_volume), take_(take) {}

  const L& best_volume() const { return best_volume_; }

  /// u_A x u_B, and what is across each of the two and that.
  struct Across {
    static Across of(std::size_t axis_a, const Vec& u_b) {
      const Vec u_a = broadcast<L>(frame_axis(axis_a)), c = cross(u_a, u_b);
      return {c, cross(c, u_a), cross(c, u_b)};
    }
    MaskOf<L> is_usable() const { return dot(c, c) > L(kLeastSine * kLeastSine); }
    Vec c, a, b;
  };

  /// Along A's axis k, of B; and along B's axis k, of A.
  IntervalOf<L> along_axis_of_a(std::size_t k, const Heights<L>& b) const {
    return {L(pair_.own_a[k].lower) - b.along, L(pair_.own_a[k].upper) + b.against};
  }
  IntervalOf<L> along_axis_of_b(std::size_t k, const Heights<L>& a) const {
    return {-a.against - L(pair_.own_b[k].upper), a.along - L(pair_.own_b[k].lower)};
  }
  static IntervalOf<L> along(const Heights<L>& a, const Heights<L>& b) {
    return {-(a.against + b.along), a.along + b.against};
  }

  void consider_axes_of_a(const IntervalsOf<L>& intervals) {
    ParallelepipedOf<L> set;
    set.is_upright = true;
    L longest(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      set.dual[k] = broadcast<L>(frame_axis(k));
      longest = longest + farther_end(intervals[k]);
    }
    const L margin = margin_of(longest);
    set.volume = L(1.0);
    for (std::size_t k = 0; k < 3; ++k) widen(set, k, intervals[k], margin);
    take_if_better(set, MaskOf<L>(true));
  }
  void consider_axes_of_b(const std::array<Vec, 3>& axes_b, const IntervalsOf<L>& intervals) {
    consider(axes_b, intervals, MaskOf<L>(true));
  }
  void consider_across(std::size_t axis_a, const Vec& u_b, const Across& across, const IntervalOf<L>& along_u_a,
                       const IntervalOf<L>& along_u_b, const IntervalOf<L>& along_c, const IntervalOf<L>& along_a,
                       const IntervalOf<L>& along_b) {
    const MaskOf<L> may = across.is_usable();
    consider({broadcast<L>(frame_axis(axis_a)), u_b, across.c}, {along_u_a, along_u_b, along_c}, may);
    consider({across.a, across.b, across.c}, {along_a, along_b, along_c}, may);
  }

 private:
  void consider(const std::array<Vec, 3>& normals, const IntervalsOf<L>& intervals, const MaskOf<L>& may) {
    const L one_by_determinant = L(1.0) / dot(normals[0], cross(normals[1], normals[2]));
    ParallelepipedOf<L> set;
    L longest(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      set.dual[k] = one_by_determinant * cross(normals[(k + 1) % 3], normals[(k + 2) % 3]);
      longest = longest + farther_end(intervals[k]) * norm_1(set.dual[k]);
    }
    const L margin = margin_of(longest);
    set.volume = absolute(one_by_determinant);
    for (std::size_t k = 0; k < 3; ++k) widen(set, k, intervals[k], margin * norm_1(normals[k]));
    take_if_better(set, may);
  }

  static L farther_end(const IntervalOf<L>& interval) {
    return larger(absolute(interval.lower), absolute(interval.upper));
  }
  // For positions that are summed from terms whose lengths add up to no more than this.
  L margin_of(const L& longest) const { return L(pair_.margin) + L(kPositionError) * longest; }
  static void widen(ParallelepipedOf<L>& set, std::size_t k, const IntervalOf<L>& interval, const L& margin) {
    set.lower[k] = interval.lower - margin;
    set.width[k] = (interval.upper - interval.lower) + L(2.0) * margin;
    set.volume = set.volume * set.width[k];
  }
  void take_if_better(const ParallelepipedOf<L>& set, const MaskOf<L>& may) {
    const MaskOf<L> is_better = both(may, either(set.volume < best_volume_, negation(best_volume_ > L(0.0))));
    best_volume_ = select(is_better, set.volume, best_volume_);
    take_(is_better, set);
  }

  const FittedPair& pair_;
  L best_volume_;
  Take take_;
};

}  // namespace vex
