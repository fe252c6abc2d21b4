#include "meshes/extreme_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "meshes/data/mesh_writers.h"
#include "meshes/formats/coordinate_text.h"
#include "meshes/nearest_float.h"
#include "meshes/polyhedron_measures.h"
#include "refusal.h"
#include "soups.h"

namespace vex::tests {
namespace {

/// A cube's faces cut into n x n squares, each point placed.
PolygonSoup cut_cube(int n, const std::function<Vec3d(const Vec3d&)>& place) {
  PolygonSoup soup;
  soup.n_parts = 1;
  const auto count = static_cast<std::uint32_t>(n);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(soup.points.size());
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
          const double u = (2.0 * i - n) / n, v = (2.0 * j - n) / n;
          soup.points.push_back(place(axis == 0   ? Vec3d{side, u, v}
                                      : axis == 1 ? Vec3d{v, side, u}
                                                  : Vec3d{u, v, side}));
        }
      }
      for (std::uint32_t i = 0; i < count; ++i) {
        for (std::uint32_t j = 0; j < count; ++j) {
          const std::uint32_t a = first + i * (count + 1) + j, b = a + count + 1;
          side > 0.0 ? soup.add_face({a, b, b + 1, a + 1}) : soup.add_face({a, a + 1, b + 1, b});
        }
      }
    }
  }
  return soup;
}

Vec3d turned_about(const Vec3d& p) {
  const Vec3d q{0.8 * p.x - 0.6 * p.z, p.y, 0.6 * p.x + 0.8 * p.z};
  return {0.28 * q.x - 0.96 * q.y, 0.96 * q.x + 0.28 * q.y, q.z};
}

Vec3d as_floats(const Vec3d& p) { return {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)}; }

void expect_same_vertices(const Polytope& a, const Polytope& b) {
  ASSERT_EQ(a.n_vertices(), b.n_vertices());
  for (std::size_t i = 0; i < a.n_vertices(); ++i) {
    EXPECT_EQ(norm(a.vertex(i) - b.vertex(i)), 0.0);
  }
  EXPECT_EQ(norm(a.centre() - b.centre()), 0.0);
}

/// How far the points are outside the body, by all facets' planes: never more than the distance.
double farthest_above(const std::vector<Vec3d>& points, const Triangles& hull) {
  double farthest = 0.0;
  for (std::size_t t = 0; t < hull.size(); ++t) {
    const Vec3d a = hull.corner(t, 0);
    const Vec3d normal = cross(hull.corner(t, 1) - a, hull.corner(t, 2) - a);
    for (const Vec3d& p : points) {
      farthest = std::max(farthest, dot(p - a, normal) / norm(normal));
    }
  }
  return farthest;
}

TEST(ExtremeVertices, OfACutCubeAreItsEightCorners) {
  const ConvexMesh mesh = convex_mesh_from(cut_cube(16, [](const Vec3d& p) { return p; }));
  EXPECT_EQ(mesh.polytope().n_vertices(), 8U);
  EXPECT_EQ(mesh.report.n_points, 6U * 16 * 16 + 2);
  EXPECT_EQ(mesh.report.n_dropped_vertices, 6U * 16 * 16 + 2 - 8);
  EXPECT_EQ(mesh.report.n_faces, 6U * 16 * 16);
  EXPECT_EQ(mesh.report.n_triangles, 12U);
  EXPECT_EQ(mesh.measures.volume, 8.0);
  EXPECT_FALSE(mesh.report.hull_used);
  EXPECT_TRUE(mesh.report.notes.empty()) << "none of those that were dropped was outside";
}

TEST(ExtremeVertices, OfATurnedCutCubeAreItsCornersToRounding) {
  for (const bool floats : {false, true}) {
    PolygonSoup soup =
        cut_cube(20, [&](const Vec3d& p) { return floats ? as_floats(turned_about(p)) : turned_about(p); });
    if (floats) {
      soup.digits = float_digits(1.5);
    }
    const ConvexMesh mesh = convex_mesh_from(soup);
    EXPECT_EQ(mesh.polytope().n_vertices(), 8U);
    EXPECT_NEAR(mesh.measures.volume, 8.0, floats ? 8e-6 : 1e-13);
    EXPECT_LT(mesh.report.volume_rounding, floats ? 1e-6 : 1e-14);
    ASSERT_FALSE(mesh.report.notes.empty());
    EXPECT_TRUE(contains(mesh.report.notes.back(), "are no corners of the body to within the rounding"));
    expect_same_vertices(convex_mesh_from(soup, {.hull = true}).polytope(), mesh.polytope());
  }
}

