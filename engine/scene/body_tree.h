// The tree of the boxes of all bodies of a scene: the broad phase for unlike sizes, needles and open space, and what
// queries of a ray, a moving body or a visitor ask (internal).
#pragma once

#include <cstdint>
#include <vector>

#include "engine/scene/aabb_tree.h"
#include "engine/scene/scene_bodies.h"
#include "engine/scene/shift_table.h"
#include "engine/scene/sorted_bodies.h"

namespace vex {

/// A box that holds the body, as seen from any other body's frame (E26), and all that is within half of `margin` of it.
/// `largest_shift`: what may be added to its coordinates.
Aabb scene_box(const SceneBodies& bodies, BodyId body, double margin, double largest_shift);

class BodyTree {
 public:
  /// Of the bodies as they are. Where only poses have changed since the last time, nodes are fitted to the boxes again,
  /// as long as that pays.
  void build(const SceneBodies& bodies, double reach, double margin, bool same_bodies, int n_threads);
  /// One body has moved; pairs are not searched for until the tree is built again.
  void move(const SceneBodies& bodies, BodyId body);
  double margin() const { return margin_; }

  const AabbTree& tree() const { return tree_; }
  BodyId body_of(std::uint32_t leaf) const { return ids_[leaf]; }
  const ShiftTable& shifts() const { return shifts_; }

  /// As CellGrid has them.
  const SortedBodies& bodies() const { return sorted_; }
  void sort(const SceneBodies& bodies, bool with_poses, int n_threads);
  std::size_t n_parts() const { return tasks_.size(); }
  template <class Take>
  bool find_near(std::size_t part, const SceneKernel&, NearPairs& near, Take&& take) const;

 private:
  AabbTree tree_;
  ShiftTable shifts_;
  double margin_ = 0.0;
  bool is_there_ = false;
  std::vector<BodyId> ids_;          // of each leaf
  std::vector<std::uint32_t> leaf_;  // of each body
  std::vector<Aabb> boxes_;
  std::vector<std::uint32_t> place_;  // in the tree's order, of each leaf
  std::vector<BodyId> order_;
  SortedBodies sorted_;
  std::vector<Vec3d> moves_;  // home, then one of each two opposite shifts
  std::vector<AabbTree::PairTask> tasks_;
};

template <class Take>
bool BodyTree::find_near(std::size_t part, const SceneKernel&, NearPairs& near, Take&& take) const {
  const AabbTree::PairTask& task = tasks_[part];
  const Vec3d shift = moves_[task.shift];
  const std::uint64_t number = shifts_.home() + std::uint64_t{task.shift};
  bool goes_on = true;
  tree_.pairs(task, shift, [&](std::uint32_t leaf, std::uint32_t other) {
    if (!goes_on) return;
    const std::uint64_t i = place_[leaf], j = place_[other];
    ++near.n_seen;
    const double dx = (sorted_.x[j] + shift.x) - sorted_.x[i], dy = (sorted_.y[j] + shift.y) - sorted_.y[i],
                 dz = (sorted_.z[j] + shift.z) - sorted_.z[i], sum = sorted_.radius[i] + sorted_.radius[j];
    near.places[near.n] = i | (j << 32);
    near.shift[near.n] = number;
    near.n += (dx * dx + dy * dy) + dz * dz <= sum * sum ? 1 : 0;
    if (near.n >= NearPairs::kMost) goes_on = take();
  });
  if (!goes_on) return false;
  return near.n == 0 || take();
}

}  // namespace vex
