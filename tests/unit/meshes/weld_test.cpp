#include "meshes/weld.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "meshes/data/mesh_writers.h"
#include "refusal.h"
#include "soups.h"

namespace vex::tests {
namespace {

bool same_bits(const Vec3d& a, const Vec3d& b) {
  return std::bit_cast<std::uint64_t>(a.x) == std::bit_cast<std::uint64_t>(b.x) &&
         std::bit_cast<std::uint64_t>(a.y) == std::bit_cast<std::uint64_t>(b.y) &&
         std::bit_cast<std::uint64_t>(a.z) == std::bit_cast<std::uint64_t>(b.z);
}

void expect_same(const PolygonSurface& a, const PolygonSurface& b) {
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    EXPECT_TRUE(same_bits(a.vertices[i], b.vertices[i])) << "vertex " << i;
  }
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.face_begin, b.face_begin);
}

TEST(Weld, GivesCornersOfTheirOwnOneVertexAgainAndCountsTheRest) {
  const WeldedSurface welded = weld(with_own_corners(triangulated(box_soup({0, 0, 0}, {1, 1, 1}))));
  EXPECT_EQ(welded.surface.vertices.size(), 8U);
  EXPECT_EQ(welded.surface.n_faces(), 12U);
  EXPECT_EQ(welded.n_welded_vertices, 28U);
}

TEST(Weld, GivesTheSameSurfaceForEveryOrderOfPointsFacesAndCorners) {
  const PolygonSoup soup = dodecahedron_soup();
  const WeldedSurface welded = weld(soup);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    expect_same(weld(shuffled(soup, seed)).surface, welded.surface);
    expect_same(weld(shuffled(with_own_corners(soup), seed)).surface, welded.surface);
  }
}

TEST(Weld, OrdersVerticesByTheirCoordinates) {
  const WeldedSurface welded = weld(shuffled(icosahedron_soup(), 5));
  for (std::size_t i = 1; i < welded.surface.vertices.size(); ++i) {
    const Vec3d& a = welded.surface.vertices[i - 1];
    const Vec3d& b = welded.surface.vertices[i];
    EXPECT_TRUE(std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z));
  }
}

TEST(Weld, TakesMinusZeroForZero) {
  PolygonSoup soup = tetrahedron_soup();
  soup.points[0] = {0.0, 2.0, -0.0};
  PolygonSoup own = with_own_corners(soup);
  for (std::size_t i = 0; i < own.points.size(); i += 2) {
    own.points[i].x = own.points[i].x == 0.0 ? -0.0 : own.points[i].x;
    own.points[i].z = own.points[i].z == 0.0 ? 0.0 : own.points[i].z;
  }
  const WeldedSurface welded = weld(own);
  EXPECT_EQ(welded.surface.vertices.size(), 4U);
  expect_same(welded.surface, weld(soup).surface);
  for (const Vec3d& v : welded.surface.vertices) {
    EXPECT_FALSE(v.x == 0.0 && std::signbit(v.x));
    EXPECT_FALSE(v.z == 0.0 && std::signbit(v.z));
  }
}

TEST(Weld, DropsPointsThatNoFaceUses) {
  PolygonSoup unused;
  unused.points = {{9, 9, 9}};
  const PolygonSoup soup = joined(unused, tetrahedron_soup());
  const WeldedSurface welded = weld(soup);
  EXPECT_EQ(welded.surface.vertices.size(), 4U);
  EXPECT_EQ(welded.n_welded_vertices, 0U);
}

TEST(Weld, DropsCollapsedFacesAndRepeatedCorners) {
  PolygonSoup soup = corner_added(corner_added(tetrahedron_soup(), 0, 2, 1), 0, 0, 2);  // 0 1 2 becomes 2 0 1 1 2
  soup.add_face({0, 0, 1});                                                             // an edge
  soup.add_face({2, 2, 2});                                                             // a point
  const WeldedSurface welded = weld(soup);
  EXPECT_EQ(welded.n_collapsed_faces, 2U);
  expect_same(welded.surface, weld(tetrahedron_soup()).surface);
}

TEST(Weld, RefusesACoordinateThatIsNotFiniteAndNamesTheVertex) {
  for (const double bad : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    PolygonSoup soup = tetrahedron_soup();
    soup.points[2].y = bad;
    const std::string message = refusal(soup);
    EXPECT_TRUE(contains(message, "not finite"));
    EXPECT_TRUE(contains(message, "vertex 2 of 4"));
  }
}

TEST(Weld, RefusesASoupThatContradictsItself) {
  PolygonSoup soup = tetrahedron_soup();
  soup.corners[4] = 4;
  EXPECT_TRUE(contains(refusal(soup), "names a vertex that is not there (vertex 4 of 4)"));
  soup = tetrahedron_soup();
  soup.face_sizes.push_back(3);
  EXPECT_TRUE(contains(refusal(soup), "15 corners and 12 are given"));
}

}  // namespace
}  // namespace vex::tests
