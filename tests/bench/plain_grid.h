// What one writes in an afternoon: a cell grid and a separating-axis test for boxes, one pair at a time, in plain
// double precision. Fast, and unproven: what the scene's time is held against.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/bench/scene_cases.h"

namespace vex {

struct PlainCounts {
  std::uint64_t n_seen = 0, n_balls = 0, n_tests = 0;
};

/// Of boxes in a cubic periodic box, that no body is longer than half of; counting sort by cells as large as the
/// largest ball, half a stencil. Where the box has fewer than three cells along an edge, all pairs with the nearest
/// copy.
class PlainGrid {
 public:
  explicit PlainGrid(const SceneCase& scene);
  /// Index and pairs, in no order.
  void overlapping_pairs(std::vector<std::uint64_t>& out);
  const PlainCounts& counts() const { return counts_; }

 private:
  struct Body {
    Vec3d at, half, x, y, z;  // axes: columns of R
    double radius, inner;
    std::uint32_t id;
  };
  void sort(int n_cells);
  void test(const Body& a, const Body& b, const Vec3d& shift, std::vector<std::uint64_t>& out);

  double edge_;
  double largest_ = 0.0;
  std::vector<Body> given_, bodies_;
  std::vector<std::uint32_t> starts_, cell_of_;
  PlainCounts counts_;
};

}  // namespace vex
