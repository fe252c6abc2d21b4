// FCL's DynamicAABBTreeCollisionManager: a scene of many bodies in open space.
//
// FCL bounds a body that is turned by the cube around its ball (its issue 509): of needles the tree sees balls.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/numeric/pose.h"
#include "engine/support/convex_body.h"

namespace vex {

class FclScene {
 public:
  /// Bodies of these shapes, `shape_of` of each. Throws InputError where FCL has no such shape.
  FclScene(std::span<const ConvexBody> shapes, std::span<const std::uint32_t> shape_of);
  FclScene(FclScene&&) noexcept;
  ~FclScene();

  /// Places the bodies, makes the tree of them and asks it for all pairs of which `collide` says that they collide.
  void overlapping_pairs(std::span<const Pose> poses, std::vector<std::pair<std::uint32_t, std::uint32_t>>& out);
  /// How many pairs the tree sent to `collide`.
  std::uint64_t n_asked() const;

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace vex
