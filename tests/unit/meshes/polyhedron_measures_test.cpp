#include "meshes/polyhedron_measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "exact_polyhedron.h"
#include "meshes/convex_mesh.h"
#include "meshes/data/mesh_writers.h"
#include "meshes/exact_hull.h"
#include "meshes/hull.h"
#include "refusal.h"
#include "shapes/formula.h"
#include "soups.h"
#include "tests/referees/normal_integral.h"

namespace vex::tests {
namespace {

constexpr double kPi = std::numbers::pi;

void expect_near_relative(double value, double expected, double relative_error, const char* what) {
  EXPECT_NEAR(value, expected, relative_error * std::fabs(expected)) << what;
}

void expect_measures(const Measures& measures, const Measures& expected, double relative_error) {
  expect_near_relative(measures.volume, expected.volume, relative_error, "V");
  expect_near_relative(measures.surface_area, expected.surface_area, relative_error, "S");
  expect_near_relative(measures.integrated_mean_curvature, expected.integrated_mean_curvature, relative_error, "M");
}

/// <V_ex> / V of a body with itself: docs/guide.md.
double reduced_excluded_volume(const Measures& m) {
  return 2.0 * (1.0 + m.integrated_mean_curvature * m.surface_area / (4.0 * kPi * m.volume));
}

/// The hull of points as a soup of triangles; the points are floats already.
PolygonSoup hull_soup(const PolygonSoup& points) {
  PolygonSoup soup = points;
  soup.corners.clear();
  soup.face_sizes.clear();
  for (const auto& [a, b, c] : convex_hull_triangles(points.points)) {
    soup.add_face({a, b, c});
  }
  return soup;
}

PolygonSoup random_points(std::uint64_t seed, int n) {
  std::mt19937_64 random(seed);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11U) * 0x1p-52 - 1.0; };
  std::vector<Vec3d> points;
  while (points.size() < static_cast<std::size_t>(n)) {
    const Vec3d p{uniform(), uniform(), uniform()};
    if (norm(p) < 1.0 && norm(p) > 0.1) {
      points.push_back((1.0 / norm(p)) * p);
    }
  }
  return soup_of(points, {});
}

TEST(PolyhedronMeasures, OfRegularBodiesGiveTheKnownExcludedVolumes) {
  const auto reduced = [](const PolygonSoup& soup) { return reduced_excluded_volume(convex_mesh_from(soup).measures); };
  EXPECT_NEAR(reduced(tetrahedron_soup()), 15.407431604, 1e-9);
  EXPECT_NEAR(reduced(box_soup({0, 0, 0}, {1, 1, 1})), 11.0, 1e-12);
  EXPECT_NEAR(reduced(octahedron_soup()), 10.637976081, 1e-9);
  EXPECT_NEAR(reduced(dodecahedron_soup()), 9.121016679, 1e-6);  // floats are regular to 1e-7
  EXPECT_NEAR(reduced(icosahedron_soup()), 8.915264469, 1e-6);
}

TEST(PolyhedronMeasures, OfTheRegularTetrahedronAreTheClosedForms) {
  const Measures m = convex_mesh_from(tetrahedron_soup()).measures;  // edge 2 sqrt 2
  expect_near_relative(m.volume, 8.0 / 3.0, 1e-15, "V");
  expect_near_relative(m.surface_area, 8.0 * std::sqrt(3.0), 1e-15, "S");
  // Six edges; the exterior angle is pi minus the dihedral angle acos(1/3), not that angle itself.
  expect_near_relative(m.integrated_mean_curvature, 3.0 * 2.0 * std::sqrt(2.0) * (kPi - std::acos(1.0 / 3.0)), 1e-15,
                       "M");
}

TEST(PolyhedronMeasures, OfAFlatPyramidTellTheDihedralAngleFromItsSupplement) {
  // Base 2 x 2, height 0.1: a swapped angle would put M near 4 sqrt(2) pi / 2 + ... and not near the plate's pi P / 2.
  PolygonSoup soup;
  soup.points = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 0.1F}};
  soup.n_parts = 1;
  soup.add_face({3, 2, 1, 0});
  for (std::uint32_t i = 0; i < 4; ++i) {
    soup.add_face({i, (i + 1) % 4, 4});
  }
  const Measures m = convex_mesh_from(soup).measures;
  expect_measures(m, exact_measures(triangulated(soup)), 1e-15);
  EXPECT_NEAR(m.integrated_mean_curvature, kPi * 8.0 / 2.0, 0.05);
}

