#include "engine/scene/broad_phases.h"

#include "engine/scene/broad_phase_choice.h"

namespace vex {

void BroadPhases::bodies_changed() {
  poses_changed();
  has_tree_same_bodies_ = false;
  for (Choice& choice : choices_) choice.margin = -1.0;
}

void BroadPhases::poses_changed() { is_grid_true_ = is_tree_true_ = is_tree_sorted_ = false; }

void BroadPhases::moved(const SceneBodies& bodies, BodyId body) {
  is_grid_true_ = is_tree_sorted_ = false;
  if (!is_tree_true_) return;
  is_tree_true_ = false;  // also where memory gives out
  tree_.move(bodies, body);
  is_tree_true_ = true;
}

void BroadPhases::build_tree(const SceneBodies& bodies, double reach, double margin, int n_threads) {
  if (is_tree_true_ && tree_.margin() == margin) return;
  is_tree_true_ = is_tree_sorted_ = false;  // also where an interruption ends it
  tree_.build(bodies, reach, margin, has_tree_same_bodies_, n_threads);
  is_tree_true_ = has_tree_same_bodies_ = true;
}

void BroadPhases::prepare(const SceneBodies& bodies, const SceneSettings& settings, double reach, double margin,
                          bool with_poses) {
  if (settings.broad_phase != BroadPhase::automatic) {
    chosen_ = settings.broad_phase;
    for (Choice& choice : choices_) choice.margin = -1.0;
  } else {
    Choice& choice = choices_[margin > 0.0 ? 1 : 0];
    if (choice.margin != margin) choice = {margin, cheaper_broad_phase(bodies, reach, margin)};
    chosen_ = choice.broad_phase;
  }
  if (is_grid()) {
    if (is_grid_true_ && grid_margin_ == margin && (grid_.bodies().has_poses() || !with_poses)) return;
    is_grid_true_ = false;  // also where an interruption ends it
    grid_.build(bodies, reach, margin == 0.0 && bodies.are_told_by_boxes(), with_poses, settings.n_threads);
    if (margin > 0.0) grid_.bodies().widen(margin);
    grid_margin_ = margin;
    is_grid_true_ = true;
    return;
  }
  build_tree(bodies, reach, margin, settings.n_threads);
  if (is_tree_sorted_ && (tree_.bodies().has_poses() || !with_poses)) return;
  is_tree_sorted_ = false;
  tree_.sort(bodies, with_poses, settings.n_threads);
  is_tree_sorted_ = true;
}

const BodyTree& BroadPhases::tree_of_bodies(const SceneBodies& bodies, double reach, int n_threads) {
  build_tree(bodies, reach, 0.0, n_threads);
  return tree_;
}

}  // namespace vex
