#include "meshes/convexity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "meshes/surface.h"
#include "meshes/weld.h"
#include "refusal.h"
#include "soups.h"

namespace vex::tests {
namespace {

ConvexityCensus census_of(const PolygonSoup& soup) {
  const PolygonSurface surface = weld(soup).surface;
  const Triangles triangles = fan_triangles(surface, checked_half_edges(surface));
  return convexity_census(triangles, volume_and_centroid(triangles).centroid);
}

/// Of triangles that pair up, whatever the Euler characteristic.
ConvexityCensus census_of_triangles(const PolygonSoup& soup) {
  const PolygonSurface surface = weld(soup).surface;
  std::vector<std::array<std::uint32_t, 3>> corners;
  for (std::size_t i = 0; i < surface.corners.size(); i += 3) {
    corners.push_back({surface.corners[i], surface.corners[i + 1], surface.corners[i + 2]});
  }
  const std::optional<Triangles> triangles = paired_triangles(surface.vertices, corners);
  if (!triangles) {
    throw std::logic_error("the soup of a test is not closed");
  }
  return convexity_census(*triangles, volume_and_centroid(*triangles).centroid);
}

TEST(Convexity, OfConvexBodiesIsClean) {
  for (const PolygonSoup& soup : {tetrahedron_soup(), box_soup({-1, 2, 5}, {0, 7, 6}), octahedron_soup(),
                                  icosahedron_soup(), sphere_soup(7, [](const Vec3d& v) { return v; })}) {
    const ConvexityCensus census = census_of(soup);
    EXPECT_TRUE(census.locally_convex());
    EXPECT_EQ(census.winding_number, 1);
  }
}

TEST(Convexity, OfNeedlesAndPlatesIsClean) {
  // From the centroid of a thin body nearly every triangle is seen edge-on: solid angles, summed in double, made a
  // needle of 10^10 to 1 wind twice and a plate of 10^16 to 1 not at all.
  for (const double thin : {1e-3, 1e-8, 1e-10, 1e-14, 1e-16, 1e-20}) {
    for (const Vec3d& edges : {Vec3d{1, thin, thin}, Vec3d{1, 1, thin}, Vec3d{thin, 1, 0.3}}) {
      const PolygonSoup soup = box_soup({0, 0, 0}, edges);
      const ConvexityCensus census = census_of(soup);
      EXPECT_TRUE(census.locally_convex()) << thin;
      EXPECT_EQ(census.winding_number, 1) << thin;
      const double volume = convex_mesh_from(soup).measures.volume;
      EXPECT_NEAR(volume, edges.x * edges.y * edges.z, 2e-7 * volume) << "the floats' own rounding";
    }
  }
}

TEST(Convexity, OfTheGreatIcosahedronFailsByWindingAlone) {
  const ConvexityCensus census = census_of(great_icosahedron_soup());
  EXPECT_EQ(census.n_reflex_edges, 0U);
  EXPECT_EQ(census.n_blind_triangles, 0U);
  EXPECT_EQ(census.winding_number, 7);
  EXPECT_TRUE(contains(refusal(great_icosahedron_soup()), "winds 7 times about its centroid"));
}

TEST(Convexity, OfTheGreatDodecahedronFailsByWindingToo) {
  // Its pentagons share diagonals with one another, so each is cut from a point in its middle, which rounding moves.
  PolygonSoup soup;
  const PolygonSoup pentagons = great_dodecahedron_soup();
  soup.points = pentagons.points;
  for (std::size_t f = 0; f < 60; f += 5) {
    Vec3d middle;
    for (std::size_t k = 0; k < 5; ++k) {
      middle = middle + 0.2 * soup.points[pentagons.corners[f + k]];
    }
    const auto at = static_cast<std::uint32_t>(soup.points.size());
    for (std::size_t k = 0; k < 5; ++k) {
      soup.add_face({at, pentagons.corners[f + k], pentagons.corners[f + (k + 1) % 5]});
    }
    soup.points.push_back(middle);
  }
  const ConvexityCensus census = census_of_triangles(soup);
  EXPECT_LT(census.reflex_depth, 1e-6);
  EXPECT_EQ(census.n_blind_triangles, 0U);
  EXPECT_EQ(census.winding_number, 3);
}

TEST(Convexity, FindsTheReflexEdgeOfAnL) {
  const std::string message = refusal(l_prism_soup());
  EXPECT_TRUE(contains(message, "not convex"));
  EXPECT_TRUE(contains(message, "an edge is reflex: the edge from (1, 1, 0) to (1, 1, 1)"));
  EXPECT_TRUE(contains(message, "--hull"));
}

TEST(Convexity, MeasuresHowDeepAnEdgeIs) {
  // A cube whose top is folded down by 0.01 along its diagonal.
  PolygonSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0.99}, {1, 1, 1}, {0, 1, 0.99}};
  soup.n_parts = 1;
  soup.add_face({0, 3, 2, 1});
  soup.add_face({4, 5, 7});
  soup.add_face({5, 6, 7});
  for (const auto& [a, b] : {std::pair{0U, 1U}, {1U, 2U}, {2U, 3U}, {3U, 0U}}) {
    soup.add_face({a, b, b + 4});
    soup.add_face({a, b + 4, a + 4});
  }
  const ConvexityCensus census = census_of(soup);
  EXPECT_EQ(census.n_reflex_edges, 1U);
  EXPECT_NEAR(census.reflex_depth, 0.01, 1e-5);  // the other diagonal passes that far above
  const std::string message = refusal(soup);
  EXPECT_TRUE(contains(message, "an edge is reflex: the edge from"));
  EXPECT_TRUE(contains(message, "(0, 1, 0.99"));
  EXPECT_TRUE(contains(message, "(1, 0, 0.99"));
}

