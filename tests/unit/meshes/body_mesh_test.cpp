#include "meshes/body_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "shapes/any_shape.h"

namespace vex {
namespace {

double height(const BodyMesh& mesh, const Vec3d& dir) {
  double height = -HUGE_VAL;
  for (const Vec3d& p : mesh.points) height = std::max(height, dot(dir, p + mesh.origin));
  return height;
}

const Vec3d kDirs[] = {{1, 0, 0},     {-1, 0, 0},     {0, 1, 0},
                       {0, -1, 0},    {0, 0, 1},      {0, 0, -1},
                       {0.6, 0.8, 0}, {-0.6, 0, 0.8}, {2.0 / 3, 2.0 / 3, -1.0 / 3}};

TEST(BodyMesh, ReachesAsFarAsTheBody) {
  for (const NamedShape& shape : named_shapes()) {
    const std::map<std::string_view, const char*> sizes = {{"R", "1"},
                                                           {"A,B,C", "1,2,3"},
                                                           {"L,R", "2,0.5"},
                                                           {"H,R", "2,0.5"},
                                                           {"H,R1,R2", "2,1,0.5"},
                                                           {"A,B", "1,2"},
                                                           {"L", "2"},
                                                           {"E", "1"},
                                                           {"N,A,H", "5,1,2"},
                                                           {"R,H", "1,0.5"},
                                                           {"R,B,T", "1,0.5,0.75"},
                                                           {"P,R", "2,1"},
                                                           {"A,B,C,P,Q", "1,2,3,2,0.75"},
                                                           {"r,BODY", "0.5,box:1,2,3"}};
    const auto size = sizes.find(shape.parameters);
    ASSERT_NE(size, sizes.end()) << shape.name << ":" << shape.parameters;
    const std::string text = std::string(shape.name) + ":" + size->second;
    const ConvexBody body = parse_shape(text).body;
    for (const int n_around : {12, 20, 32, 48}) {
      const BodyMesh mesh = mesh_of(body, n_around);
      const double slack = 8.0 * body.circumradius() / (n_around * n_around);
      for (const Vec3d& dir : kDirs) {
        const double h = dot(dir, body.support(dir));
        EXPECT_LE(height(mesh, dir), h + 1e-6 * body.circumradius()) << text;
        EXPECT_GE(height(mesh, dir), h - slack) << text << " " << n_around;
      }
      EXPECT_EQ(mesh.indices.size() % (mesh.is_line ? 2 : 3), 0u);
      EXPECT_EQ(mesh.normals.size(), mesh.is_line ? 0u : mesh.points.size());
      for (const std::uint32_t index : mesh.indices) EXPECT_LT(index, mesh.points.size());
    }
  }
}

TEST(BodyMesh, OfAPolytopeHasItsCornersOnceANormal) {
  const BodyMesh box = mesh_of(parse_shape("box:1,2,3").body, 12);
  EXPECT_EQ(box.points.size(), 24u);
  EXPECT_EQ(box.indices.size(), 36u);
  const BodyMesh tetrahedron = mesh_of(parse_shape("tetrahedron:1").body, 12);
  EXPECT_EQ(tetrahedron.points.size(), 12u);
}

TEST(BodyMesh, OfFlatBodiesIsAPolygonAndOfNeedlesALine) {
  const BodyMesh plate = mesh_of(parse_shape("plate:1,2").body, 12);
  EXPECT_TRUE(plate.is_flat);
  EXPECT_EQ(plate.points.size(), 4u);
  EXPECT_EQ(plate.indices.size(), 6u);
  const BodyMesh disc = mesh_of(parse_shape("disc:1").body, 48);
  EXPECT_TRUE(disc.is_flat);
  EXPECT_GE(disc.points.size(), 48u);
  for (const Vec3d& p : disc.points) EXPECT_NEAR(norm(p), 1.0, 1e-6) << "the rim alone";
  const BodyMesh needle = mesh_of(parse_shape("needle:2").body, 48);
  EXPECT_TRUE(needle.is_line);
  EXPECT_EQ(needle.points.size(), 2u);
  const BodyMesh thin = mesh_of(parse_shape("ellipsoid:1e-9,1,1").body, 48);
  EXPECT_TRUE(thin.is_flat) << "to 32 bits";
  EXPECT_GE(thin.points.size(), 40u);
}

}  // namespace
}  // namespace vex
