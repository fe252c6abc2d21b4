#include "meshes/hull_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "meshes/convex_mesh.h"
#include "refusal.h"
#include "soups.h"

namespace vex::tests {
namespace {

/// A long body of revolution whose waist is `waist` of its radius, in so many rings that no edge is reflex by much.
PolygonSoup peanut(int n_rings, double waist) {
  std::vector<std::array<double, 2>> rings;
  for (int i = 0; i < n_rings; ++i) {
    const double z = -1.0 + 2.0 * i / (n_rings - 1);
    rings.push_back({1.0 - (1.0 - waist) * (1.0 - z * z), z});
  }
  return revolution_soup(16, rings, -1.5, 1.5);
}

TEST(HullCheck, TakesTheHullOfACapsuleThatIsReflexByRounding) {
  // A turned one: the straight part's quads are planar to rounding only.
  const PolygonSoup soup = moved(capsule_soup(64, 10), [](const Vec3d& p) {
    return Vec3d{0.8 * p.x - 0.6 * p.z + 0.1, p.y, 0.6 * p.x + 0.8 * p.z - 0.3};
  });
  const ConvexMesh mesh = convex_mesh_from(soup);
  EXPECT_TRUE(mesh.report.hull_used);
  EXPECT_GT(mesh.report.reflex_depth, 1e-9);
  EXPECT_LT(mesh.report.reflex_depth, 1e-6);
  EXPECT_NE(mesh.report.hull_added_volume, 0.0);
  EXPECT_LT(std::fabs(*mesh.report.hull_added_volume), 1e-5);
  EXPECT_EQ(mesh.report.n_vertices + mesh.report.n_dropped_vertices, soup.points.size());
  EXPECT_NEAR(mesh.measures.integrated_mean_curvature, std::numbers::pi * 2.0 + 4.0 * std::numbers::pi, 0.01);
  ASSERT_FALSE(mesh.report.notes.empty());
  EXPECT_TRUE(contains(mesh.report.notes.front(), "convex only within the tolerance"));
}

TEST(HullCheck, WithToleranceZeroRefusesWhatIsNotConvexExactly) {
  EXPECT_NO_THROW(convex_mesh_from(icosahedron_soup(), {.convex_tolerance = 0.0}));
  EXPECT_NO_THROW(convex_mesh_from(box_soup({0, 0, 0}, {1, 1, 1}), {.convex_tolerance = 0.0}));
  EXPECT_TRUE(contains(refusal(capsule_soup(64, 10), {.convex_tolerance = 0.0}), "tolerance 0"));
}

TEST(HullCheck, ObeysTheTolerance) {
  const PolygonSoup soup = peanut(3, 0.999);  // the waist is 0.001 deep, at a size of about 4.1
  EXPECT_TRUE(contains(refusal(soup), "edges are reflex"));
  EXPECT_TRUE(contains(refusal(soup, {.convex_tolerance = 1e-4}), "edges are reflex"));
  const ConvexMesh mesh = convex_mesh_from(soup, {.convex_tolerance = 1e-3});
  EXPECT_TRUE(mesh.report.hull_used);
  EXPECT_NEAR(*mesh.report.reflex_depth * mesh.report.size, 0.001, 2e-4);
  EXPECT_GT(mesh.report.hull_added_volume, 0.0);
}

TEST(HullCheck, RefusesManyShallowEdgesThatAddUp) {
  // Each edge of the waist is reflex by far less than the tolerance, the body by a tenth of its size.
  const double tolerance = 1e-4;
  const std::string message = refusal(peanut(2000, 0.8), {.convex_tolerance = tolerance});
  EXPECT_TRUE(contains(message, "lies below its convex hull at"));
  EXPECT_FALSE(contains(message, "edges are reflex"));
  EXPECT_TRUE(contains(message, "--hull"));
}

TEST(HullCheck, RefusesATriangleThatCutsThroughTheHull) {
  // All vertices are on the hull, one edge is the wrong diagonal of a deep quad.
  PolygonSoup soup = box_soup({0, 0, 0}, {1, 1, 1});
  soup.points[7] = {1.0, 1.0, 0.8};
  EXPECT_TRUE(contains(refusal(soup), "reflex"));
  EXPECT_TRUE(contains(refusal(soup, {.convex_tolerance = 1e-3}), "not convex"));
}

TEST(HullCheck, RefusesATinyToleranceOrANonsensicalOne) {
  EXPECT_THROW(convex_mesh_from(icosahedron_soup(), {.convex_tolerance = -1.0}), UsageError);
  EXPECT_THROW(convex_mesh_from(icosahedron_soup(), {.convex_tolerance = std::nan("")}), UsageError);
}

TEST(HullCheck, RefusesACrumpledSheetThinnerThanTheTolerance) {
  // Everything in it is near its hull's surface, and yet it is nobody's convex body.
  const PolygonSoup soup = moved(capsule_soup(16, 6), [](const Vec3d& p) {
    return Vec3d{p.x, 1e-8 * p.y * (1.0 + std::sin(7.0 * p.z)), p.z};
  });
  EXPECT_TRUE(contains(refusal(soup), "thick"));
}

TEST(HullCheck, WithAReasonableToleranceRefusesBadSolids) {
  for (const PolygonSoup& soup : {l_prism_soup(), great_icosahedron_soup()}) {
    for (const double tolerance : {1e-6, 1e-3, 1e-2}) {
      EXPECT_TRUE(contains(refusal(soup, {.convex_tolerance = tolerance}), "not convex"));
    }
  }
}

}  // namespace
}  // namespace vex::tests
