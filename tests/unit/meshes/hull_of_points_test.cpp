#include "meshes/hull_of_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <tuple>

#include "engine/numeric/errors.h"
#include "meshes/convexity.h"
#include "meshes/hull.h"
#include "meshes/polyhedron_measures.h"
#include "meshes/weld.h"
#include "refusal.h"
#include "soups.h"

namespace vex::tests {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using RationalVec3 = std::array<Rational, 3>;

/// As the reader delivers them and weld orders them: floats, each place once.
std::vector<Vec3d> welded(const std::vector<Vec3d>& points) {
  return weld(soup_of(points, {}), UnusedPoints::kept).surface.vertices;
}

double volume_of(const HullOfPoints& hull) { return volume_and_centroid(hull.triangles).volume; }

double qhull_volume(const std::vector<Vec3d>& points) {
  const std::optional<Triangles> hull = paired_triangles(points, convex_hull_triangles(points));
  return hull ? volume_and_centroid(*hull).volume : 0.0;
}

/// In rational arithmetic: no point is above any facet. With the local laws below that is what makes it the hull.
void expect_no_point_above(const HullOfPoints& hull, const std::vector<Vec3d>& points) {
  std::vector<RationalVec3> exact;
  for (const Vec3d& p : points) {
    exact.push_back({Rational(p.x), Rational(p.y), Rational(p.z)});
  }
  std::size_t n_above = 0;
  for (std::size_t t = 0; t < hull.triangles.size(); ++t) {
    std::array<RationalVec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d v = hull.triangles.corner(t, k);
      p[k] = {Rational(v.x), Rational(v.y), Rational(v.z)};
    }
    RationalVec3 normal;
    Rational offset = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      normal[k] = (p[1][i] - p[0][i]) * (p[2][j] - p[0][j]) - (p[1][j] - p[0][j]) * (p[2][i] - p[0][i]);
      offset += normal[k] * p[0][k];
    }
    for (const RationalVec3& q : exact) {
      n_above += normal[0] * q[0] + normal[1] * q[1] + normal[2] * q[2] > offset ? 1U : 0U;
    }
  }
  EXPECT_EQ(n_above, 0U);
}

/// A closed convex surface over its own vertices, which are among the points and in their order.
void expect_hull(const HullOfPoints& hull, const std::vector<Vec3d>& points) {
  const auto before = [](const Vec3d& a, const Vec3d& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  EXPECT_TRUE(std::ranges::includes(points, hull.vertices, before));
  EXPECT_EQ(hull.triangles.size(), 2 * hull.vertices.size() - 4);
  EXPECT_TRUE(paired_triangles(hull.vertices, hull.triangles.corners).has_value());
  const ConvexityCensus census = convexity_census(hull.triangles, volume_and_centroid(hull.triangles).centroid);
  EXPECT_EQ(census.n_reflex_edges, 0U);
  EXPECT_EQ(census.winding_number, 1);
}

using Cloud = std::function<Vec3d(std::mt19937_64*)>;

Vec3d on_the_sphere(std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  const Vec3d p{normal(*random), normal(*random), normal(*random)};
  return (1.0 / norm(p)) * p;
}
double uniform(std::mt19937_64* random) { return std::uniform_real_distribution<double>(-1.0, 1.0)(*random); }
Vec3d in_the_cube(std::mt19937_64* random) { return {uniform(random), uniform(random), uniform(random)}; }

std::vector<Vec3d> points_of(const Cloud& cloud, int n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Vec3d> points;
  for (int i = 0; i < n; ++i) {
    points.push_back(cloud(&random));
  }
  return welded(points);
}

TEST(HullOfPoints, OfRandomPointsHasNoPointAboveItAndQhullsVolume) {
  double fraction_kept = 0.0;
  int n_clouds = 0;
  for (const Cloud& cloud : {Cloud([](auto* r) { return std::cbrt(0.5 * (uniform(r) + 1.0)) * on_the_sphere(r); }),
                             Cloud(on_the_sphere), Cloud(in_the_cube),
                             Cloud([](auto* r) {  // a needle, turned
                               const Vec3d p = in_the_cube(r);
                               return Vec3d{0.6 * p.x + 1e-6 * p.y, 0.8 * p.x + 2e-6 * p.z, 1e-6 * p.y - 1e-6 * p.z};
                             }),
                             Cloud([](auto* r) {
                               return 1000.0 * in_the_cube(r) + Vec3d{1e6, 1e6, -1e6};
                             })}) {
    for (const int n : {5, 30, 300}) {
      const std::vector<Vec3d> points = points_of(cloud, n, 7);
      const HullOfPoints hull = hull_of_points(points);
      expect_hull(hull, points);
      expect_no_point_above(hull, points);
      const double volume = volume_of(hull);
      EXPECT_NEAR(qhull_volume(points), volume, 1e-9 * volume);
      fraction_kept += static_cast<double>(hull.vertices.size()) / static_cast<double>(points.size());
      ++n_clouds;
    }
  }
  EXPECT_GT(fraction_kept / n_clouds, 0.3);
  EXPECT_LT(fraction_kept / n_clouds, 0.8);
}

TEST(HullOfPoints, RefusesPointsThatAreNotFinite) {
  std::vector<Vec3d> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    points.push_back({wrong, 0, 0});  // a NaN was left out without a word
    EXPECT_THROW(hull_of_points(points), InputError);
    points.pop_back();
  }
}

