#include "engine/support/direction_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/referees/random_poses.h"

namespace vex {
namespace {

/// Vertices by coordinate, and the scan over all of them that every answer is held against.
struct Points {
  std::vector<double> x, y, z;

  void add(const Vec3d& v) {
    x.push_back(v.x);
    y.push_back(v.y);
    z.push_back(v.z);
  }
  Vec3d at(std::size_t i) const { return {x[i], y[i], z[i]}; }
  std::size_t size() const { return x.size(); }
  Vec3d scan(const Vec3d& dir) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < size(); ++i) {
      if (dot(at(i), dir) > dot(at(best), dir)) best = i;
    }
    return at(best);
  }
  DirectionMap map() const { return {x, y, z}; }
};

bool same_bits(const Vec3d& a, const Vec3d& b) {
  return bits_of(a.x) == bits_of(b.x) && bits_of(a.y) == bits_of(b.y) && bits_of(a.z) == bits_of(b.z);
}

Vec3d random_unit(std::mt19937_64& random) {
  const Vec3d d = random_direction(random);
  return (1.0 / norm(d)) * d;
}

double random_between(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * random_in_unit_interval(random);
}

Points ellipsoid_points(int n, const Vec3d& semi_axes, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Points points;
  for (int k = 0; k < n; ++k) {
    const Vec3d d = random_unit(random);
    points.add({semi_axes.x * d.x, semi_axes.y * d.y, semi_axes.z * d.z});
  }
  return points;
}

/// n * n points on each face of the cube [-1, 1]^3.
Points cube_points(int n) {
  Points points;
  const auto grid = [n](int k) { return 2.0 * k / (n - 1) - 1.0; };
  for (int face = 0; face < 6; ++face) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        const double side = face % 2 == 0 ? 1.0 : -1.0, a = grid(j), b = grid(k);
        points.add(face / 2 == 0 ? Vec3d{side, a, b} : (face / 2 == 1 ? Vec3d{a, side, b} : Vec3d{a, b, side}));
      }
    }
  }
  return points;
}

Points transformed(const Points& from, const Transformd& pose, double scale) {
  Points to;
  for (std::size_t i = 0; i < from.size(); ++i) to.add(scale * pose(from.at(i)));
  return to;
}

/// Directions in which tables go wrong: the borders of cells, a little beside them, normals of facets and edges, and
/// coordinates that differ by many powers of ten.
Vec3d awkward_direction(std::mt19937_64& random, const Points& points) {
  const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const auto a_little = [&] {
    const double sign = pick(2) == 0 ? 1.0 : -1.0;
    return pick(3) == 0 ? 0.0 : sign * std::pow(10.0, random_between(random, -17.0, -3.0));
  };
  Vec3d d;
  switch (pick(5)) {
    case 0:  // axes, diagonals of faces and of space
      d = {static_cast<double>(pick(3)) - 1.0, static_cast<double>(pick(3)) - 1.0, static_cast<double>(pick(3)) - 1.0};
      break;
    case 1:  // on the grid of cells
      d = {1.0, static_cast<double>(pick(65)) / 32.0 - 1.0, static_cast<double>(pick(65)) / 32.0 - 1.0};
      if (pick(2) == 0) d = {d.y, -d.x, d.z};
      if (pick(2) == 0) d = {d.y, d.z, -d.x};
      break;
    case 2: {  // the normal of three vertices: two or more tie but for rounding
      const Vec3d o = points.at(pick(points.size()));
      d = cross(points.at(pick(points.size())) - o, points.at(pick(points.size())) - o);
      break;
    }
    case 3:  // square to an edge of two vertices
      d = cross(points.at(pick(points.size())) - points.at(pick(points.size())), random_unit(random));
      break;
    default:
      d = {random_between(random, -1.0, 1.0) * std::pow(10.0, random_between(random, -18.0, 0.0)),
           random_between(random, -1.0, 1.0) * std::pow(10.0, random_between(random, -18.0, 0.0)),
           random_between(random, -1.0, 1.0)};
  }
  d = scaled_to_unit_exponent(d);
  if (!is_finite(d)) return {0.0, 0.0, 1.0};
  return {d.x + a_little(), d.y + a_little(), d.z + a_little()};
}

/// Holds table and scan against each other for `n` random directions and `n` awkward ones.
void expect_same_as_scan(const std::string& name, const Points& points, int n, std::uint64_t seed = 1) {
  SCOPED_TRACE(name);
  const DirectionMap map = points.map();
  std::mt19937_64 random(seed);
  int n_wrong = 0;
  for (int k = 0; k < 2 * n; ++k) {
    Vec3d dir = k < n ? random_unit(random) : awkward_direction(random, points);
    if (!map.takes(dir)) dir = {1.0, 0.0, 0.0};
    ASSERT_TRUE(map.takes(dir));
    if (!same_bits(map.support(dir), points.scan(dir)) && n_wrong++ == 0) {
      ADD_FAILURE() << "for (" << dir.x << ", " << dir.y << ", " << dir.z << ")";
    }
  }
  EXPECT_EQ(n_wrong, 0) << "of " << 2 * n;
}

