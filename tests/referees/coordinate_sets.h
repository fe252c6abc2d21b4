// Sets of points for laws that hold to the last bit, and samples of what happens to them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"
#include "shapes/polytope.h"

namespace vex {

using Points = std::vector<Vec3d>;

inline constexpr int kLargestPowerOfTwo = 60;

/// Its point of the inside is a vertex, which needs no rounding; it claims no inner ball.
inline ConvexBody polytope(const Points& points) { return Polytope(points, points.front(), 0.0); }

inline Points scaled(const Points& points, int power_of_two) {
  Points result;
  for (const Vec3d& p : points) result.push_back(std::ldexp(1.0, power_of_two) * p);
  return result;
}

inline Points shuffled(Points points, std::mt19937_64& random) {
  std::shuffle(points.begin(), points.end(), random);
  return points;
}

inline int random_power_of_two(std::mt19937_64& random) {
  return static_cast<int>(random() % (2 * kLargestPowerOfTwo + 1)) - kLargestPowerOfTwo;
}

/// A whole number from -largest to largest.
inline double random_whole(std::mt19937_64& random, std::int64_t largest) {
  return static_cast<double>(static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(2 * largest + 1)) -
                             largest);
}
inline Vec3d random_whole_vector(std::mt19937_64& random, std::int64_t largest) {
  return {random_whole(random, largest), random_whole(random, largest), random_whole(random, largest)};
}

/// The sums, each of which must be exact: x + s rounds to nothing else where both differences give the parts back.
inline Points shifted(const Points& points, const Vec3d& shift) {
  Points result;
  for (const Vec3d& p : points) {
    result.push_back(p + shift);
    const Vec3d& sum = result.back();
    EXPECT_EQ(norm_1((sum - shift) - p) + norm_1((sum - p) - shift), 0.0) << "a shift that rounds shows nothing";
  }
  return result;
}

inline Vec3d rounded_to_grid(const Vec3d& p, double grid) {
  return grid * Vec3d{std::nearbyint(p.x / grid), std::nearbyint(p.y / grid), std::nearbyint(p.z / grid)};
}
inline Points rounded_to_grid(const Points& points, double grid) {
  Points result;
  for (const Vec3d& p : points) result.push_back(rounded_to_grid(p, grid));
  return result;
}

/// What a sample held.
struct Share {
  int n = 0, n_overlap = 0;
  void count(Outcome outcome) {
    ++n;
    n_overlap += outcome == Outcome::overlap ? 1 : 0;
  }
  void expect_representative() const {
    EXPECT_GE(10 * n_overlap, 3 * n) << n;
    EXPECT_LE(10 * n_overlap, 7 * n) << n;
  }
};

}  // namespace vex
