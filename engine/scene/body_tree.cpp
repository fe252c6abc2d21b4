#include "engine/scene/body_tree.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/threads.h"

namespace vex {
namespace {

constexpr std::size_t kTasksAThread = 64, kBodiesAShare = 1024;

}  // namespace

Aabb scene_box(const SceneBodies& bodies, BodyId body, double margin, double largest_shift) {
  const ShapeId shape = bodies.shape_of()[body];
  const ShapeBounds& bounds = bodies.bounds(shape);
  Aabb box = bounding_box(bodies.shapes()[shape], Pose::unchecked(bodies.pose(body)));
  // The body is turned back and forth by matrices that are rotations to within 2e-7, and shifts are rounded.
  const double more = 0.5 * margin * (1.0 + 0x1p-19) + 0x1p-18 * (bounds.radius + norm_1(bounds.centre)) +
                      bounds.rounding_at(bodies.centre(body), largest_shift);
  const Vec3d wider{more, more, more};
  return {box.lower - wider, box.upper + wider};
}

void BodyTree::build(const SceneBodies& bodies, double reach, double margin, bool same_bodies, int n_threads) {
  std::array<int, 3> n_images{};
  if (bodies.box()) {
    const Vec3d faces = bodies.box()->face_distances();
    const double distances[] = {faces.x, faces.y, faces.z};
    for (std::size_t k = 0; k < 3; ++k) {
      n_images[k] = std::max(1, static_cast<int>(std::ceil(reach * (1.0 + 0x1p-20) / distances[k])));
    }
  }
  shifts_.assign(bodies.box(), n_images);
  moves_.clear();
  for (std::uint64_t number = shifts_.home(); number < shifts_.size(); ++number)
    moves_.push_back(shifts_.shift(number));
  same_bodies = same_bodies && is_there_ && ids_.size() == bodies.size();
  margin_ = margin;
  if (!same_bodies) {
    ids_.clear();
    leaf_.assign(bodies.end(), 0);
    for (BodyId body = 0; body < bodies.end(); ++body) {
      if (!bodies.has(body)) continue;
      leaf_[body] = static_cast<std::uint32_t>(ids_.size());
      ids_.push_back(body);
    }
  }
  is_there_ = false;  // nor is it where an interruption ends what follows
  boxes_.resize(ids_.size());
  const double largest_shift = 3.0 * shifts_.largest_shift();
  share_range(n_threads, ids_.size(), kBodiesAShare, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) boxes_[k] = scene_box(bodies, ids_[k], margin, largest_shift);
  });
  if (same_bodies) {
    tree_.refit(boxes_, n_threads);
  }
  if (!same_bodies || tree_.is_worn()) tree_.build(boxes_, n_threads);
  is_there_ = true;
}

void BodyTree::move(const SceneBodies& bodies, BodyId body) {
  tree_.move(leaf_[body], scene_box(bodies, body, margin_, 3.0 * shifts_.largest_shift()));
}

void BodyTree::sort(const SceneBodies& bodies, bool with_poses, int n_threads) {
  const std::span<const std::uint32_t> leaves = tree_.order();
  place_.resize(leaves.size());
  order_.resize(leaves.size());
  for (std::size_t k = 0; k < leaves.size(); ++k) {
    place_[leaves[k]] = static_cast<std::uint32_t>(k);
    order_[k] = ids_[leaves[k]];
  }
  sorted_.fill(bodies, order_, 3.0 * shifts_.largest_shift(), false, with_poses, n_threads);
  if (margin_ > 0.0) sorted_.widen(margin_);
  tree_.pair_tasks(moves_, n_threads > 1 ? kTasksAThread * static_cast<std::size_t>(n_threads) : 1, tasks_);
}

}  // namespace vex
