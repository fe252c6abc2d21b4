#include "meshes/data/sample_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "meshes/data/mesh_writers.h"
#include "meshes/hull.h"
#include "meshes/nearest_float.h"
#include "meshes/polygon_soup.h"

namespace vex {
namespace {

PolygonSoup with_points(std::vector<Vec3d> points) {
  PolygonSoup soup;
  soup.points = std::move(points);
  soup.n_parts = 1;
  return soup;
}

PolygonSoup tetrahedron() {
  PolygonSoup soup = with_points({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});
  soup.add_face({0, 1, 2});
  soup.add_face({0, 3, 1});
  soup.add_face({0, 2, 3});
  soup.add_face({1, 3, 2});
  return soup;
}

PolygonSoup cube() {
  PolygonSoup soup;
  soup.n_parts = 1;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      for (const double z : {-0.5, 0.5}) {
        soup.points.push_back({x, y, z});
      }
    }
  }
  soup.add_face({0, 1, 3, 2});
  soup.add_face({4, 6, 7, 5});
  soup.add_face({0, 4, 5, 1});
  soup.add_face({2, 3, 7, 6});
  soup.add_face({0, 2, 6, 4});
  soup.add_face({1, 5, 7, 3});
  return soup;
}

PolygonSoup octahedron() {
  PolygonSoup soup = with_points({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
  for (std::uint32_t i = 0; i < 4; ++i) {
    soup.add_face({i, (i + 1) % 4, 4});
    soup.add_face({(i + 1) % 4, i, 5});
  }
  return soup;
}

/// With a the half-edge of the inscribed cube and p, q the other two coordinates, a pentagon is planar where
/// a (p - q) = p (p - a). Products of neighbouring Fibonacci numbers solve that in whole numbers that floats hold, and
/// p / a is the golden ratio to 7e-8; 2^-23 brings them to the size of one.
PolygonSoup dodecahedron() {
  constexpr double a = 0x1p-23 * 2584.0 * 2584.0;
  constexpr double p = 0x1p-23 * 2584.0 * 4181.0;
  constexpr double q = 0x1p-23 * 4181.0 * 987.0;
  PolygonSoup soup =
      with_points({{a, a, a},    {a, a, -a},  {a, -a, a}, {a, -a, -a}, {-a, a, a},  {-a, a, -a}, {-a, -a, a},
                   {-a, -a, -a}, {0, q, p},   {0, q, -p}, {0, -q, p},  {0, -q, -p}, {q, p, 0},   {q, -p, 0},
                   {-q, p, 0},   {-q, -p, 0}, {p, 0, q},  {p, 0, -q},  {-p, 0, q},  {-p, 0, -q}});
  soup.add_face({0, 8, 10, 2, 16});
  soup.add_face({4, 18, 6, 10, 8});
  soup.add_face({1, 17, 3, 11, 9});
  soup.add_face({5, 9, 11, 7, 19});
  soup.add_face({0, 12, 14, 4, 8});
  soup.add_face({1, 9, 5, 14, 12});
  soup.add_face({2, 10, 6, 15, 13});
  soup.add_face({3, 13, 15, 7, 11});
  soup.add_face({0, 16, 17, 1, 12});
  soup.add_face({2, 13, 3, 17, 16});
  soup.add_face({4, 14, 5, 19, 18});
  soup.add_face({6, 18, 19, 7, 15});
  return soup;
}

PolygonSoup icosahedron() {
  constexpr double p = double{1.618034F};  // the float nearest to the golden ratio
  PolygonSoup soup = with_points({{0, 1, p},
                                  {0, 1, -p},
                                  {0, -1, p},
                                  {0, -1, -p},
                                  {1, p, 0},
                                  {1, -p, 0},
                                  {-1, p, 0},
                                  {-1, -p, 0},
                                  {p, 0, 1},
                                  {p, 0, -1},
                                  {-p, 0, 1},
                                  {-p, 0, -1}});
  for (const auto& [i, j, k] : std::vector<std::array<std::uint32_t, 3>>{
           {0, 2, 8}, {2, 0, 10}, {3, 1, 9}, {1, 3, 11},  {4, 6, 0},   {6, 4, 1}, {7, 5, 2},
           {5, 7, 3}, {8, 9, 4},  {9, 8, 5}, {11, 10, 6}, {10, 11, 7}, {0, 8, 4}, {0, 6, 10},
           {2, 5, 8}, {2, 10, 7}, {1, 4, 9}, {1, 11, 6},  {3, 9, 5},   {3, 7, 11}}) {
    soup.add_face({i, j, k});
  }
  return soup;
}

/// A brilliant of 25 faces: an eight-sided table, crown, girdle and pavilion over one octagon with corners (12, 5),
/// (5, 12), ... at half and at full size. All coordinates are binary fractions and all faces exactly planar.
PolygonSoup gem() {
  constexpr std::array<std::array<double, 2>, 8> kOctagon{
      {{12, 5}, {5, 12}, {-5, 12}, {-12, 5}, {-12, -5}, {-5, -12}, {5, -12}, {12, -5}}};
  PolygonSoup soup;
  soup.n_parts = 1;
  for (const auto& [scale, z] : std::array<std::array<double, 2>, 3>{{{1.0, -0.5}, {1.0, 0.5}, {0.5, 5.0}}}) {
    for (const auto& [x, y] : kOctagon) {
      soup.points.push_back({scale * x, scale * y, z});
    }
  }
  soup.points.push_back({0, 0, -11});
  soup.add_face({16, 17, 18, 19, 20, 21, 22, 23});
  for (std::uint32_t i = 0; i < 8; ++i) {
    const std::uint32_t j = (i + 1) % 8;
    soup.add_face({24, j, i});
    soup.add_face({i, j, 8 + j, 8 + i});
    soup.add_face({8 + i, 8 + j, 16 + j, 16 + i});
  }
  return soup;
}

/// The hull of points on a bumpy ellipsoid with semi-axes 3, 2 and 1.5, to three decimals.
PolygonSoup pebble() {
  std::mt19937_64 random(2002);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
  const auto three_decimals = [](double x) { return nearest_float(std::nearbyint(x * 1000.0) / 1000.0); };
  PolygonSoup soup;
  soup.n_parts = 1;
  while (soup.points.size() < 300) {
    const double cosine = 2.0 * uniform() - 1.0;
    const double azimuth_rad = 2.0 * std::numbers::pi * uniform();
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const double x = sine * std::cos(azimuth_rad);
    const double y = sine * std::sin(azimuth_rad);
    const double bump = 1.0 + 0.06 * std::sin(2.0 * x + 3.0 * cosine) * std::cos(2.5 * y + 1.0);
    soup.points.push_back(
        {three_decimals(3.0 * bump * x), three_decimals(2.0 * bump * y), three_decimals(1.5 * bump * cosine)});
  }
  std::vector<std::array<std::uint32_t, 3>> triangles = convex_hull_triangles(soup.points);
  for (auto& triangle : triangles) {
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  }
  std::sort(triangles.begin(), triangles.end());  // an order of our own, not Qhull's
  for (const auto& [a, b, c] : triangles) {
    soup.add_face({a, b, c});
  }
  return soup;
}

std::string commented_obj(const std::string& what, const PolygonSoup& soup) {
  return "# " + what + "\n# Part of vex, BSD-3-Clause; written by make_sample_bodies.\n" + obj_text(soup);
}

}  // namespace

std::map<std::string, std::string> sample_body_files() {
  return {
      {"tetrahedron.obj", commented_obj("Regular tetrahedron, edge 2 sqrt(2), about the origin.", tetrahedron())},
      {"cube.obj", commented_obj("Cube, edge 1, about the origin; quads.", cube())},
      {"octahedron.obj", commented_obj("Regular octahedron, edge sqrt(2), about the origin.", octahedron())},
      {"dodecahedron.obj", commented_obj("Regular dodecahedron to 7e-8, pentagons planar exactly.", dodecahedron())},
      {"icosahedron.obj", commented_obj("Regular icosahedron, edge 2, about the origin.", icosahedron())},
      {"icosahedron.stl", stl_binary(icosahedron())},
      {"icosahedron.ply", ply_binary(icosahedron())},
      {"icosahedron.off", off_text(icosahedron())},
      {"icosahedron.gltf", gltf_embedded(icosahedron())},
      {"gem.obj", commented_obj("A brilliant of 25 faces, planar exactly.", gem())},
      {"pebble.obj",
       commented_obj("A pebble: the hull of points on a bumpy ellipsoid, semi-axes 3, 2, 1.5.", pebble())},
  };
}

}  // namespace vex
