// The searches of a tree of boxes; included by aabb_tree.h.
#pragma once

#include <bit>
#include <cmath>
#include <limits>

#include "engine/numeric/rounding.h"
#include "engine/scene/aabb_tree.h"

namespace vex {

template <class Real, class Visit>
void AabbTree::pairs_within(const BoxBlock<Real>& block, Visit&& visit) {
  for (std::size_t k = 0; k + 1 < kWidth; ++k) {
    for (unsigned bits = meeting_bits(block.box(k), block) & (~1u << k); bits != 0; bits &= bits - 1) {
      visit(k, static_cast<std::size_t>(std::countr_zero(bits)));
    }
  }
}

template <class Real, bool kIsShifted, class Visit>
void AabbTree::pairs_between(const BoxBlock<Real>& block, const BoxBlock<Real>& other, const RealBox<Real>& hull,
                             const Vec3d& shift, Visit&& visit) {
  // Boxes that do not meet the hull of the other block are spared the comparison with each of its boxes.
  RealBox<Real> moved_hull = hull;
  if constexpr (kIsShifted) moved_hull = hull.moved(shift);
  for (unsigned near = meeting_bits(moved_hull, block); near != 0; near &= near - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(near));
    RealBox<Real> box = block.box(k);
    if constexpr (kIsShifted) box = box.moved(-shift);
    for (unsigned bits = meeting_bits(box, other); bits != 0; bits &= bits - 1) {
      visit(k, static_cast<std::size_t>(std::countr_zero(bits)));
    }
  }
}

template <class Real, bool kIsShifted, class Visit>
void AabbTree::pairs_below(std::size_t level, std::uint32_t block, std::uint32_t other, const RealBox<Real>& hull,
                           const Vec3d& shift, Visit& visit) const {
  const Blocks<Real>& all = blocks<Real>();
  if (level == 0) {
    pairs_between<Real, kIsShifted>(all[block], all[other], hull, shift,
                                    [&](std::size_t k, std::size_t l) { visit(leaf(block, k), leaf(other, l)); });
    return;
  }
  pairs_between<Real, kIsShifted>(all[block], all[other], hull, shift, [&](std::size_t k, std::size_t l) {
    pairs_below<Real, kIsShifted>(level - 1, child(level, block, k), child(level, other, l), all[other].box(l), shift,
                                  visit);
  });
}

template <class Real, class Visit>
void AabbTree::pairs_of_one(std::size_t level, std::uint32_t block, Visit& visit) const {
  const Blocks<Real>& all = blocks<Real>();
  if (level == 0) {
    pairs_within(all[block], [&](std::size_t k, std::size_t l) { visit(leaf(block, k), leaf(block, l)); });
    return;
  }
  for (std::size_t k = 0; k < kWidth && child(level, block, k) < first_[level]; ++k) {
    pairs_of_one<Real>(level - 1, child(level, block, k), visit);
  }
  pairs_within(all[block], [&](std::size_t k, std::size_t l) {
    pairs_below<Real, false>(level - 1, child(level, block, k), child(level, block, l), all[block].box(l), {}, visit);
  });
}

template <class Real, class Visit>
void AabbTree::pairs_of(const PairTask& task, const Vec3d& shift, Visit& visit) const {
  const std::size_t level = level_of(task.node);
  const RealBox<Real> hull = blocks<Real>()[task.other].hull();
  if (task.shift != 0) {
    pairs_below<Real, true>(level, task.node, task.other, hull, shift, visit);
  } else if (task.node != task.other) {
    pairs_below<Real, false>(level, task.node, task.other, hull, shift, visit);
  } else {
    pairs_of_one<Real>(level, task.node, visit);
  }
}

template <class Visit>
void AabbTree::pairs(const PairTask& task, const Vec3d& shift, Visit&& visit) const {
  is_in_floats_ ? pairs_of<float>(task, shift, visit) : pairs_of<double>(task, shift, visit);
}

template <class Real, class Visit>
void AabbTree::meeting_below(std::size_t level, std::uint32_t block, const RealBox<Real>& box, Visit& visit) const {
  for (unsigned bits = meeting_bits(box, blocks<Real>()[block]); bits != 0; bits &= bits - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(bits));
    if (level == 0) {
      visit(leaf(block, k));
    } else {
      meeting_below(level - 1, child(level, block, k), box, visit);
    }
  }
}

template <class Visit>
void AabbTree::meeting(const Aabb& box, Visit&& visit) const {
  if (is_in_floats_) {
    meeting_below(n_levels_ - 1, root(), RealBox<float>::around(box), visit);
  } else {
    meeting_below(n_levels_ - 1, root(), RealBox<double>::around(box), visit);
  }
}

