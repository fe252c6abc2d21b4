// The bodies of a scene in the order of a broad phase, so that neighbours stand near each other in memory (internal).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/scene/aabb.h"
#include "engine/scene/scene_bodies.h"

namespace vex {

/// Places are 0 ... size - 1. Columns have room for a packet behind them.
struct SortedBodies {
  LargeVector<BodyId> id;
  LargeVector<ShapeId> shape;
  LargeVector<double> poses;            // rows of four doubles, kRowsABody a body; or none
  LargeVector<double> x, y, z, radius;  // of the circumscribed balls, widened (E26), or of that alone

  std::size_t size() const { return id.size(); }

  /// `order`: the number of the body at each place. `largest_shift`: what may be added to a centre. Of `boxes` the
  /// radii are what rounding adds. Poses are copied only where they will be asked.
  void fill(const SceneBodies& bodies, std::span<const BodyId> order, double largest_shift, bool boxes, bool with_poses,
            int n_threads);
  bool has_poses() const { return poses.size() == kNumbersABody * size(); }
  /// To the radii, so that balls meet whose bodies are this near; half of it to each.
  void widen(double distance);
};

/// The bounds of all bodies' centres.
Aabb bounds_of_centres(const SceneBodies& bodies, int n_threads);

}  // namespace vex
