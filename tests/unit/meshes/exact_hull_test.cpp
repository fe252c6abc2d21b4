#include "meshes/exact_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "exact_polyhedron.h"
#include "meshes/convexity.h"
#include "meshes/determinant.h"
#include "meshes/hull.h"
#include "meshes/polyhedron_measures.h"
#include "meshes/weld.h"
#include "soups.h"

namespace vex::tests {
namespace {

std::vector<Vec3d> vertices_of(const PolygonSoup& soup) { return weld(soup).surface.vertices; }

void expect_exact_hull(const Triangles& hull) {
  const ConvexityCensus census = convexity_census(hull, volume_and_centroid(hull).centroid);
  EXPECT_EQ(census.n_reflex_edges, 0U);
  EXPECT_EQ(census.n_blind_triangles, 0U);
  EXPECT_EQ(census.winding_number, 1);
  std::size_t n_above = 0;
  for (const auto& [a, b, c] : hull.corners) {
    for (const Vec3d& v : hull.vertices) {
      n_above += orientation(hull.point(a), hull.point(b), hull.point(c), v).surely_positive() ? 1U : 0U;
    }
  }
  EXPECT_EQ(n_above, 0U);
}

PolygonSoup as_soup(const Triangles& triangles) {
  PolygonSoup soup;
  for (const Vec3d& v : triangles.vertices) {
    soup.points.push_back(v);
  }
  for (const auto& [a, b, c] : triangles.corners) {
    soup.add_face({a, b, c});
  }
  return soup;
}

TEST(ExactHull, OfConvexBodiesIsTheBodies) {
  for (const PolygonSoup& soup : {tetrahedron_soup(), icosahedron_soup(), box_soup({0, 0, 0}, {1, 2, 3}),
                                  sphere_soup(5, [](const Vec3d& v) { return v; })}) {
    const std::vector<Vec3d> vertices = vertices_of(soup);
    const std::optional<Triangles> hull = exact_hull(vertices);
    ASSERT_TRUE(hull.has_value());
    expect_exact_hull(*hull);
    EXPECT_EQ(hull->size(), 2 * vertices.size() - 4);
  }
}

TEST(ExactHull, AgreesWithQhullOnBodiesWithWaistsGridsAndRounding) {
  std::vector<std::array<double, 2>> waisted;
  for (int i = 0; i <= 20; ++i) {
    waisted.push_back({1.0 - 0.01 * (i % 2), -1.0 + 0.1 * i});
  }
  const auto turn = [](const Vec3d& p) {
    return Vec3d{0.6 * p.x - 0.8 * p.y + 3.1, 0.8 * p.x + 0.6 * p.y, p.z + 0.3 * p.x};
  };
  for (const PolygonSoup& soup :
       {revolution_soup(12, waisted, -1.5, 1.5), moved(capsule_soup(40, 12), turn), moved(torus_soup(20), turn),
        moved(l_prism_soup(), turn), moved(revolution_soup(5, waisted, -1.0, 1.0), turn)}) {
    const std::vector<Vec3d> vertices = vertices_of(soup);
    const std::optional<Triangles> hull = exact_hull(vertices);
    const std::optional<Triangles> qhull = paired_triangles(vertices, convex_hull_triangles(vertices));
    ASSERT_TRUE(hull.has_value() && qhull.has_value());
    expect_exact_hull(*hull);
    const double volume = volume_and_centroid(*qhull).volume;
    EXPECT_NEAR(volume_and_centroid(*hull).volume, volume, 1e-12 * volume);
  }
}

TEST(ExactHull, OfPointsThatAreCoplanarInCrowdsIsStillTheBody) {
  std::vector<Vec3d> lattice;  // 11 x 11 x 11 points of a cube
  for (int i = 0; i < 1331; ++i) {
    lattice.push_back({static_cast<double>(i % 11), static_cast<double>(i / 11 % 11), static_cast<double>(i / 121)});
  }
  const std::optional<Triangles> hull = exact_hull(lattice);
  ASSERT_TRUE(hull.has_value());
  expect_exact_hull(*hull);
  EXPECT_EQ(volume_and_centroid(*hull).volume, 1000.0);
  EXPECT_NEAR(integrated_mean_curvature(*hull), 30.0 * std::numbers::pi, 1e-12);
}

TEST(ExactHull, OfPointsThatSpanNoSolidIsNothing) {
  EXPECT_FALSE(exact_hull(std::vector<Vec3d>{}).has_value());
  EXPECT_FALSE(exact_hull(std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).has_value());
  EXPECT_FALSE(exact_hull(std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {5, 7, 0}}).has_value());
  EXPECT_FALSE(exact_hull(std::vector<Vec3d>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).has_value());
}

TEST(ExactHull, OfAThinTurnedCapsuleHasMeasuresToTwelveDigits) {
  // Convex only to rounding, and so thin that a hull's last bits in double show in V.
  for (int i = 0; i < 2; ++i) {
    const double angle = 0.3 + 0.4 * i;
    const std::vector<Vec3d> vertices = vertices_of(moved(capsule_soup(60, 15), [&](const Vec3d& p) {
      const double y = 3e-6 * p.y;
      return Vec3d{std::cos(angle) * p.x - std::sin(angle) * y, std::sin(angle) * p.x + std::cos(angle) * y, p.z};
    }));
    const std::optional<Triangles> hull = exact_hull(vertices);
    ASSERT_TRUE(hull.has_value());
    expect_exact_hull(*hull);
    const Measures exact = exact_measures(as_soup(*hull));
    EXPECT_NEAR(volume_and_centroid(*hull).volume, exact.volume, 1e-12 * exact.volume);
    EXPECT_NEAR(surface_area(*hull), exact.surface_area, 1e-12 * exact.surface_area);
    EXPECT_NEAR(integrated_mean_curvature(*hull), exact.integrated_mean_curvature,
                1e-12 * exact.integrated_mean_curvature);
  }
}

}  // namespace
}  // namespace vex::tests
