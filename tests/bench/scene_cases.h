// Scenes that vex_scene_bench measures: shapes, poses, a cubic periodic box or open space.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace vex {

struct SceneCase {
  std::string name;
  std::vector<ConvexBody> shapes;
  std::vector<Vec3d> edges;  // of shapes that are boxes
  std::vector<ShapeId> shape_of;
  std::vector<Pose> poses;
  std::optional<PeriodicBox> box;

  std::size_t size() const { return poses.size(); }
  /// The bodies, added one after the other.
  Scene scene(const SceneSettings& settings) const;
};

/// Random orientations and places; eta: the volume of all bodies by that of the box.
SceneCase cubes(std::size_t n, double eta = 0.2444);
/// Boxes 1 x 1 x 50, with about two overlaps each.
SceneCase needles(std::size_t n);
/// Cubes of 24 edges from 1 to 1000, their numbers as edge^-1.5; the box is twice as long as the largest is across.
SceneCase unlike_cubes(std::size_t n);
/// Hulls of 100 points on a sphere of diameter 1, at the density of `cubes`.
SceneCase hulls(std::size_t n);

/// Without its box: for those who know none.
SceneCase in_open_space(SceneCase scene);
/// The same bodies, of one shape, with numbers along a curve that fills the box (G. M. Morton's).
SceneCase numbered_by_place(SceneCase scene);

}  // namespace vex