TEST(ExtremeVertices, OfFloatsDoNotDependOnFacesOrOrderOrHull) {
  std::mt19937_64 random(4);
  PolygonSoup soup = cut_cube(12, [&](const Vec3d& p) {  // bumps of the size of the tolerance
    return as_floats((1.0 + 2e-7 * static_cast<double>(random() % 8)) * turned_about(p));
  });
  soup.digits = float_digits(1.0);
  const ConvexMesh mesh = convex_mesh_from(soup, {.hull = true});
  EXPECT_GT(mesh.report.n_dropped_vertices, 700U);
  EXPECT_GT(mesh.report.n_vertices, 12U);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    PolygonSoup other = shuffled(soup, seed);
    other.digits = soup.digits;
    expect_same_vertices(convex_mesh_from(other, {.hull = true}).polytope(), mesh.polytope());
    PolygonSoup cut_twice = shuffled(with_own_corners(soup), seed);
    cut_twice.digits = soup.digits;
    expect_same_vertices(convex_mesh_from(cut_twice, {.hull = true}).polytope(), mesh.polytope());
  }
}

TEST(ExtremeVertices, OfASphereAreAllAndTheSurfaceIsItsOwn) {
  for (const CoordinateDigits& digits : {CoordinateDigits{}, float_digits(3.0)}) {
    PolygonSoup soup = sphere_soup(24, [](const Vec3d& v) { return Vec3d{3 * v.x, 2 * v.y, 1.5 * v.z}; });
    soup.digits = digits;
    const ConvexMesh mesh = convex_mesh_from(soup);
    EXPECT_EQ(mesh.polytope().n_vertices(), soup.points.size());
    EXPECT_EQ(mesh.report.n_dropped_vertices, 0U);
    EXPECT_EQ(mesh.report.n_triangles, soup.face_sizes.size());
  }
}

TEST(ExtremeVertices, LeaveNoVertexFartherOutsideThanTheTolerance) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  for (const double thin : {1.0, 0.3, 0.01, 1e-5}) {
    std::vector<Vec3d> points;
    for (int i = 0; i < 2000; ++i) {
      const Vec3d p{normal(random), normal(random), normal(random)};
      points.push_back((1.0 / norm(p)) * Vec3d{p.x, 0.7 * p.y, thin * p.z});
    }
    std::ranges::sort(points,
                      [](const Vec3d& a, const Vec3d& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
    const HullOfPoints hull = hull_of_points(points);
    std::size_t before = points.size() + 1;
    for (const double tolerance : {1e-12, 1e-4 * thin, 1e-3 * thin, 1e-2 * thin}) {
      HullOfPoints copy{hull.vertices, hull.triangles};
      const ExtremeVertices fewer = extreme_vertices(std::move(copy), tolerance, MadeFrom::vertices);
      EXPECT_LE(fewer.farthest_outside, tolerance);
      EXPECT_LE(farthest_above(hull.vertices, fewer.hull.triangles), fewer.farthest_outside + 1e-15);
      EXPECT_LT(fewer.hull.vertices.size(), before);
      EXPECT_EQ(fewer.hull.triangles.size(), 2 * fewer.hull.vertices.size() - 4);
      EXPECT_GE(volume_and_centroid(fewer.hull.triangles).volume,
                volume_and_centroid(hull.triangles).volume - surface_area(hull.triangles) * tolerance);
      before = fewer.hull.vertices.size();
    }
    EXPECT_LT(before, 3 * hull.vertices.size() / 4);
  }
}

TEST(ExtremeVertices, OfThinBodiesAreNotMergedAway) {
  for (const double thin : {1e-6, 1e-12, 1e-20}) {
    PolygonSoup soup = box_soup({0, 0, 0}, {1, 1, thin});
    soup.digits = float_digits(1.0);
    const ConvexMesh mesh = convex_mesh_from(soup);
    EXPECT_EQ(mesh.polytope().n_vertices(), 8U);
    EXPECT_NEAR(mesh.measures.volume, thin, 1e-7 * thin);
  }
}

}  // namespace
}  // namespace vex::tests