TEST(Convexity, DoesNotExaggerateWhereAShortEdgeOfALargeFacePointsAside) {
  // A prism over a polygon of so many sides that rounding turns some of them noticeably; nothing is deeper than that.
  std::vector<Vec3d> points;
  constexpr std::uint32_t n = 20000;
  std::vector<Face> faces(2);
  for (const double z : {0.0, 1.0}) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 2.0 * 3.14159265358979 * i / n;
      const auto six_decimals = [](double x) { return std::nearbyint(x * 1e6) / 1e6; };
      points.push_back({six_decimals(std::cos(angle)), six_decimals(std::sin(angle)), z});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    faces[0].push_back(n - 1 - i);
    faces[1].push_back(n + i);
    faces.push_back({i, j, n + j, n + i});
  }
  const ConvexMesh mesh = convex_mesh_from(soup_of(points, faces));
  EXPECT_TRUE(mesh.report.hull_used);
  EXPECT_LT(*mesh.report.reflex_depth * mesh.report.size, 1e-6);
}

TEST(Convexity, CountsTrianglesWithoutAreaAsBlind) {
  // The cube's edge from (0,0,0) to (1,0,0) has a vertex in the middle, which one of its faces does not know.
  PolygonSoup soup = box_soup({0, 0, 0}, {1, 1, 1});
  soup.points.push_back({0.5, 0, 0});
  soup = corner_added(soup, 2, 1, 8);  // 0 4 5 1 becomes 0 8 4 5 1
  soup.add_face({0, 4, 8});
  const ConvexityCensus census = census_of(soup);
  EXPECT_EQ(census.n_reflex_edges, 0U);
  EXPECT_EQ(census.n_blind_triangles, 1U);
  const ConvexMesh mesh = convex_mesh_from(soup);
  EXPECT_TRUE(mesh.report.hull_used);
  EXPECT_LT(mesh.report.reflex_depth, 1e-15);
  EXPECT_NEAR(mesh.measures.integrated_mean_curvature, 3.0 * 3.14159265358979323846, 1e-14 * 9.5);
  EXPECT_TRUE(contains(refusal(soup, {.convex_tolerance = 0.0}), "has no area"));
}

}  // namespace
}  // namespace vex::tests