TEST(HullOfPoints, LeavesOutWhatIsInsideFacetsAndEdges) {
  std::vector<Vec3d> lattice;
  for (int i = 0; i < 12 * 12 * 12; ++i) {
    lattice.push_back({static_cast<double>(i % 12), static_cast<double>(i / 12 % 12), static_cast<double>(i / 144)});
  }
  const auto turned = [](const Vec3d& p) {  // by a lattice's own symmetry: exact
    return Vec3d{2 * p.x + p.y - 2 * p.z, -2 * p.x + 2 * p.y - p.z, p.x + 2 * p.y + 2 * p.z};
  };
  for (const bool is_turned : {false, true}) {
    std::vector<Vec3d> points = lattice;
    if (is_turned) {
      std::ranges::transform(points, points.begin(), turned);
    }
    const HullOfPoints hull = hull_of_points(welded(points));
    expect_hull(hull, welded(points));
    EXPECT_EQ(hull.vertices.size(), 8U);
    EXPECT_EQ(volume_of(hull), 1331.0 * (is_turned ? 27.0 : 1.0));
  }
}

TEST(HullOfPoints, KeepsAPointOfALatticeIfAndOnlyIfTheHullIsLessWithoutIt) {
  std::mt19937_64 random(3);
  std::size_t n_kept = 0, n_left_out = 0, n_flat = 0;
  for (int i = 0; i < 150; ++i) {
    std::vector<Vec3d> points;
    const std::uint64_t size = 2 + random() % 4, n_points = 4 + random() % 30;
    for (std::uint64_t k = 0; k < n_points; ++k) {
      const auto coordinate = [&] { return static_cast<double>(random() % size); };
      points.push_back({coordinate(), coordinate(), coordinate()});
    }
    points = welded(points);
    // Six times the volume is a whole number.
    const auto six_volumes = [](const std::vector<Vec3d>& some) {
      try {
        return std::round(6.0 * volume_of(hull_of_points(some)));
      } catch (const InputError&) {
        return 0.0;
      }
    };
    if (six_volumes(points) == 0.0) {
      ++n_flat;
      continue;
    }
    const HullOfPoints hull = hull_of_points(points);
    expect_hull(hull, points);
    expect_no_point_above(hull, points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      std::vector<Vec3d> others = points;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      const bool is_kept =
          std::ranges::any_of(hull.vertices, [&](const Vec3d& v) { return norm(v - points[k]) == 0.0; });
      ++(is_kept ? n_kept : n_left_out);
      ASSERT_EQ(is_kept, six_volumes(others) < six_volumes(points)) << i;
    }
  }
  EXPECT_GT(n_kept, 800U);
  EXPECT_GT(n_left_out, 400U);
  EXPECT_LT(n_flat, 40U);
}

