#include "meshes/mesh_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/numeric/errors.h"
#include "engine/query/overlap.h"
#include "engine/scene/compound.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

PolygonSoup polygon(const std::vector<Vec3d>& corners) {
  PolygonSoup soup;
  soup.points = corners;
  for (std::uint32_t k = 0; k < corners.size(); ++k) soup.corners.push_back(k);
  soup.face_sizes.push_back(static_cast<std::uint32_t>(corners.size()));
  return soup;
}

double area(const std::vector<std::array<Vec3d, 3>>& triangles) {
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) sum += 0.5 * norm(cross(b - a, c - a));
  return sum;
}

TEST(MeshTriangles, ConvexPolygonsAreTheirFans) {
  EXPECT_EQ(triangles_of(polygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}})).size(), 2u);
  EXPECT_NEAR(area(triangles_of(polygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}))), 2.0, 1e-15);
  // A corner on a straight side, first or not, and a triangle as it comes, flat or not.
  EXPECT_NEAR(area(triangles_of(polygon({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0, 0, 0}}))), 2.0, 1e-15);
  EXPECT_EQ(triangles_of(polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}})).size(), 1u);
}

TEST(MeshTriangles, WhatIsNotItsFanIsRefused) {
  const std::vector<Vec3d> dart = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}};
  for (std::size_t k = 0; k < 4; ++k) {
    std::vector<Vec3d> turned;
    for (std::size_t j = 0; j < 4; ++j) turned.push_back(dart[(k + j) % 4]);
    EXPECT_THROW(triangles_of(polygon(turned)), InputError);
  }
  std::vector<Vec3d> star;
  for (int k = 0; k < 5; ++k) {
    const double angle = 0.8 * k * std::numbers::pi;
    star.push_back({std::cos(angle), std::sin(angle), 0.0});
  }
  EXPECT_THROW(triangles_of(polygon(star)), InputError);
  EXPECT_THROW(triangles_of(polygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}})), InputError);
  // A limacon, whose sides cross where it goes around its inner loop; from there on its fan turns left everywhere.
  for (const int n : {23, 25}) {
    std::vector<Vec3d> limacon;
    for (int k = 0; k < n; ++k) {
      const double angle = std::numbers::pi + 2.0 * k * std::numbers::pi / n, r = 1.0 + 2.0 * std::cos(angle);
      limacon.push_back({r * std::cos(angle), r * std::sin(angle), 0.0});
    }
    EXPECT_THROW(triangles_of(polygon(limacon)), InputError);
  }
  EXPECT_THROW(triangles_of(polygon({{0, 0, 0}, {1, 1, 0}, {HUGE_VAL, 0, 0}})), InputError);
  EXPECT_THROW(triangles_of(PolygonSoup()), InputError);
}

TEST(MeshTriangles, AFileBecomesACompoundThatIsItsSurface) {
  const std::vector<std::array<Vec3d, 3>> triangles =
      read_triangles(std::filesystem::path(VEX_SAMPLE_BODIES) / "pebble.obj");
  const Compound pebble = compound_of_triangles(triangles);
  ASSERT_EQ(pebble.size(), triangles.size());
  EXPECT_GT(pebble.size(), 100u);
  const ConvexBody speck = parse_shape("sphere:0.01").body;
  Vec3d middle;
  for (const auto& triangle : triangles) middle = middle + (1.0 / static_cast<double>(triangles.size())) * triangle[0];
  const Pose inside = Transformd{.translation = middle}, at_corner = Transformd{.translation = triangles[7][1]};
  EXPECT_EQ(overlap(pebble, speck, inside).verdict.outcome, Outcome::disjoint) << "it is a surface";
  EXPECT_EQ(overlap(pebble, speck, at_corner).verdict.outcome, Outcome::overlap);
  const CompoundContact hit = cast_ray(pebble, middle, {1.0, 0.0, 0.0});
  EXPECT_EQ(hit.contact.verdict.outcome, Outcome::overlap);
}

}  // namespace
}  // namespace vex
