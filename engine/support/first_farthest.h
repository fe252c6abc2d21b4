// Which of a few points is the farthest along a direction, of one lane.
#pragma once

#include <cstdint>

#include "engine/numeric/lane.h"
#include "engine/numeric/vec3.h"

namespace vex {

/// The number of the first of `n` points, one at least, whose computed product with `dir` is the largest: `point(k)`
/// for k below n. Without a jump but for the loop: which of them it is nothing foretells, and of a dozen three were
/// wrongly foretold in each scan.
template <class PointOf>
std::uint64_t first_farthest(std::uint64_t n, const Vec3d& dir, const PointOf& point) {
  double largest = dot(point(0), dir);
  std::uint64_t first = 0;
  for (std::uint64_t k = 1; k < n; ++k) {
    const double value = dot(point(k), dir);
    first = blend(value > largest, k, first);
    largest = larger(value, largest);
  }
  return first;
}

}  // namespace vex
