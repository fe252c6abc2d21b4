#include "engine/scene/known_hull.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/referees/random_poses.h"

namespace vex {
namespace {

double depth(const Vec3d& x, const Vec3d& tip, double core) {
  return core - KnownHull::around_core(core, tip).most_of(x, false);
}

// Against balls of the hull, as many as there are: x is in the hull as deep as in the best of them. What floats may
// take is known; they may not add anything.
TEST(KnownHull, IsAsDeepAsInTheBallThatHoldsMost) {
  std::mt19937_64 random(1);
  constexpr int kBalls = 4000;
  int n_inside = 0, n_outside = 0;
  for (int k = 0; k < 4000; ++k) {
    const double core = 0.1 + 0.8 * random_in_unit_interval(random);
    const Vec3d tip = k % 10 == 0 ? Vec3d{} : 1.5 * random_direction(random);
    const Vec3d x = 1.2 * random_in_unit_interval(random) * tip + 0.7 * random_direction(random);
    double most = -HUGE_VAL;
    for (int j = 0; j <= kBalls; ++j) {
      const double part = static_cast<double>(j) / kBalls;
      most = std::max(most, (1.0 - part) * core - norm(x - part * tip));
    }
    const double found = depth(x, tip, core);
    // Of a tip that is hardly outside of the ball nothing is made.
    const bool has_tip = norm(tip) > (1.0 + 0x1p-10) * core;
    if (most > 0.0) {
      ASSERT_LE(found, most + (norm(tip) + core) / kBalls);
      ASSERT_GE(found, most - 0x1p-17 * norm(x) - (has_tip || norm(tip) <= core ? 0.0 : 0x1p-9 * core));
    } else {
      ASSERT_LE(found, (norm(tip) + core) / kBalls);
    }
    ++(found > 0.0 ? n_inside : n_outside);
  }
  EXPECT_GT(n_inside, 500);
  EXPECT_GT(n_outside, 500);
}

// Where the best ball is known without a search: x near the edge from the ball to the tip, no farther inside than it
// is.
TEST(KnownHull, IsNeverDeeperThanTheHull) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 100000; ++k) {
    const double core = 0.3 + 0.5 * random_in_unit_interval(random),
                 length = core * (1.01 + 3.0 * random_in_unit_interval(random));
    const Vec3d u = random_direction(random);
    const Vec3d axis = (1.0 / norm(u)) * u;
    Vec3d across = cross(axis, random_direction(random));
    across = (1.0 / norm(across)) * across;
    // A point of the cone's side, and one above it by a part in 2^30.
    const double sine = core / length, cosine = std::sqrt(1.0 - sine * sine);
    const Vec3d tip = length * axis, normal = sine * axis + cosine * across;
    const Vec3d foot = core * normal, on_side = foot + random_in_unit_interval(random) * (tip - foot);
    ASSERT_LT(depth(on_side + (0x1p-30 * core) * normal, tip, core), 0.0);
    // Not beyond the axis, where the other side is nearer.
    const double inside = std::fmin(0.1 * core, 0.9 * dot(on_side, across)) * random_in_unit_interval(random);
    const double found = depth(on_side - inside * normal, tip, core);
    ASSERT_LE(found, inside + 0x1p-48 * length);
    ASSERT_GE(found, inside - 0x1p-17 * length);
  }
}

TEST(KnownHull, OfABallOrAWayAlongTheTip) {
  EXPECT_EQ(depth({0.5, 0.0, 0.0}, {}, 2.0), 1.5);
  EXPECT_EQ(depth({0.5, 0.0, 0.0}, {2.0, 0.0, 0.0}, 2.0), 1.5);  // the tip is on the ball
  EXPECT_EQ(depth({0.0, 0.0, 0.0}, {0.0, 4.0, 0.0}, 2.0), 2.0);
  EXPECT_NEAR(depth({0.0, 3.0, 0.0}, {0.0, 4.0, 0.0}, 2.0), 0.5, 1e-5);
  EXPECT_LE(depth({0.0, 3.0, 0.0}, {0.0, 4.0, 0.0}, 2.0), 0.5);
  EXPECT_LE(depth({0.0, 4.0, 0.0}, {0.0, 4.0, 0.0}, 2.0), 0.0);
  EXPECT_LT(depth({0.0, 4.001, 0.0}, {0.0, 4.0, 0.0}, 2.0), 0.0);
}

TEST(KnownHull, OfAHalfSpaceIsTheWayAlongItsAxis) {
  KnownHull plane{{0.0f, 0.6f, -0.8f}, 1.0f, 0.0f};
  const Vec3d u = KnownHull::vector(plane.axis);
  for (const Vec3d& x : {Vec3d{1.0, 2.0, 3.0}, Vec3d{-1.0, -2.0, 3.0}, -1.0 * u, Vec3d{}}) {
    EXPECT_EQ(plane.most_of(x, true), dot(u, x));
  }
}

// Seen along any direction the point is among the corners, also of triangles that are lines or points; and it is in the
// direction that is asked for where the triangle is.
TEST(KnownFacet, HasAPointTowardsAnyDirection) {
  std::mt19937_64 random(4);
  int n_towards = 0, n_none = 0;
  for (int k = 0; k < 20000; ++k) {
    std::array<Vec3d, 3> corner;
    for (Vec3d& c : corner) c = random_direction(random);
    if (k % 10 == 1) corner[2] = 0.5 * (corner[0] + corner[1]);
    if (k % 10 == 2) corner[1] = corner[0];
    KnownFacet facet;
    for (std::size_t c = 0; c < 3; ++c) facet.corners[c] = KnownHull::floats(corner[c]);
    double weights[3], all = 0.0;
    for (double& w : weights) all += w = random_in_unit_interval(random);
    const bool is_met = k % 2 == 0;
    Vec3d x = random_direction(random);
    if (is_met) x = (weights[0] / all) * corner[0] + ((weights[1] / all) * corner[1] + (weights[2] / all) * corner[2]);
    const Vec3d point = facet.towards(x);
    if (norm_1(point) == 0.0) {
      ++n_none;
      continue;
    }
    for (int j = 0; j < 20; ++j) {
      const Vec3d n = random_direction(random);
      const double most = std::max({dot(n, corner[0]), dot(n, corner[1]), dot(n, corner[2])});
      ASSERT_LE(dot(n, point), most + 1e-6);
    }
    const double volume = std::fabs(dot(cross(corner[0], corner[1]), corner[2]));
    if (!is_met || volume < 0.01) continue;
    ++n_towards;
    ASSERT_LT(norm(cross(point, x)), 1e-4 * norm(point) * norm(x));
    ASSERT_GT(dot(point, x), 0.0);
  }
  EXPECT_GT(n_towards, 5000);
  EXPECT_GT(n_none, 500);
  EXPECT_EQ(norm_1(KnownFacet{}.towards({1.0, 2.0, 3.0})), 0.0);
}

}  // namespace
}  // namespace vex
