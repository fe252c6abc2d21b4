#include "meshes/hull_of_points.h"

#include <gtest/gtest.h>

#include <random>

#include "meshes/convex_mesh.h"
#include "refusal.h"
#include "soups.h"

namespace vex::tests {
namespace {

PolygonSoup cloud(const std::vector<Vec3d>& points) { return soup_of(points, {}); }

TEST(HullOfPoints, OfALatticeHasEightVertices) {
  std::vector<Vec3d> points;
  for (int i = 0; i < 1000; ++i) {
    points.push_back({static_cast<double>(i % 10), static_cast<double>(i / 10 % 10), static_cast<double>(i / 100)});
  }
  const ConvexMesh mesh = convex_mesh_from(cloud(points), {.hull = true});
  EXPECT_EQ(mesh.body.n_vertices(), 8U);
  EXPECT_EQ(mesh.report.n_vertices, 8U);
  EXPECT_EQ(mesh.report.n_points, 1000U);
  EXPECT_EQ(mesh.measures.volume, 729.0);
  EXPECT_EQ(mesh.measures.surface_area, 486.0);
  EXPECT_FALSE(mesh.report.hull_added_volume.has_value());
  EXPECT_TRUE(contains(mesh.report.notes.back(), "not defined: there are no faces"));
}

}  // namespace
}  // namespace vex::tests
