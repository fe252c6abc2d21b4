#include "engine/sampling/poses/pose_map.h"

#include <gtest/gtest.h>

#include "engine/sampling/monte_carlo.h"
#include "engine/sampling/points/random_stream.h"
#include "shapes/box.h"
#include "shapes/polytope.h"
#include "shapes/sphere.h"
#include "tests/referees/array_lanes.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

TEST(UniformInUnitBall, IsUniform) {
  // E r^3 = 1/2, E z^2 = 1/5, E x = E y = E z = 0.
  std::mt19937_64 random(3);
  constexpr int n = 200000;
  double r3 = 0.0;
  Vec3d mean, squares;
  for (int k = 0; k < n; ++k) {
    const double u = random_in_unit_interval(random), v = random_in_unit_interval(random);
    const Vec3d p = uniform_in_unit_ball(u, v, random_in_unit_interval(random));
    ASSERT_LE(norm(p), 1.0 + 1e-15);
    r3 += norm(p) * dot(p, p);
    mean = mean + p;
    squares = squares + Vec3d{p.x * p.x, p.y * p.y, p.z * p.z};
  }
  EXPECT_NEAR(r3 / n, 0.5, 4.5 * std::sqrt(1.0 / 12 / n));
  for (const double m : {mean.x, mean.y, mean.z}) EXPECT_NEAR(m / n, 0.0, 4.5 * std::sqrt(0.2 / n));
  for (const double s : {squares.x, squares.y, squares.z})
    EXPECT_NEAR(s / n, 0.2, 4.5 * std::sqrt((3.0 / 35 - 0.04) / n));
}

TEST(PoseMap, PutsBsCentreWhereTheDomainSays) {
  std::mt19937_64 random(4);
  const ConvexBody a = Box(1, 2, 3);
  const ConvexBody b =
      Polytope(std::vector<Vec3d>{{10, 0, 0}, {11, 0, 0}, {10, 1, 0}, {10, 0, 1}}, {10.25, 0.25, 0.25}, 0.1);
  for (const Domain& domain : {ball_domain(a, b), box_domain(a, b)}) {
    for (int k = 0; k < 1000; ++k) {
      const Vec3d c = random_pose(random, domain, b)(b.centre());
      if (domain.kind == Domain::Kind::ball) {
        EXPECT_LE(norm(c - domain.middle), domain.radius * (1 + 1e-14));
      } else {
        EXPECT_LE(std::fabs(c.x - domain.middle.x), domain.half_extent.x * (1 + 1e-13));
        EXPECT_LE(std::fabs(c.y - domain.middle.y), domain.half_extent.y * (1 + 1e-13));
        EXPECT_LE(std::fabs(c.z - domain.middle.z), domain.half_extent.z * (1 + 1e-13));
      }
    }
  }
}

TEST(PoseMap, LeavesAlignedBodiesUnturned) {
  const ConvexBody a = Box(1, 2, 3);
  MonteCarloSettings settings;
  settings.domain = ball_domain(a, a);
  settings.law = OrientationLaw::aligned();
  const Transformd pose = trial_pose(a, a, settings, 5);
  EXPECT_EQ(pose.row_x.x, 1.0);
  EXPECT_EQ(pose.row_x.y, 0.0);
  EXPECT_EQ(pose.row_z.z, 1.0);
  settings.law = OrientationLaw::isotropic();
  const Transformd turned = trial_pose(a, a, settings, 5);
  EXPECT_EQ(pose.translation.x, turned.translation.x) << "the law does not change the position drawn";
}

TEST(PoseMap, LanesGiveTheBitsOfOneLane) {
  constexpr int W = 4;
  std::mt19937_64 random(5);
  const ConvexBody a = Box(1, 2, 3), b = Sphere(1);
  for (const Domain& domain : {ball_domain(a, b), box_domain(a, b)}) {
    for (int round = 0; round < 200; ++round) {
      std::array<std::array<double, kPoseDimension>, W> points;
      std::array<ArrayLanes<W>, kPoseDimension> packet;
      for (std::size_t k = 0; k < W; ++k) {
        for (std::size_t j = 0; j < kPoseDimension; ++j) {
          points[k][j] = random_in_unit_interval(random);
          packet[j].lane[k] = points[k][j];
        }
      }
      const Transform<ArrayLanes<W>> wide = pose_at(packet, OrientationLaw::isotropic(), domain, b.centre());
      for (std::size_t k = 0; k < W; ++k) {
        const Transformd one = pose_at(points[k], OrientationLaw::isotropic(), domain, b.centre());
        ASSERT_EQ(bits_of(wide.row_x.y.lane[k]), bits_of(one.row_x.y));
        ASSERT_EQ(bits_of(wide.row_z.x.lane[k]), bits_of(one.row_z.x));
        ASSERT_EQ(bits_of(wide.translation.x.lane[k]), bits_of(one.translation.x));
        ASSERT_EQ(bits_of(wide.translation.z.lane[k]), bits_of(one.translation.z));
      }
    }
  }
}

TEST(PoseMap, OfThisStreamVersionIsTheseBits) {
  // A compiler, a flag or an edit that changes the draw must raise kStreamVersion: then, and only then, change this
  // test. (2: rays of the radial estimator alone.)
  ASSERT_EQ(kStreamVersion, 2);
  const ConvexBody cube = Box(1, 1, 1);
  MonteCarloSettings settings;
  settings.domain = ball_domain(cube, cube);
  const Transformd pose = trial_pose(cube, cube, settings, 1000000007);
  EXPECT_EQ(bits_of(pose.row_x.x), 0x3fcd432df44178f4ull);
  EXPECT_EQ(bits_of(pose.row_y.z), 0x3fd7d04ba5ed2031ull);
  EXPECT_EQ(bits_of(pose.row_z.y), 0xbfd56ff72b258787ull);
  EXPECT_EQ(bits_of(pose.translation.x), 0xbfb3024e325ec708ull);
  EXPECT_EQ(bits_of(pose.translation.y), 0xbfabda982c451a77ull);
  EXPECT_EQ(bits_of(pose.translation.z), 0xbfeb57fdd372bf26ull);
}

}  // namespace
}  // namespace vex