TEST(DirectionMap, GivesTheVertexOfTheScanOnHulls) {
  for (const int n : {1, 2, 3, 4, 7, 10, 33, 100, 316, 1000}) {
    const auto seed = static_cast<std::uint64_t>(n);
    const int n_directions = n <= 100 ? 50000 : 20000;
    expect_same_as_scan("ellipsoid of " + std::to_string(n), ellipsoid_points(n, {3.0, 2.0, 1.0}, seed), n_directions);
    expect_same_as_scan("sphere of " + std::to_string(n), ellipsoid_points(n, {1.0, 1.0, 1.0}, seed), 5000);
  }
  expect_same_as_scan("ellipsoid of 10^4", ellipsoid_points(10000, {3.0, 2.0, 1.0}, 5), 5000);
  expect_same_as_scan("ellipsoid of 10^5", ellipsoid_points(100000, {3.0, 2.0, 1.0}, 5), 300);
  expect_same_as_scan("needle", ellipsoid_points(2000, {1000.0, 1.0, 1.0}, 6), 3000);
  expect_same_as_scan("plate", ellipsoid_points(2000, {1.0, 1.0, 1e-9}, 7), 3000);
}

TEST(DirectionMap, GivesTheVertexOfTheScanWhereVerticesAreCoplanar) {
  for (const int n : {2, 3, 5, 12, 30}) {
    const Points cube = cube_points(n);
    expect_same_as_scan("cube of " + std::to_string(n), cube, n < 20 ? 20000 : 5000);
    // Turned, each facet's vertices are in one plane only up to rounding.
    std::mt19937_64 random(3);
    expect_same_as_scan("turned cube of " + std::to_string(n), transformed(cube, random_rotation(random), 1.0),
                        n < 20 ? 20000 : 5000);
  }
}

TEST(DirectionMap, GivesTheVertexOfTheScanOfFlatSets) {
  std::mt19937_64 random(8);
  Points flat, tilted, line, axis;
  const Vec3d a = random_unit(random), b = random_unit(random);
  for (int k = 0; k < 500; ++k) {
    const double s = random_between(random, -1.0, 1.0), t = random_between(random, -1.0, 1.0);
    flat.add({s, t, 0.25});
    tilted.add(s * a + t * b);
    line.add(s * a);
    axis.add({0.0, s, 0.0});
  }
  expect_same_as_scan("in a plane", flat, 20000);
  expect_same_as_scan("in a tilted plane", tilted, 20000);
  expect_same_as_scan("on a line", line, 20000);
  expect_same_as_scan("on an axis", axis, 20000);
  Points point;
  point.add({0.5, -0.0, -3.0});
  expect_same_as_scan("a point", point, 1000);
}

TEST(DirectionMap, OfEqualVerticesTheFirstAnswers) {
  // Zeros of either sign tie, and tell which of the two answered.
  std::mt19937_64 random(9);
  Points repeated;
  for (int k = 0; k < 2000; ++k) {
    const std::uint64_t bits = random();
    const auto coordinate = [&](unsigned at) {
      const double zero = ((bits >> (at + 1)) & 1U) != 0 ? 0.0 : -0.0;
      return ((bits >> at) & 1U) != 0 ? zero : (((bits >> (at + 1)) & 1U) != 0 ? 1.0 : -1.0);
    };
    repeated.add({coordinate(0), coordinate(2), coordinate(4)});
  }
  expect_same_as_scan("repeated", repeated, 10000);
  EXPECT_LT(repeated.map().bytes(), std::size_t{100000}) << "repeated vertices are not all kept in every cell";
}

TEST(DirectionMap, VerticesInsideAreNoHindrance) {
  std::mt19937_64 random(10);
  Points ball;
  for (int k = 0; k < 5000; ++k) ball.add(std::cbrt(random_in_unit_interval(random)) * random_unit(random));
  expect_same_as_scan("points in a ball", ball, 5000);
}

