// Boxes of many kinds of scenes, for the tests of trees of boxes.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/scene/aabb.h"
#include "tests/referees/random_poses.h"

namespace vex {

using Random = std::mt19937_64;
inline double between(Random& random, double low, double up) {
  return low + (up - low) * random_in_unit_interval(random);
}

inline Aabb around(const Vec3d& middle, const Vec3d& half) { return {middle - half, middle + half}; }

struct BoxScene {
  const char* name;
  std::vector<Aabb> boxes;
  double edge;  // what its shifts and its motions are measured by
};

inline Aabb random_box(Random& random, double edge, double least, double most) {
  const auto half = [&] { return 0.5 * std::exp(between(random, std::log(least), std::log(most))); };
  const Vec3d extents{half(), half(), half()};
  return around({between(random, 0, edge), between(random, 0, edge), between(random, 0, edge)}, extents);
}

inline std::vector<Aabb> random_boxes(Random& random, int n, double edge, double least, double most) {
  std::vector<Aabb> boxes;
  for (int k = 0; k < n; ++k) boxes.push_back(random_box(random, edge, least, most));
  return boxes;
}

// On a lattice: faces, edges and corners in common.
inline std::vector<Aabb> stacked(int n) {
  std::vector<Aabb> boxes;
  for (int k = 0; k < n * n * n; ++k) {
    const Vec3d p{static_cast<double>(k % n), static_cast<double>(k / n % n), static_cast<double>(k / n / n)};
    boxes.push_back({p, p + Vec3d{1, 1, 1}});
  }
  return boxes;
}

inline std::vector<Aabb> moved(std::vector<Aabb> boxes, const Vec3d& by) {
  for (Aabb& box : boxes) box = {box.lower + by, box.upper + by};
  return boxes;
}
inline std::vector<Aabb> scaled(std::vector<Aabb> boxes, double by) {
  for (Aabb& box : boxes) box = {by * box.lower, by * box.upper};
  return boxes;
}
inline std::vector<Aabb> joined(std::vector<Aabb> a, const std::vector<Aabb>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline std::vector<BoxScene> box_scenes() {
  Random random(21);
  std::vector<BoxScene> scenes;
  for (const int n : {0, 1, 2, 3, 7, 8, 9, 64, 65, 513}) {
    scenes.push_back({"few", random_boxes(random, n, 4.0, 0.2, 1.0), 4.0});
  }
  scenes.push_back({"alike", random_boxes(random, 1500, 12.0, 0.9, 1.0), 12.0});
  scenes.push_back({"1:1000", random_boxes(random, 1200, 1000.0, 0.3, 300.0), 1000.0});
  std::vector<Aabb> needles;
  for (int k = 0; k < 1000; ++k) {
    const Vec3d d = random_direction(random);
    const Vec3d half{0.1 + std::fabs(d.x), 0.1 + std::fabs(d.y), 0.1 + std::fabs(d.z)};
    needles.push_back(around({between(random, 0, 10), between(random, 0, 10), between(random, 0, 10)}, half));
  }
  scenes.push_back({"needles", needles, 10.0});
  scenes.push_back({"stacked", stacked(8), 8.0});
  scenes.push_back({"plane",
                    [&] {
                      std::vector<Aabb> boxes = random_boxes(random, 600, 30.0, 0.5, 2.0);
                      for (Aabb& box : boxes) box.lower.z = box.upper.z = 1.0;
                      return boxes;
                    }(),
                    30.0});
  scenes.push_back({"points",
                    [&] {
                      std::vector<Aabb> boxes;
                      for (int k = 0; k < 700; ++k) {
                        const Vec3d p{std::floor(between(random, 0, 6)), std::floor(between(random, 0, 6)), 0.0};
                        boxes.push_back({p, p});
                      }
                      return boxes;
                    }(),
                    6.0});
  scenes.push_back({"all equal", std::vector<Aabb>(100, Aabb{{1, 2, 3}, {4, 5, 6}}), 3.0});
  scenes.push_back({"one point", std::vector<Aabb>(100, Aabb{{1, 2, 3}, {1, 2, 3}}), 1.0});
  scenes.push_back({"two far clusters",
                    joined(random_boxes(random, 400, 8.0, 0.5, 1.0),
                           moved(random_boxes(random, 400, 8.0, 0.5, 1.0), {1e10, -1e10, 1e10})),
                    8.0});
  scenes.push_back({"one far away",
                    joined(random_boxes(random, 600, 9.0, 0.5, 1.0), {{{1e150, 1e150, -1e150}, {1e150, 1e150, 1e150}}}),
                    9.0});
  scenes.push_back({"huge", scaled(random_boxes(random, 500, 8.0, 0.5, 1.0), 1e149), 8e149});
  scenes.push_back({"tiny", scaled(random_boxes(random, 500, 8.0, 0.5, 1.0), 1e-150), 8e-150});
  scenes.push_back(
      {"around everything",
       joined(random_boxes(random, 500, 9.0, 0.5, 1.0), std::vector<Aabb>(3, {{-1, -1, -1}, {11, 11, 11}})), 9.0});
  return scenes;
}

// How much wider than it is a box may be taken to be: as floats are stored, relative to its coordinates.
inline double step(const Aabb& box) {
  const auto largest = [](const Vec3d& p) {
    return std::fmax(std::fabs(p.x), std::fmax(std::fabs(p.y), std::fabs(p.z)));
  };
  return 0x1p-22 * std::fmax(largest(box.lower), largest(box.upper));
}
inline Aabb widened(const Aabb& box, double by) {
  return {box.lower - Vec3d{by, by, by}, box.upper + Vec3d{by, by, by}};
}

}  // namespace vex
