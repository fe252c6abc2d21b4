#include "engine/query/search/surface_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/numeric/vec3.h"

namespace vex {
namespace {

using Corners = std::array<std::uint32_t, 3>;
const QueryError<double> kError{8.0, 0x1p-50};

std::optional<SurfaceBound<double>> bound(const std::vector<Vec3d>& points, const std::vector<Corners>& faces) {
  const auto at = [&points](std::uint32_t i) -> const Vec3d& { return points[i]; };
  return bound_by_surface<double>(
      static_cast<std::uint32_t>(points.size()), at, static_cast<std::uint32_t>(faces.size()),
      [&faces](std::uint32_t k) { return faces[k]; }, kError);
}

const std::vector<Vec3d> kCorners = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
const std::vector<Corners> kFaces = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};

std::vector<Vec3d> shifted(std::vector<Vec3d> points, const Vec3d& by) {
  for (Vec3d& point : points) point = point + by;
  return points;
}

TEST(SurfaceBound, IsTheDistanceOfTheNearestFace) {
  const auto found = bound(kCorners, kFaces);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance, 1.0 / std::sqrt(3.0), 1e-15);
  const auto moved = bound(shifted(kCorners, {0.2, 0.2, 0.2}), kFaces);
  ASSERT_TRUE(moved);
  EXPECT_NEAR(moved->distance, (1.0 - 0.6) / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(norm(cross(moved->normal, Vec3d{1, 1, 1})), 0.0, 1e-14) << "the face away from where it went";
  EXPECT_LT(moved->normal.x, 0.0);
}

TEST(SurfaceBound, NeedsASurfaceThatIsClosed) {
  std::vector<Corners> faces = kFaces;
  faces.pop_back();
  EXPECT_FALSE(bound(kCorners, faces)) << "one is missing";
  EXPECT_FALSE(bound(kCorners, {}));
  faces = kFaces;
  faces.push_back(kFaces[0]);
  EXPECT_FALSE(bound(kCorners, faces)) << "one is there twice";
  for (const Corners& other : {Corners{1, 3, 3}, Corners{1, 2, 3}, Corners{1, 3, 4}, Corners{1, 3, 255}}) {
    faces = kFaces;
    faces[3] = other;
    EXPECT_FALSE(bound(kCorners, faces));
  }
}

TEST(SurfaceBound, NeedsTheOriginBehindEveryFace) {
  EXPECT_FALSE(bound(shifted(kCorners, {2, 0, 0}), kFaces)) << "it is outside";
  EXPECT_FALSE(bound(shifted(kCorners, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}), kFaces)) << "it is on a face";
  std::vector<Corners> inside_out = kFaces;
  for (Corners& face : inside_out) std::swap(face[1], face[2]);
  EXPECT_FALSE(bound(kCorners, inside_out));
  std::vector<Vec3d> flat = kCorners;
  flat[3] = flat[2];
  EXPECT_FALSE(bound(flat, kFaces));
  flat[3] = {std::nan(""), 0, 0};
  EXPECT_FALSE(bound(flat, kFaces));
}

// Two tetrahedra about the origin are a surface that goes around it twice, and prove what the nearer one does.
TEST(SurfaceBound, MayGoAroundTheOriginTwice) {
  std::vector<Vec3d> points = kCorners;
  for (const Vec3d& p : kCorners) points.push_back(-0.5 * p);
  std::vector<Corners> faces = kFaces;
  for (const Corners& f : kFaces) faces.push_back({f[0] + 4, f[2] + 4, f[1] + 4});
  const auto found = bound(points, faces);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance, 0.5 / std::sqrt(3.0), 1e-15);
}

}  // namespace
}  // namespace vex