TEST(PolyhedronMeasures, AgreeWithExactArithmeticToTwelveDigitsForRandomHulls) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const PolygonSoup soup = hull_soup(random_points(seed, 60));
    const ConvexMesh mesh = convex_mesh_from(soup);
    EXPECT_FALSE(mesh.report.hull_used);
    expect_measures(mesh.measures, exact_measures(soup), 1e-14);
  }
}

TEST(PolyhedronMeasures, AgreeWithExactArithmeticForThinBodies) {
  for (const double thickness : {1e-2, 1e-4, 1e-6}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const PolygonSoup points = moved(random_points(seed, 40), [&](const Vec3d& p) {
        return Vec3d{p.x, 0.5 * p.y, thickness * p.z};
      });
      const PolygonSoup soup = hull_soup(points);
      expect_measures(convex_mesh_from(soup).measures, exact_measures(soup), 1e-12);
      const PolygonSoup needle = hull_soup(moved(random_points(seed, 40), [&](const Vec3d& p) {
        return Vec3d{thickness * p.x, thickness * p.y, p.z};
      }));
      expect_measures(convex_mesh_from(needle).measures, exact_measures(needle), 1e-12);
    }
  }
}

TEST(PolyhedronMeasures, AgreeWithExactArithmeticFarFromTheOrigin) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const PolygonSoup soup = hull_soup(moved(random_points(seed, 30), [](const Vec3d& p) {
      return Vec3d{p.x + 1e5, p.y - 2e5, p.z + 5e4};
    }));
    const ConvexMesh mesh = convex_mesh_from(soup);
    expect_measures(mesh.measures, exact_measures(soup), 1e-12);
    EXPECT_NEAR(mesh.body.centre().x, 1e5, 0.2);
    EXPECT_GT(mesh.body.inradius(), 0.3);
  }
}

TEST(PolyhedronMeasures, AreExactForExtremeSizes) {
  for (const double scale : {1e-36, 1e-20, 1e20, 1e37}) {
    const PolygonSoup soup = moved(icosahedron_soup(), [&](const Vec3d& p) { return scale * p; });
    expect_measures(convex_mesh_from(soup).measures, exact_measures(soup), 1e-14);
  }
}

TEST(PolyhedronMeasures, OfABoxAreTheClosedFormsWhereverTheDiagonalsRun) {
  const Measures m = convex_mesh_from(box_soup({-1, 2, 5}, {1, 5, 9})).measures;
  expect_measures(m, {24.0, 52.0, kPi * 9.0}, 1e-15);
}

TEST(PolyhedronMeasures, DoNotDependOnTheOrderOfTheFacesToTheLastBit) {
  const PolygonSoup soup = hull_soup(random_points(7, 80));
  const ConvexMesh mesh = convex_mesh_from(soup);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const ConvexMesh other = convex_mesh_from(shuffled(with_own_corners(soup), seed));
    EXPECT_EQ(other.measures.volume, mesh.measures.volume);
    EXPECT_EQ(other.measures.surface_area, mesh.measures.surface_area);
    EXPECT_EQ(other.measures.integrated_mean_curvature, mesh.measures.integrated_mean_curvature);
    EXPECT_EQ(other.body.inradius(), mesh.body.inradius());
  }
}

TEST(InscribedRadius, IsJustBelowTheTrueOne) {
  const ConvexMesh cube = convex_mesh_from(box_soup({-1, -1, -1}, {1, 1, 1}));
  EXPECT_LT(cube.body.inradius(), 1.0);
  EXPECT_GT(cube.body.inradius(), 1.0 - 1e-14);
  const ConvexMesh octahedron = convex_mesh_from(octahedron_soup());
  EXPECT_LT(octahedron.body.inradius(), std::sqrt(1.0 / 3.0));
  EXPECT_GT(octahedron.body.inradius(), std::sqrt(1.0 / 3.0) * (1.0 - 1e-14));
}

TEST(RoundedCentre, IsTheCentroidWhereThatIsABinaryFraction) {
  const ConvexMesh mesh = convex_mesh_from(box_soup({1, 2, 3}, {2, 4, 6}));
  EXPECT_EQ(mesh.body.centre().x, 1.5);
  EXPECT_EQ(mesh.body.centre().y, 3.0);
  EXPECT_EQ(mesh.body.centre().z, 4.5);
}

