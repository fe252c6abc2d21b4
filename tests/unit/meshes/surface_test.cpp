#include "meshes/surface.h"

#include <gtest/gtest.h>

#include "meshes/data/mesh_writers.h"
#include "meshes/triangles.h"
#include "meshes/weld.h"
#include "refusal.h"
#include "soups.h"

namespace vex::tests {
namespace {

std::string surface_refusal(const PolygonSoup& soup) {
  return refusal_of([&] { checked_half_edges(weld(soup).surface); });
}

TEST(Surface, PairsEveryHalfEdgeWithTheOneThatRunsBack) {
  for (const PolygonSoup& soup : {box_soup({0, 0, 0}, {1, 2, 3}), dodecahedron_soup(), capsule_soup(20, 5)}) {
    const PolygonSurface surface = weld(soup).surface;
    const std::vector<std::uint32_t> mates = checked_half_edges(surface);
    for (std::uint32_t h = 0; h < mates.size(); ++h) {
      EXPECT_EQ(mates[mates[h]], h);
      EXPECT_NE(mates[h], h);
    }
    const Triangles triangles = fan_triangles(surface, mates);
    EXPECT_EQ(triangles.size(), surface.corners.size() - 2 * surface.n_faces());
    for (std::uint32_t h = 0; h < triangles.mates.size(); ++h) {
      EXPECT_EQ(triangles.mates[triangles.mates[h]], h);
      EXPECT_EQ(triangles.tail(triangles.mates[h]), triangles.head(h));
      EXPECT_EQ(triangles.head(triangles.mates[h]), triangles.tail(h));
    }
  }
}

TEST(Surface, WithoutFacesIsRefused) {
  EXPECT_TRUE(contains(surface_refusal(PolygonSoup{}), "no faces"));
  PolygonSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  soup.add_face({0, 0, 1});
  EXPECT_TRUE(contains(surface_refusal(soup), "no faces"));
}

TEST(Surface, OfTwoBodiesIsRefusedBeforeAnythingElse) {
  const PolygonSoup cube = box_soup({0, 0, 0}, {1, 1, 1});
  PolygonSoup two = joined(cube, box_soup({2, 0, 0}, {3, 1, 1}));
  std::string message = surface_refusal(two);
  EXPECT_TRUE(contains(message, "not one body (2 surfaces that share no vertex"));
  EXPECT_TRUE(contains(message, "(0, 0, 0)"));
  EXPECT_TRUE(contains(message, "(2, 0, 0)"));
  EXPECT_TRUE(contains(message, "--hull"));
  message = surface_refusal(face_removed(two, 0));  // open as well, but the first condition is named
  EXPECT_TRUE(contains(message, "not one body"));
}

TEST(Surface, WithAHoleIsRefusedAndTheEdgesAreCounted) {
  const std::string message = surface_refusal(face_removed(box_soup({0, 0, 0}, {1, 1, 1}), 0));
  EXPECT_TRUE(contains(message, "not closed (4 of its 12 edges are not shared by exactly two faces"));
  EXPECT_TRUE(contains(message, "the edge from (0, 0, 0) to (0, 0, 1) has 1"));
  EXPECT_TRUE(contains(message, "--hull"));
}

TEST(Surface, WithADoubledFaceIsRefused) {
  PolygonSoup soup = tetrahedron_soup();
  soup.add_face({0, 1, 2});
  EXPECT_TRUE(contains(surface_refusal(soup), "3 of its 6 edges"));
  EXPECT_TRUE(contains(surface_refusal(soup), "has 3"));
}

TEST(Surface, OfCubesThatShareAnEdgeIsRefused) {
  const PolygonSoup soup = joined(box_soup({0, 0, 0}, {1, 1, 1}), box_soup({1, 1, 0}, {2, 2, 1}));
  EXPECT_TRUE(contains(surface_refusal(soup), "(1 of its 23 edges are not shared by exactly two faces"));
  EXPECT_TRUE(contains(surface_refusal(soup), "has 4"));
}

TEST(Surface, WithOneFaceTheWrongWayRoundIsRefused) {
  const std::string message = surface_refusal(face_turned(box_soup({0, 0, 0}, {1, 1, 1}), 2));
  EXPECT_TRUE(contains(message, "not consistently oriented (4 of 12 edges"));
  EXPECT_TRUE(contains(message, "counter-clockwise"));
}

TEST(Surface, OfTheWrongKindIsRefusedWithItsEulerCharacteristic) {
  EXPECT_TRUE(contains(surface_refusal(torus_soup(8)), "64 vertices - 128 edges + 64 faces = 0, not 2"));
  EXPECT_TRUE(contains(surface_refusal(great_dodecahedron_soup()), "12 vertices - 30 edges + 12 faces = -6, not 2"));
  const PolygonSoup touching = joined(box_soup({0, 0, 0}, {1, 1, 1}), box_soup({1, 1, 1}, {2, 2, 2}));
  EXPECT_TRUE(contains(surface_refusal(touching), "15 vertices - 24 edges + 12 faces = 3, not 2"));
}

TEST(Surface, AcceptsTheGreatIcosahedronWhichIsOfTheKindOfASphere) {
  EXPECT_NO_THROW(checked_half_edges(weld(great_icosahedron_soup()).surface));
}

TEST(Surface, TurnedInsideOutTwiceIsItself) {
  const PolygonSurface surface = weld(dodecahedron_soup()).surface;
  PolygonSurface turned = surface;
  turned.turn_inside_out();
  EXPECT_NE(turned.corners, surface.corners);
  turned.turn_inside_out();
  EXPECT_EQ(turned.corners, surface.corners);
}

}  // namespace
}  // namespace vex::tests