TEST(HullOfPoints, OfCirclesOfLatitudeKeepsEveryPointThatIsACorner) {
  std::vector<Vec3d> points;
  for (int i = 1; i < 10; ++i) {
    for (int k = 0; k < 24; ++k) {
      const double a = std::numbers::pi * i / 10.0, b = std::numbers::pi * k / 12.0;
      points.push_back({std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)});
    }
  }
  points = welded(points);
  const HullOfPoints hull = hull_of_points(points);
  expect_hull(hull, points);
  expect_no_point_above(hull, points);
  EXPECT_EQ(hull.vertices.size(), points.size());
}

TEST(HullOfPoints, OfAPrismWithManySidesIsQuick) {
#if defined(__SANITIZE_ADDRESS__) || !defined(NDEBUG)
  constexpr int kSides = 4000;
#else
  constexpr int kSides = 100000;
#endif
  std::vector<Vec3d> points;
  for (int i = 0; i < kSides; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kSides;
    points.push_back({std::cos(a), std::sin(a), 0.0});
    points.push_back({std::cos(a), std::sin(a), 0.5});
  }
  points = welded(points);
  const HullOfPoints hull = hull_of_points(points);
  expect_hull(hull, points);
  EXPECT_NEAR(volume_of(hull), 0.5 * std::numbers::pi, 1e-5);
  EXPECT_GT(hull.vertices.size(), points.size() / 4);  // the others, rounded to floats, are inside
}

TEST(HullOfPoints, DoesNotDependOnOrderCopiesOrPointsInside) {
  const std::vector<Vec3d> points = points_of(Cloud(in_the_cube), 500, 11);
  const HullOfPoints hull = hull_of_points(points);
  std::vector<Vec3d> others = points;
  std::mt19937_64 random(12);
  for (int i = 0; i < 300; ++i) {
    others.push_back(0.5 * in_the_cube(&random));
  }
  others.insert(others.end(), points.rbegin(), points.rend());
  std::ranges::reverse(others);
  const HullOfPoints same = hull_of_points(welded(others));
  ASSERT_EQ(same.vertices.size(), hull.vertices.size());
  for (std::size_t i = 0; i < hull.vertices.size(); ++i) {
    EXPECT_EQ(norm(same.vertices[i] - hull.vertices[i]), 0.0);
  }
}

TEST(HullOfPoints, OfAHairOffThePlaneIsThatThickOrRefused) {
  std::vector<Vec3d> flat, tilted;
  for (int i = 0; i < 100; ++i) {
    const double x = i % 10, y = i / 10;
    flat.push_back({x, y, 0.0});
    tilted.push_back({x, y, x - y});
  }
  flat.push_back({5.0, 5.0, 0x1p-140});
  tilted.push_back({5.0, 5.0, 0x1p-140});
  const HullOfPoints hull = hull_of_points(welded(flat));
  EXPECT_EQ(hull.vertices.size(), 5U);
  EXPECT_EQ(volume_of(hull), 81.0 * 0x1p-140 / 3.0);
  // Here no double is a point inside.
  EXPECT_TRUE(
      contains(refusal_of([&] { static_cast<void>(hull_of_points(welded(tilted))); }), "too near to one plane"));
}

TEST(HullOfPoints, WithoutVolumeIsRefusedAndSaysWhatToUse) {
  const auto message_for = [](const std::vector<Vec3d>& points) {
    return refusal_of([&] { static_cast<void>(hull_of_points(welded(points))); });
  };
  std::vector<Vec3d> plane, line;
  for (int i = 0; i < 1000; ++i) {
    plane.push_back({static_cast<double>(i % 31), static_cast<double>(i / 31), 3.0 * (i % 31) + 0.5 * (i / 31) + 7.0});
    line.push_back({0.25 * i, 3.0 - 0.5 * i, 1.0 * i});
  }
  EXPECT_TRUE(contains(message_for(plane), "all 1000 of them lie in one plane"));
  EXPECT_TRUE(contains(message_for(line), "all 1000 of them lie on one straight line"));
  EXPECT_TRUE(contains(message_for({{1, 2, 3}, {1, 2, 3}}), "all of them are one point"));
  EXPECT_TRUE(contains(message_for({}), "no points"));
  for (const char* advice : {"plate:A,B", "disc:R", "needle:L"}) {
    EXPECT_TRUE(contains(message_for(plane), advice));
  }
}

}  // namespace
}  // namespace vex::tests
