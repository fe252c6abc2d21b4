#include "meshes/difference_mesh.h"

#include <gtest/gtest.h>

#include "engine/numeric/quaternion.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

double volume_of(const BodyMesh& mesh) {
  double six_volumes = 0.0;
  for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const std::uint32_t* const c = &mesh.indices[t];
    six_volumes += dot(mesh.points[c[0]], cross(mesh.points[c[1]], mesh.points[c[2]]));
  }
  return six_volumes / 6.0;
}

DifferenceMesh difference(const std::string& a, const std::string& b, const Transformd& rotation) {
  const Body body_a = parse_shape(a), body_b = parse_shape(b);
  return difference_mesh(body_a.body, mesh_of(body_a.body, 32), body_b.body, mesh_of(body_b.body, 32), rotation, 24);
}

TEST(DifferenceMesh, OfParallelBoxesIsTheBoxOfTheirSums) {
  const DifferenceMesh found = difference("box:1,2,3", "box:4,5,6", {});
  EXPECT_TRUE(found.is_exact);
  EXPECT_EQ(found.surface.indices.size(), 3 * 12u);
  EXPECT_EQ(volume_of(found.surface), 5.0 * 7.0 * 9.0);
}

// V_ex of two boxes is the sum of 8 mixed products; of cubes turned by 45 degrees about z: h (a + b sqrt 2 ...).
TEST(DifferenceMesh, OfTurnedCubesHasTheirExcludedVolume) {
  const Transformd eighth =
      rotation_from_quaternion(std::cos(std::acos(-1.0) / 8.0), 0, 0, std::sin(std::acos(-1.0) / 8.0));
  const DifferenceMesh found = difference("box:1,1,1", "box:1,1,1", eighth);
  EXPECT_TRUE(found.is_exact);
  // An octagon with sides 1 and right angles cut: 1 + 1 + 2 sqrt 2 in area, 2 high.
  EXPECT_NEAR(volume_of(found.surface), 2.0 * (2.0 + 2.0 * std::sqrt(2.0)), 1e-12);
}

TEST(DifferenceMesh, OfCurvedBodiesIsInsideAndNearlyAll) {
  const DifferenceMesh spheres = difference("sphere:1", "sphere:2", {});
  EXPECT_FALSE(spheres.is_exact);
  const double ball = 4.0 / 3.0 * std::acos(-1.0) * 27.0;
  EXPECT_LT(volume_of(spheres.surface), ball);
  EXPECT_GT(volume_of(spheres.surface), 0.97 * ball);
  // The flat faces of a cylinder and of a tilted box are all there: no higher than the sum of both, nor lower.
  const Transformd tilted = rotation_from_quaternion(0.9, 0.3, -0.2, 0.1);
  const DifferenceMesh found = difference("cylinder:2,1", "box:1,1,1", tilted);
  double top = 0.0;
  for (const Vec3d& p : found.surface.points) top = std::max(top, p.z);
  const double half = 0.5 * (std::fabs(tilted.row_z.x) + std::fabs(tilted.row_z.y) + std::fabs(tilted.row_z.z));
  EXPECT_NEAR(top, 1.0 + half, 1e-5);
}

TEST(DifferenceMesh, IsNoneWhereNothingIsExcluded) {
  EXPECT_TRUE(difference("needle:1", "needle:2", rotation_from_quaternion(0.9, 0.3, 0, 0)).surface.points.empty());
  EXPECT_TRUE(difference("plate:1,1", "plate:2,1", {}).surface.points.empty());
}

}  // namespace
}  // namespace vex
