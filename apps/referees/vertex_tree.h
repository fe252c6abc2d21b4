// The support function of many points: a tree of boxes around them, of which most need not be opened.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/numeric/vec3.h"

namespace vex {

/// Finds the point that is farthest in a direction, in microseconds where a scan of 10^6 points takes milliseconds:
/// branch and bound over boxes, each around half of its parent's points and along their principal axes, so that on a
/// smooth surface a box is much thinner than it is wide (S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree", SIGGRAPH
/// 1996).
class VertexTree {
 public:
  explicit VertexTree(std::vector<Vec3d> points);

  /// The largest dot(dir, p - origin), short of it by at most gamma(16) |dir| times the distance of the farthest corner
  /// of the bounding box from the origin of the points.
  double height(const Vec3d& dir, const Vec3d& origin) const;

  std::size_t size() const { return points_.size(); }

 private:
  struct Node {
    Vec3d middle;
    std::array<Vec3d, 3> half_edges;
    std::size_t first = 0, last = 0;  // of the points
    std::size_t right = 0;            // child; the left one follows its parent. 0: a leaf
  };
  std::size_t build(std::size_t first, std::size_t last);

  std::vector<Vec3d> points_;
  std::vector<Node> nodes_;
};

}  // namespace vex
