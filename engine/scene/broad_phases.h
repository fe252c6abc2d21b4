// The broad phases of a scene, and which of them is true of the bodies as they are (internal).
#pragma once

#include "engine/scene/body_tree.h"
#include "engine/scene/cell_grid.h"
#include "engine/scene/scene.h"

namespace vex {

class BroadPhases {
 public:
  // What has happened to the bodies.
  void bodies_changed();
  void poses_changed();
  void moved(const SceneBodies& bodies, BodyId body);

  /// For pairs that are within `margin`, whose centres are no farther apart than `reach`: chooses and builds. Poses in
  /// the order of the bodies are needed where the pairs will be asked; what was built without them is built anew then.
  void prepare(const SceneBodies& bodies, const SceneSettings& settings, double reach, double margin,
               bool with_poses = true);
  BroadPhase chosen() const { return chosen_; }

  // Of the chosen one.
  const SortedBodies& bodies() const { return is_grid() ? grid_.bodies() : tree_.bodies(); }
  const ShiftTable& shifts() const { return is_grid() ? grid_.shifts() : tree_.shifts(); }
  std::size_t n_parts() const { return is_grid() ? grid_.n_parts() : tree_.n_parts(); }
  template <class Take>
  bool find_near(std::size_t part, const SceneKernel& kernel, NearPairs& near, Take&& take) const {
    return is_grid() ? grid_.find_near(part, kernel, near, take) : tree_.find_near(part, kernel, near, take);
  }

  /// The tree of the bodies' own boxes, for queries that are not about pairs of bodies.
  const BodyTree& tree_of_bodies(const SceneBodies& bodies, double reach, int n_threads);

 private:
  bool is_grid() const { return chosen_ == BroadPhase::grid; }
  void build_tree(const SceneBodies& bodies, double reach, double margin, int n_threads);

  CellGrid grid_;
  BodyTree tree_;
  BroadPhase chosen_ = BroadPhase::grid;
  // Of margins, without and with one; below 0: none.
  struct Choice {
    double margin = -1.0;
    BroadPhase broad_phase = BroadPhase::grid;
  };
  Choice choices_[2];
  double grid_margin_ = -1.0;
  bool is_grid_true_ = false;
  // The tree's boxes are of the bodies as they are; its order, which pairs are searched in, too.
  bool is_tree_true_ = false, is_tree_sorted_ = false, has_tree_same_bodies_ = false;
};

}  // namespace vex