TEST(RoundedCentre, DoesNotDependOnHowTheFacesAreCut) {
  // The quads of a turned box are planar only to rounding: one cut of each bulges, the other is reflex, and whichever
  // the file has, the body is the hull of the same floats. So are its measures and its centre.
  int n_hulls = 0;
  for (int i = 0; i < 20; ++i) {
    const double angle = 0.1 + 0.05 * i;
    const PolygonSoup quads = moved(box_soup({-1, -1.5, -2}, {1, 1.5, 2}), [&](const Vec3d& p) {
      return Vec3d{std::cos(angle) * p.x - std::sin(angle) * p.y + 3.3,
                   std::sin(angle) * p.x + std::cos(angle) * p.y - 7.7, p.z + 0.3 * p.x};
    });
    PolygonSoup other_cut = quads;  // each quad starts at its second corner
    for (std::size_t f = 0; f < other_cut.corners.size(); f += 4) {
      std::rotate(&other_cut.corners[f], &other_cut.corners[f + 1], &other_cut.corners[f] + 4);
    }
    const ConvexMesh first = convex_mesh_from(triangulated(quads));
    const ConvexMesh second = convex_mesh_from(triangulated(other_cut));
    EXPECT_EQ(first.body.centre().x, second.body.centre().x);
    EXPECT_EQ(first.body.centre().y, second.body.centre().y);
    EXPECT_EQ(first.body.centre().z, second.body.centre().z);
    expect_measures(first.measures, second.measures, 1e-14);
    n_hulls += (first.report.hull_used ? 1 : 0) + (second.report.hull_used ? 1 : 0);
  }
  EXPECT_GT(n_hulls, 20);  // or this would show nothing
}

/// A right prism on a regular polygon, as high as its sides are long.
std::vector<Vec3d> regular_prism(int n_sides) {
  const double radius = 0.5 / std::sin(std::numbers::pi / n_sides);
  std::vector<Vec3d> points;
  for (int k = 0; k < n_sides; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / n_sides;
    for (const double z : {-0.5, 0.5}) points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
  }
  return points;
}

TEST(PolyhedronMeasures, OfRegularPrismsGiveTheReferenceExcludedVolumes) {
  for (const auto& [n_sides, reduced] :
       std::vector<std::pair<int, double>>{{3, 13.160254038}, {4, 11.0}, {6, 10.618802154}}) {
    const std::vector<Vec3d> points = regular_prism(n_sides);
    const std::optional<Triangles> hull = exact_hull(points);
    ASSERT_TRUE(hull.has_value());
    const Measures measures{volume_and_centroid(*hull).volume, surface_area(*hull), integrated_mean_curvature(*hull)};
    EXPECT_NEAR(average_excluded_volume(measures, measures) / measures.volume, reduced, 1e-9 * reduced) << n_sides;
  }
}

// The measures on normals, held against V, S and M of the same surface.
void expect_normals_of(const PolygonSoup& soup) {
  const ConvexMesh mesh = convex_mesh_from(soup);
  const NormalMeasure area = mesh.normals.area(), curvature = mesh.normals.mean_curvature();
  const auto [v, s, m] = mesh.measures;
  const double size = mesh.body.circumradius();
  expect_near_relative(area.total_mass(), s, 1e-14, "S");
  expect_near_relative(curvature.total_mass(), m, 1e-14, "M");
  for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
    const auto along = [&](const Vec3d& n) { return dot(axis, n); };
    EXPECT_NEAR(integral_over(area, along), 0.0, 1e-13 * s);
    EXPECT_NEAR(integral_over(curvature, along), 0.0, 1e-13 * m);
  }
  const auto height = [&](const Vec3d& n) { return dot(n, mesh.body.support(n) - mesh.body.centre()); };
  EXPECT_NEAR(integral_over(area, height) / 3.0, v, 1e-13 * s * size);
  EXPECT_NEAR(integral_over(curvature, height), s, 1e-13 * m * size);
}

TEST(NormalMeasuresOfAMesh, AgreeWithItsMeasures) {
  expect_normals_of(box_soup({-1, 0, 0.25}, {1, 3, 0.5}));
  expect_normals_of(tetrahedron_soup());
  expect_normals_of(dodecahedron_soup());
  expect_normals_of(hull_soup(random_points(5, 200)));
  expect_normals_of(sphere_soup(6, [](const Vec3d& p) { return Vec3d{1000.0 + p.x, 2.0 * p.y - 500.0, 0.5 * p.z}; }));
}

TEST(NormalMeasuresOfAMesh, AreTheScaledBodysWhereItIsScaled) {
  MeshOptions options;
  options.scale = [](const Measures&) { return 3.0; };
  const ConvexMesh mesh = convex_mesh_from(box_soup({0, 0, 0}, {1, 1, 1}), options);
  EXPECT_NEAR(mesh.normals.area().total_mass(), 54.0, 1e-12);
  EXPECT_NEAR(mesh.normals.mean_curvature().total_mass(), 9.0 * kPi, 1e-12);
}

}  // namespace
}  // namespace vex::tests
