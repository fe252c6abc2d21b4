#include "meshes/convex_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "meshes/data/mesh_writers.h"
#include "refusal.h"
#include "soups.h"

namespace vex::tests {
namespace {

TEST(ConvexMesh, ReportsWhatItFound) {
  const ConvexMesh mesh = convex_mesh_from(with_own_corners(box_soup({0, 0, 0}, {1, 2, 2})));
  EXPECT_EQ(mesh.report.n_vertices, 8U);
  EXPECT_EQ(mesh.report.n_faces, 6U);
  EXPECT_EQ(mesh.report.n_triangles, 12U);
  EXPECT_EQ(mesh.report.n_parts, 1U);
  EXPECT_EQ(mesh.report.n_welded_vertices, 16U);
  EXPECT_EQ(mesh.report.size, 3.0);
  EXPECT_EQ(mesh.report.reflex_depth, 0.0);
  EXPECT_FALSE(mesh.report.hull_used);
  EXPECT_EQ(mesh.report.hull_added_volume, 0.0);
  EXPECT_TRUE(mesh.report.notes.empty());
}

TEST(ConvexMesh, HasTheWeldedVerticesInOrder) {
  const ConvexMesh mesh = convex_mesh_from(shuffled(box_soup({0, 0, 0}, {1, 2, 3}), 3));
  ASSERT_EQ(mesh.body.n_vertices(), 8U);
  EXPECT_EQ(norm(mesh.body.vertex(0) - Vec3d{0, 0, 0}), 0.0);
  EXPECT_EQ(norm(mesh.body.vertex(1) - Vec3d{0, 0, 3}), 0.0);
  EXPECT_EQ(norm(mesh.body.vertex(7) - Vec3d{1, 2, 3}), 0.0);
}

TEST(ConvexMesh, TurnsABodyThatIsInsideOutIntoTheSameBody) {
  const ConvexMesh mesh = convex_mesh_from(icosahedron_soup());
  const ConvexMesh other = convex_mesh_from(turned(icosahedron_soup()));
  EXPECT_EQ(other.measures.volume, mesh.measures.volume);
  EXPECT_EQ(other.measures.surface_area, mesh.measures.surface_area);
  EXPECT_EQ(other.measures.integrated_mean_curvature, mesh.measures.integrated_mean_curvature);
  ASSERT_EQ(other.report.notes.size(), 1U);
  EXPECT_TRUE(contains(other.report.notes[0], "inside out"));
}

TEST(ConvexMesh, WithoutVolumeIsRefused) {
  PolygonSoup sheet;  // a triangle and its back
  sheet.points = {{0, 0, 0}, {1, 0, 0.3F}, {0, 1, 0.7F}};
  sheet.add_face({0, 1, 2});
  sheet.add_face({0, 2, 1});
  std::string message = refusal(sheet);
  EXPECT_TRUE(contains(message, "no volume"));
  EXPECT_TRUE(contains(message, "plate:"));
  EXPECT_TRUE(contains(message, "disc:"));
  message = refusal(box_soup({0, 0, 1}, {1, 1, 1}));  // two quads are left of it
  EXPECT_TRUE(contains(message, "no volume"));
}

TEST(ConvexMesh, ReadsAFaceWithACornerOnAStraightSide) {
  // Both faces at the edge know the vertex in its middle: nothing is without area if the cut goes the right way.
  PolygonSoup soup = box_soup({0, 0, 0}, {1, 1, 1});
  soup.points.push_back({0.5F, 0, 0});
  soup = corner_added(soup, 2, 1, 8);  // 0 4 5 1 becomes 0 8 4 5 1
  soup = corner_added(soup, 4, 4, 8);  // 0 2 6 4 becomes 0 2 6 4 8
  const ConvexMesh mesh = convex_mesh_from(soup);
  EXPECT_EQ(mesh.measures.volume, 1.0);
  EXPECT_NEAR(mesh.measures.surface_area, 6.0, 1e-15 * 6);
  EXPECT_NEAR(mesh.measures.integrated_mean_curvature, 3.0 * 3.14159265358979323846, 1e-14);
  EXPECT_EQ(mesh.body.n_vertices(), 9U);
}

TEST(ConvexMesh, NamesTheFirstConditionThatFails) {
  // Two bodies, one open, one the wrong way round, neither convex: the count of bodies comes first.
  const PolygonSoup l = l_prism_soup();
  const PolygonSoup far_l = moved(l, [](const Vec3d& p) { return p + Vec3d{10, 0, 0}; });
  EXPECT_TRUE(contains(refusal(joined(face_removed(l, 2), far_l)), "not one body"));
  EXPECT_TRUE(contains(refusal(face_removed(face_turned(l, 3), 2)), "not closed"));
  EXPECT_TRUE(contains(refusal(face_turned(l, 3)), "not consistently oriented"));
  EXPECT_TRUE(contains(refusal(l), "not convex"));
}

}  // namespace
}  // namespace vex::tests
