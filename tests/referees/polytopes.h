// Polytopes for tests, with their vertices at hand for the exact referee.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "engine/support/convex_body.h"
#include "shapes/box.h"
#include "shapes/polytope.h"
#include "tests/referees/random_poses.h"

namespace vex {

struct TestPolytope {
  std::vector<Vec3d> vertices;
  ConvexBody body;
};

inline std::vector<Vec3d> box_vertices(double a, double b, double c) {
  std::vector<Vec3d> vertices;
  for (int k = 0; k < 8; ++k) {
    vertices.push_back({(k & 1) != 0 ? a / 2 : -a / 2, (k & 2) != 0 ? b / 2 : -b / 2, (k & 4) != 0 ? c / 2 : -c / 2});
  }
  return vertices;
}

inline TestPolytope test_box(double a, double b, double c) { return {box_vertices(a, b, c), Box(a, b, c)}; }

inline TestPolytope test_hull(std::vector<Vec3d> vertices, const Vec3d& centre, double inradius) {
  ConvexBody body = Polytope(vertices, centre, inradius);
  return {std::move(vertices), std::move(body)};
}

inline TestPolytope test_tetrahedron(double scale) {
  const std::vector<Vec3d> v = {
      {scale, scale, scale}, {scale, -scale, -scale}, {-scale, scale, -scale}, {-scale, -scale, scale}};
  return test_hull(v, {}, scale * 0.577);  // 1/sqrt(3) rounded down
}

/// n points on the unit sphere, stretched; its inner ball is claimed to be none.
inline TestPolytope test_point_hull(int n, const Vec3d& stretch, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Vec3d> v;
  for (int k = 0; k < n; ++k) {
    const Vec3d d = random_direction(random);
    const double length = norm(d);
    v.push_back({stretch.x * d.x / length, stretch.y * d.y / length, stretch.z * d.z / length});
  }
  return test_hull(v, {}, 0.0);
}

}  // namespace vex