template <class Real, class Keys, class Visit>
void AabbTree::ordered_below(std::size_t level, std::uint32_t block, const double& bound, const Keys& keys,
                             Visit& visit) const {
  double key[kWidth];
  keys(blocks<Real>()[block], key);
  std::size_t sorted[kWidth], n = 0;
  for (std::size_t k = 0; k < kWidth; ++k) {
    if (!(key[k] <= bound)) continue;
    std::size_t at = n++;
    for (; at > 0 && key[sorted[at - 1]] > key[k]; --at) sorted[at] = sorted[at - 1];
    sorted[at] = k;
  }
  for (std::size_t m = 0; m < n && key[sorted[m]] <= bound; ++m) {
    if (level == 0) {
      visit(leaf(block, sorted[m]));
    } else {
      ordered_below<Real>(level - 1, child(level, block, sorted[m]), bound, keys, visit);
    }
  }
}

template <class Visit>
void AabbTree::by_distance(const Aabb& box, double bound, Visit&& visit) const {
  const double low[3] = {box.lower.x, box.lower.y, box.lower.z}, up[3] = {box.upper.x, box.upper.y, box.upper.z};
  // Squares of distances. A computed one is off by no more than 7 roundings relative to itself, and by some of the
  // least numbers where it underflows; the bound is widened by twice that.
  const auto widened_square = [](double b) {
    return b >= 0.0 ? (1.0 + 16.0 * kUnitRoundoff) * (b * b) + 0x1p-1068 : -1.0;
  };
  double bound_sq = widened_square(bound);
  const auto keys = [&](const auto& block, double* distance_sq) {
    for (std::size_t k = 0; k < kWidth; ++k) {
      double sum = 0.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double above = static_cast<double>(block.lower[axis][k]) - up[axis];
        const double below = low[axis] - static_cast<double>(block.upper[axis][k]);
        const double gap = above > below ? above : below;
        // A NaN stays one: a box that is missing.
        sum += gap < 0.0 ? 0.0 : gap * gap;
      }
      distance_sq[k] = sum;
    }
  };
  const auto visit_leaf = [&](std::uint32_t leaf) {
    bound = visit(leaf, bound);
    bound_sq = widened_square(bound);
  };
  if (is_in_floats_) {
    ordered_below<float>(n_levels_ - 1, root(), bound_sq, keys, visit_leaf);
  } else {
    ordered_below<double>(n_levels_ - 1, root(), bound_sq, keys, visit_leaf);
  }
}

template <class Visit>
void AabbTree::along_ray(const Vec3d& origin, const Vec3d& dir, const Vec3d& margin, double until,
                         Visit&& visit) const {
  // On the scale of the ray on which the largest component of the direction is between 1/2 and 1. Reciprocals of the
  // others are infinite only where they are 0, or so small that the ray leaves no box of coordinates up to 1e150
  // through such a side.
  const double largest = std::fmax(std::fabs(dir.x), std::fmax(std::fabs(dir.y), std::fabs(dir.z)));
  const int exponent = largest > 0.0 ? std::ilogb(largest) + 1 : 0;
  const Vec3d scaled = times_power_of_two(dir, -exponent);
  const double from[3] = {origin.x, origin.y, origin.z}, wide[3] = {margin.x, margin.y, margin.z};
  const double inverse[3] = {1.0 / scaled.x, 1.0 / scaled.y, 1.0 / scaled.z};
  const auto scaled_bound = [&](double t) {
    return t >= 0.0 ? std::ldexp(t, exponent) * (1.0 + 4.0 * kUnitRoundoff) : -1.0;
  };
  double bound = scaled_bound(until);
  const auto keys = [&](const auto& block, double* entry) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < kWidth; ++k) {
      double enters = 0.0, leaves = kInfinity;
      bool is_there = false;
      for (int axis = 0; axis < 3; ++axis) {
        const auto lower = static_cast<double>(block.lower[axis][k]), upper = static_cast<double>(block.upper[axis][k]);
        is_there = lower <= upper;
        // Four roundings of no more than this sum: sides are moved outwards by more than that.
        const double error =
            8.0 * kUnitRoundoff * ((std::fabs(lower) + std::fabs(upper)) + (wide[axis] + std::fabs(from[axis])));
        const double to_lower = ((lower - wide[axis]) - error) - from[axis];
        const double to_upper = ((upper + wide[axis]) + error) - from[axis];
        const double t0 = (inverse[axis] < 0.0 ? to_upper : to_lower) * inverse[axis];
        const double t1 = (inverse[axis] < 0.0 ? to_lower : to_upper) * inverse[axis];
        // Comparisons with 0 times infinity are false: no bound, which is right.
        if (t0 > enters) enters = t0;
        if (t1 < leaves) leaves = t1;
      }
      // The reciprocal and the product: two roundings each.
      const bool meets =
          is_there && enters < kInfinity && leaves >= 0.0 && enters * (1.0 - 8.0 * kUnitRoundoff) <= leaves;
      entry[k] = meets ? enters * (1.0 - 8.0 * kUnitRoundoff) : std::numeric_limits<double>::quiet_NaN();
    }
  };
  const auto visit_leaf = [&](std::uint32_t leaf) {
    until = visit(leaf, until);
    bound = scaled_bound(until);
  };
  if (is_in_floats_) {
    ordered_below<float>(n_levels_ - 1, root(), bound, keys, visit_leaf);
  } else {
    ordered_below<double>(n_levels_ - 1, root(), bound, keys, visit_leaf);
  }
}

}  // namespace vex
