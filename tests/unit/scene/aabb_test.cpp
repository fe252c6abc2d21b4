#include "engine/scene/aabb.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/numeric/rounding.h"
#include "tests/referees/bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

double of_axis(const Vec3d& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }
Vec3d row(const Transformd& pose, int axis) { return axis == 0 ? pose.row_x : axis == 1 ? pose.row_y : pose.row_z; }

std::vector<Transformd> poses(std::mt19937_64& random) {
  std::vector<Transformd> poses(1);
  for (const double far : {0.0, 1.0, 1e6}) {
    for (int k = 0; k < 20; ++k) {
      poses.push_back(random_rotation(random));
      poses.back().translation = far * random_direction(random);
    }
  }
  return poses;
}

// Points of the body: its vertices, or what a curved one answers in all kinds of directions.
std::vector<Vec3d> points_of(const ConvexBody& body, std::mt19937_64& random) {
  std::vector<Vec3d> points = vertices_of(body);
  for (int k = 0; k < 100; ++k) points.push_back(body.support(random_direction(random)));
  return points;
}

TEST(BoundingBox, HoldsThePlacedBodyAndTouchesItOnAllSides) {
  std::mt19937_64 random(31);
  for (const char* name : kTestBodies) {
    SCOPED_TRACE(name);
    const ConvexBody body = parse_shape(name).body;
    const std::vector<Vec3d> points = points_of(body, random);
    for (const Transformd& pose : poses(random)) {
      const Aabb box = bounding_box(body, pose);
      for (const Vec3d& point : points) ASSERT_TRUE(box.contains(pose(point)));
      const double error =
          4.0 * body.support_error() + 64.0 * kUnitRoundoff * (body.reach() + norm_1(pose.translation));
      for (int axis = 0; axis < 3; ++axis) {
        const double up = of_axis(pose(body.support(row(pose, axis))), axis);
        const double low = of_axis(pose(body.support(-row(pose, axis))), axis);
        EXPECT_LE(of_axis(box.upper, axis) - up, error);
        EXPECT_LE(low - of_axis(box.lower, axis), error);
      }
    }
  }
}

TEST(BoundingBox, OfANeedleAlongTheDiagonalIsTheNeedles) {
  const double s = std::sqrt(0.5);
  const Transformd pose{{s, -s, 0}, {s, s, 0}, {0, 0, 1}, {}};
  const Aabb box = bounding_box(parse_shape("box:10,.1,.1").body, pose);
  EXPECT_NEAR(box.upper.x, 10.1 * s / 2, 1e-12);
  EXPECT_NEAR(box.upper.z, 0.05, 1e-12);
}

TEST(OrientedBoundingBox, HoldsThePlacedBodyWhateverItsPose) {
  std::mt19937_64 random(32);
  for (const char* name : kTestBodies) {
    SCOPED_TRACE(name);
    const ConvexBody body = parse_shape(name).body;
    const std::vector<Vec3d> points = points_of(body, random);
    const Aabb own = bounding_box(body, Pose());
    for (const Transformd& pose : poses(random)) {
      const OrientedBox box = oriented_bounding_box(body, pose);
      const Transformd& axes = box.world_from_box;
      const double far = norm_1(pose.translation) + body.reach();
      for (const Vec3d& point : points) {
        const Vec3d p = axes.direction_to_b(pose(point) - axes.translation);
        for (int axis = 0; axis < 3; ++axis) {
          // The rows are orthonormal to rounding only, and the difference here is rounded, too.
          ASSERT_LE(std::fabs(of_axis(p, axis)), of_axis(box.half_extents, axis) + 64.0 * kUnitRoundoff * far);
        }
      }
      for (int axis = 0; axis < 3; ++axis) {
        const double half = 0.5 * (of_axis(own.upper, axis) - of_axis(own.lower, axis));
        EXPECT_LE(of_axis(box.half_extents, axis), half + 128.0 * kUnitRoundoff * far);
      }
    }
  }
}

TEST(Aabb, MeetsWhatSharesAPointWithIt) {
  const Aabb unit{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(unit.meets({{1, 1, 1}, {2, 2, 2}}));
  EXPECT_FALSE(unit.meets({{1.0 + 0x1p-52, 0, 0}, {2, 1, 1}}));
  EXPECT_TRUE(unit.meets({{-1, -1, -1}, {2, 2, 2}}));
  EXPECT_FALSE(unit.meets({{0, 0, -2}, {1, 1, -1}}));
  const Aabb hull = hull_of(unit, {{-1, 0.5, 0.5}, {0.5, 0.5, 3}});
  EXPECT_EQ(hull.lower.x, -1.0);
  EXPECT_EQ(hull.lower.y, 0.0);
  EXPECT_EQ(hull.upper.x, 1.0);
  EXPECT_EQ(hull.upper.z, 3.0);
}

}  // namespace
}  // namespace vex
