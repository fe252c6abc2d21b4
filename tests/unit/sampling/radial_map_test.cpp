#include "engine/sampling/radial_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "shapes/any_shape.h"
#include "shapes/ellipsoid.h"
#include "tests/referees/array_lanes.h"
#include "tests/referees/polytopes.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

TEST(MatchingEllipsoid, OfAnEllipsoidIsItself) {
  for (const Vec3d& d : {Vec3d{1, 1, 1}, Vec3d{1, 2, 3}, Vec3d{4, 1, 1}, Vec3d{1e-3, 1, 1}}) {
    const MatchingEllipsoid found = matching_ellipsoid(Ellipsoid(d.x, d.y, d.z));
    EXPECT_NEAR(std::sqrt(found.q.xx), d.x, 0.15 * d.x);
    EXPECT_NEAR(std::sqrt(found.q.yy), d.y, 0.15 * d.y);
    EXPECT_NEAR(std::sqrt(found.q.zz), d.z, 0.15 * d.z);
    EXPECT_EQ(norm(found.centre), 0.0);
  }
}

TEST(MatchingEllipsoid, OfABoxHasTheProportionsOfItsEdges) {
  const MatchingEllipsoid found = matching_ellipsoid(parse_shape("box:64,1,0.01").body);
  EXPECT_NEAR(found.q.xx / found.q.yy, 64.0 * 64.0, 0.05 * 64.0 * 64.0);
  EXPECT_NEAR(found.q.yy / found.q.zz, 1e4, 0.05 * 1e4);
}

TEST(MatchingEllipsoid, GoesWhereTheBodyGoes) {
  const std::vector<Vec3d> box = box_vertices(8.0, 2.0, 1.0);
  std::mt19937_64 random(1);
  Transformd pose = random_rotation(random);
  pose.translation = {3.0, -1.0, 2.0};
  std::vector<Vec3d> placed;
  for (const Vec3d& v : box) placed.push_back(pose(v));
  const MatchingEllipsoid there = matching_ellipsoid(Polytope(placed, pose.translation, 0.5));
  EXPECT_LE(norm(there.centre - pose.translation), 0.2);
  const MatchingEllipsoid here = matching_ellipsoid(Polytope(box, {}, 0.5));
  // x^T Q x of turned vectors
  const auto form = [](const Symmetric<double>& q, const Vec3d& x) {
    return (q.xx * x.x * x.x + q.yy * x.y * x.y + q.zz * x.z * x.z) +
           2.0 * (q.xy * x.x * x.y + q.xz * x.x * x.z + q.yz * x.y * x.z);
  };
  const Vec3d none;
  for (const Vec3d& x : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
    pose.translation = none;
    EXPECT_NEAR(form(there.q, pose(x)), form(here.q, x), 0.3 * form(here.q, x));
  }
}

TEST(MatchingEllipsoid, OfAFlatBodyIsFlatAndOfALineALine) {
  const MatchingEllipsoid plate = matching_ellipsoid(parse_shape("plate:1,2").body);
  EXPECT_EQ(plate.q.zz, 0.0);
  EXPECT_GT(plate.q.xx, 0.1);
  const MatchingEllipsoid needle = matching_ellipsoid(parse_shape("needle:2").body);
  EXPECT_EQ(needle.q.xx + needle.q.yy, 0.0);
  EXPECT_GT(needle.q.zz, 0.5);
}

TEST(MatchingEllipsoid, OfAPointIsThePoint) {
  const std::vector<Vec3d> vertices(3, Vec3d{1.0, 2.0, 3.0});
  const MatchingEllipsoid found = matching_ellipsoid(Polytope(vertices, vertices[0], 0.0));
  EXPECT_EQ(norm(found.centre - vertices[0]), 0.0);
  EXPECT_EQ(found.q.xx + found.q.yy + found.q.zz, 0.0);
}

TEST(RadialMap, DrawsRotationsOfTheLaw) {
  const ConvexBody a = parse_shape("box:1,2,3").body, b = parse_shape("cone:1,1").body;
  for (const OrientationLaw& law : {OrientationLaw::isotropic(), OrientationLaw::aligned(), OrientationLaw::cone(30.0),
                                    OrientationLaw::onsager(4.0), OrientationLaw::fixed(1, 2, 3, 4)}) {
    const RadialMap map(a, b, law);
    EXPECT_EQ(map.dimension(), 3 + law.dimension());
    std::mt19937_64 random(2);
    double sum_zz = 0.0, sum_zz_sq = 0.0, sum_of_law = 0.0;
    constexpr int kTrials = 20000;
    for (int k = 0; k < kTrials; ++k) {
      std::array<double, RadialMap::kMaxDimension> point;
      for (double& u : point) u = random_in_unit_interval(random);
      const RadialRay<double> ray = map(std::span<const double>(point));
      const Transformd& r = ray.rotation;
      EXPECT_NEAR(dot(r.row_x, r.row_x), 1.0, 1e-14);
      EXPECT_NEAR(dot(r.row_x, r.row_y), 0.0, 1e-14);
      EXPECT_NEAR(dot(cross(r.row_x, r.row_y), r.row_z), 1.0, 1e-14);
      sum_zz += r.row_z.z;
      sum_zz_sq += r.row_z.z * r.row_z.z;
      std::array<double, OrientationLaw::kMaxDimension> other;
      for (double& u : other) u = random_in_unit_interval(random);
      const double zz = law.rotation(std::span<const double>(other)).row_z.z;
      sum_of_law += zz * zz;
    }
    EXPECT_NEAR(sum_zz_sq / kTrials, sum_of_law / kTrials, 4.0 * 0.6 * std::sqrt(2.0 / kTrials)) << law.name();
    if (law.dimension() > 0) {
      EXPECT_NEAR(sum_zz / kTrials, 0.0, 4.0 / std::sqrt(kTrials)) << law.name();
    }
  }
}

TEST(RadialMap, GivesEveryLaneWhatOneLaneGives) {
  using Lanes = ArrayLanes<4>;
  const ConvexBody a = parse_shape("box:1,2,3").body, b = parse_shape("cone:1,1").body;
  for (const OrientationLaw& law : {OrientationLaw::isotropic(), OrientationLaw::cone(30.0)}) {
    const RadialMap map(a, b, law);
    std::mt19937_64 random(3);
    std::array<Lanes, RadialMap::kMaxDimension> lanes;
    std::array<std::array<double, RadialMap::kMaxDimension>, 4> points;
    for (std::size_t c = 0; c < RadialMap::kMaxDimension; ++c) {
      for (std::size_t j = 0; j < 4; ++j) lanes[c].lane[j] = points[j][c] = random_in_unit_interval(random);
    }
    const RadialRay<Lanes> all = map(std::span<const Lanes>(lanes));
    for (std::size_t j = 0; j < 4; ++j) {
      const RadialRay<double> one = map(std::span<const double>(points[j]));
      EXPECT_EQ(all.dir.x.lane[j], one.dir.x);
      EXPECT_EQ(all.rotation.row_z.y.lane[j], one.rotation.row_z.y);
      EXPECT_EQ(all.weight.lane[j], one.weight);
      EXPECT_EQ(all.normals[2].z.lane[j], one.normals[2].z);
    }
  }
}

}  // namespace
}  // namespace vex
