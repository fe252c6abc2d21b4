// Found 2026-11 by a hostile referee: distances of overlapping bodies with a WarmStart whose points were up to two body
// lengths off across the normal, not rough. Verdicts and bounds were right.
//
// Cause. A hull that is known from another pose need not be convex once its points are asked for again. The foot of the
// origin on the plane of its nearest face may then lie beside that face, and its weights there, one of them negative,
// were cut off at 0. The points are now those where the normal leaves the hull.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "engine/numeric/quaternion.h"
#include "engine/query/separation.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

Transformd pose_of(double w, double x, double y, double z, const Vec3d& translation) {
  Transformd pose = rotation_from_quaternion(w, x, y, z);
  pose.translation = translation;
  return pose;
}

// How far the points are from showing the distance along the normal.
double off_of(const Separation& found) {
  const Vec3d off = found.point_b - found.point_a - found.signed_distance * found.normal;
  return std::sqrt(dot(off, off));
}

TEST(BulgingHulls, HaveTheirFootWithinAFace) {
  const ConvexBody a = parse_shape("cone:2,1").body, b = parse_shape("icosahedron:1").body;
  SeparationSettings settings;
  settings.relative_gap = 1e-3;
  WarmStart warm;
  signed_distance(a, b, pose_of(0.302, -0.772, 0.716, 0.141, {-0.223, 0.319, -0.314}), settings, &warm);
  const Separation found =
      signed_distance(a, b, pose_of(0.28, -0.798, 0.746, 0.166, {-0.239, 0.346, -0.285}), settings, &warm);
  ASSERT_TRUE(found.has_witnesses);
  EXPECT_LT(off_of(found), 4e-3);
}

TEST(BulgingHulls, OfManyMotionsAsWell) {
  std::mt19937_64 random(7);
  const auto between = [&random](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  for (const auto& [of_a, of_b] : {std::pair{"cone:2,1", "icosahedron:1"}, std::pair{"cone:2,1", "box:1,2,3"},
                                   std::pair{"prism:300,0.02,1", "prism:300,0.02,1"}}) {
    const ConvexBody a = parse_shape(of_a).body, b = parse_shape(of_b).body;
    const double size = a.circumradius() + b.circumradius();
    SeparationSettings settings;
    settings.relative_gap = 1e-3;
    for (int pair = 0; pair < 4000; ++pair) {
      double q[4];
      for (double& x : q) x = between(-1.0, 1.0);
      Vec3d t{between(-0.15, 0.15) * size, between(-0.15, 0.15) * size, between(-0.15, 0.15) * size};
      const double step = std::pow(10.0, between(-3.0, -0.7));
      WarmStart warm;
      for (int k = 0; k < 2; ++k) {
        const Separation found = signed_distance(a, b, pose_of(q[0], q[1], q[2], q[3], t), settings, &warm);
        if (found.has_witnesses && !found.is_rough) {
          ASSERT_LE(off_of(found), 1.01e-3 * (size + std::fabs(found.signed_distance))) << of_a << " " << pair;
        }
        for (double& x : q) x += between(-step, step);
        t = t + Vec3d{between(-step, step), between(-step, step), between(-step, step)};
      }
    }
  }
}

}  // namespace
}  // namespace vex