TEST(DirectionMap, GivesTheVertexOfTheScanOfClusters) {
  // Vertices within few roundings of each other: which of them has the largest computed product is a matter of
  // rounding, and any margin that is too small leaves out the right one.
  for (const double thickness : {1e-17, 1e-16, 3e-16, 1e-15, 1e-14, 1e-12}) {
    std::mt19937_64 random(11);
    Points corners, sliver;
    for (int k = 0; k < 400; ++k) {
      const auto noise = [&] { return 1.0 + thickness * random_between(random, -1.0, 1.0); };
      const auto sign = [&] { return random() % 2 == 0 ? 1.0 : -1.0; };
      corners.add({sign() * noise(), 0.7 * sign() * noise(), 0.3 * sign() * noise()});
      sliver.add({random_between(random, -1.0, 1.0), random_between(random, -1.0, 1.0),
                  thickness * random_between(random, -1.0, 1.0)});
    }
    expect_same_as_scan("corners of thickness " + std::to_string(thickness), corners, 20000);
    expect_same_as_scan("sliver of thickness " + std::to_string(thickness), sliver, 10000);
    std::mt19937_64 turn(12);
    expect_same_as_scan("turned sliver", transformed(sliver, random_rotation(turn), 1.0), 10000);
  }
}

TEST(DirectionMap, GivesTheVertexOfTheScanAtAnyScale) {
  const Points hull = ellipsoid_points(500, {3.0, 2.0, 1.0}, 13), cube = cube_points(8);
  for (const double scale : {1e-250, 1e-150, 1e-20, 1e20, 1e150, 1e250}) {
    expect_same_as_scan("hull times " + std::to_string(scale), transformed(hull, Transformd{}, scale), 5000);
    expect_same_as_scan("cube times " + std::to_string(scale), transformed(cube, Transformd{}, scale), 5000);
  }
  for (const double offset : {1e3, 1e8, 1e15}) {
    Transformd away{};
    away.translation = {offset, -0.3 * offset, 0.1 * offset};
    expect_same_as_scan("hull away from the origin", transformed(hull, away, 1.0), 5000);
    expect_same_as_scan("cube away from the origin", transformed(cube, away, 1.0), 5000);
  }
}

TEST(DirectionMap, TakesDirectionsOfAnyUsualLength) {
  const Points hull = ellipsoid_points(300, {3.0, 2.0, 1.0}, 14);
  const DirectionMap map = hull.map();
  std::mt19937_64 random(15);
  for (int k = 0; k < 20000; ++k) {
    // What the engine promises, and coordinates that are denormal beside others.
    const Vec3d unit = random_unit(random);
    const double length = std::ldexp(1.0, static_cast<int>(random() % 201) - 100);
    const auto shrunk = [&](double x) { return random() % 4 == 0 ? x * 0x1p-1060 : x; };
    const Vec3d dir = {shrunk(length * unit.x), shrunk(length * unit.y), length};
    ASSERT_TRUE(map.takes(dir));
    ASSERT_TRUE(same_bits(map.support(dir), hull.scan(dir)));
  }
}

TEST(DirectionMap, TakesNoDirectionThatItCouldGetWrong) {
  const DirectionMap map = ellipsoid_points(300, {3.0, 2.0, 1.0}, 16).map();
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const double size : {0.0, 5e-324, 1e-280, 1e280, infinity, nan}) {
    EXPECT_FALSE(map.takes(Vec3d{0.0, size, 0.0})) << size;
    EXPECT_FALSE(map.takes(Vec3d{-size, -size, size})) << size;
  }
  // A NaN beside a usable coordinate finds some vertex, not memory that is none.
  for (const Vec3d& dir : {Vec3d{nan, 1.0, 0.0}, {1.0, nan, 0.0}, {0.0, 1.0, nan}}) {
    EXPECT_TRUE(!map.takes(dir) || is_finite(map.support(dir)));
  }
  for (const double scale : {0.0, 1e-320, 1e307}) {
    const DirectionMap none = transformed(cube_points(3), Transformd{}, scale).map();
    EXPECT_FALSE(none.takes(Vec3d{1.0, 0.0, 0.0})) << "bodies of size " << scale;
  }
}

TEST(DirectionMap, MemoryGrowsWithTheVertices) {
  // Whatever the shape: some two hundred bytes a vertex for round bodies, never more than the limit on what is kept.
  const auto bytes_each = [](const Points& points) {
    return static_cast<double>(points.map().bytes()) / static_cast<double>(points.size());
  };
  EXPECT_LT(bytes_each(ellipsoid_points(20000, {3.0, 2.0, 1.0}, 17)), 250.0);
  EXPECT_LT(bytes_each(ellipsoid_points(20000, {100.0, 1.0, 1.0}, 17)), 300.0);
  EXPECT_LT(bytes_each(cube_points(60)), 1000.0);
  Points circle;
  for (int k = 0; k < 5000; ++k) circle.add({std::cos(0.001256637 * k), std::sin(0.001256637 * k), 0.0});
  EXPECT_LT(bytes_each(circle), 1000.0);
}

}  // namespace
}  // namespace vex
