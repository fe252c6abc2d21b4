// A tree of axis-aligned boxes over the bodies of a scene: the broad phase for unlike sizes, needles and open space.
//
// The leaves' boxes stand in the order of the tree in blocks of eight, the boxes around those blocks in blocks of
// eight, and so on up to one block: which node is whose child is told by its number alone. Boxes are stored as floats,
// rounded outwards, where that makes them hardly larger, and as doubles otherwise: "meets" below may also be true of
// boxes that are apart by less than a rounding, and is never false of boxes that meet.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/scene/aabb.h"
#include "engine/scene/box_block.h"
#include "engine/scene/box_order.h"

namespace vex {

/// Leaves are numbered as their boxes are. Boxes are finite, lower <= upper, coordinates up to 1e150. Searches may run
/// in several threads at once.
class AabbTree {
 public:
  /// From nothing: O(n log n), by the places and the sizes of the boxes. The same tree for any number of threads.
  void build(std::span<const Aabb> boxes, int n_threads = 1);
  /// The boxes have moved, each a little: nodes are fitted to them again, from the leaves up.
  void refit(std::span<const Aabb> boxes, int n_threads = 1);
  /// Whether boxes have come to overlap so much more than when the tree was built that building it anew pays.
  bool is_worn() const;
  /// One box has moved, anywhere; nodes above it grow or shrink.
  void move(std::uint32_t leaf, const Aabb& box);

  std::size_t size() const { return order_.size(); }
  /// Leaves from left to right: neighbours in this order are near each other.
  std::span<const std::uint32_t> order() const { return order_; }
  /// Of all boxes as they are stored; lower > upper where there are none.
  const Aabb& bounds() const { return bounds_; }

  /// A part of the search for pairs of leaves: of those below `node` with those below `other`, which is moved by the
  /// shift of this number; within one node where both are the same and the shift is 0.
  struct PairTask {
    std::uint32_t node, other, shift;
  };
  /// Tasks that together find every pair of leaves {i, j}, i != j, whose boxes meet, once; and for each shift from the
  /// second on (the first must be 0) every ordered pair (i, j), i = j too, of which box i meets box j + shift. About
  /// `n_wanted` of them, or fewer. Allocates nothing but what `tasks` holds.
  void pair_tasks(std::span<const Vec3d> shifts, std::size_t n_wanted, std::vector<PairTask>& tasks) const;
  /// visit(i, j) for each such pair of the task.
  template <class Visit>
  void pairs(const PairTask& task, const Vec3d& shift, Visit&& visit) const;

  /// visit(leaf) for every leaf whose box meets this one.
  template <class Visit>
  void meeting(const Aabb& box, Visit&& visit) const;
  /// Leaves whose boxes' distance from `box` is at most `bound`, those of nearer nodes first: bound = visit(leaf,
  /// bound). A negative bound ends the search.
  template <class Visit>
  void by_distance(const Aabb& box, double bound, Visit&& visit) const;
  /// Leaves whose boxes, each widened by `margin` on all sides, the ray origin + t dir enters at 0 <= t <= until, in
  /// the order of t as far as the tree knows it: until = visit(leaf, until). No box that is met is missed for rounding.
  /// A negative `until` ends the search.
  template <class Visit>
  void along_ray(const Vec3d& origin, const Vec3d& dir, const Vec3d& margin, double until, Visit&& visit) const;

 private:
  static constexpr std::size_t kWidth = BoxBlock<float>::kWidth;
  static constexpr std::size_t kMostLevels = 11;  // 8^11 > 2^32

  // Blocks of all levels, the leaves' level first; a block's boxes are around the blocks of the level below. One of the
  // two is empty.
  template <class Real>
  using Blocks = std::vector<BoxBlock<Real>>;

  template <class Real>
  const Blocks<Real>& blocks() const {
    if constexpr (sizeof(Real) == sizeof(float)) {
      return float_blocks_;
    } else {
      return double_blocks_;
    }
  }
  template <class Real>
  Blocks<Real>& blocks() {
    return const_cast<Blocks<Real>&>(static_cast<const AabbTree*>(this)->blocks<Real>());
  }

  template <class Real>
  void fit(std::span<const Aabb> boxes, int n_threads);
  template <class Real>
  void move_in(std::uint32_t place, const Aabb& box);
  template <class Real>
  void add_tasks(std::span<const Vec3d> shifts, std::size_t n_wanted, std::vector<PairTask>& tasks) const;

  std::uint32_t root() const { return first_[n_levels_ - 1]; }
  std::size_t level_of(std::uint32_t block) const;
  std::uint32_t child(std::size_t level, std::uint32_t block, std::size_t k) const {
    return first_[level - 1] + (block - first_[level]) * static_cast<std::uint32_t>(kWidth) +
           static_cast<std::uint32_t>(k);
  }
  std::uint32_t leaf(std::uint32_t block, std::size_t k) const { return order_[block * kWidth + k]; }

  // Call visit(k, l) for the boxes k and l of a block that meet, each pair once; and for the boxes k of `block` and l
  // of `other`, whose hull is given, that meet when `other` is moved by the shift.
  template <class Real, class Visit>
  static void pairs_within(const BoxBlock<Real>& block, Visit&& visit);
  template <class Real, bool kIsShifted, class Visit>
  static void pairs_between(const BoxBlock<Real>& block, const BoxBlock<Real>& other, const RealBox<Real>& hull,
                            const Vec3d& shift, Visit&& visit);
  // Call visit(i, j) for the leaves below blocks.
  template <class Real, class Visit>
  void pairs_of_one(std::size_t level, std::uint32_t block, Visit& visit) const;
  template <class Real, bool kIsShifted, class Visit>
  void pairs_below(std::size_t level, std::uint32_t block, std::uint32_t other, const RealBox<Real>& hull,
                   const Vec3d& shift, Visit& visit) const;
  template <class Real, class Visit>
  void pairs_of(const PairTask& task, const Vec3d& shift, Visit& visit) const;
  template <class Real, class Visit>
  void meeting_below(std::size_t level, std::uint32_t block, const RealBox<Real>& box, Visit& visit) const;
  // Calls visit(leaf) in the order of keys(block, keys), which are numbers that are NaN where the box does not matter;
  // as long as the key is at most `bound`, which visits change.
  template <class Real, class Keys, class Visit>
  void ordered_below(std::size_t level, std::uint32_t block, const double& bound, const Keys& keys, Visit& visit) const;

  std::vector<std::uint32_t> order_, place_;                // leaves by place; places by leaf
  std::vector<BoxKey> keys_;                                // only memory, for the next build
  std::array<std::uint32_t, kMostLevels + 1> first_{0, 1};  // blocks of the levels, and the end
  std::size_t n_levels_ = 1;
  bool is_in_floats_ = false;
  bool is_coarse_ = false;  // of more than one block of leaves in 256, floats are
  Blocks<float> float_blocks_;
  Blocks<double> double_blocks_{1, BoxBlock<double>::empty()};
  Aabb bounds_{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
  double area_ = 0.0, area_when_built_ = 0.0;  // of the boxes around the blocks of leaves, summed
};

}  // namespace vex

#include "engine/scene/aabb_tree_search.h"
