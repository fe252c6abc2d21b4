#include "tests/bench/scene_cases.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "shapes/box.h"
#include "shapes/polytope.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

void place(std::size_t n, double edge, SceneCase& scene) {
  std::mt19937_64 random(1);
  scene.box.emplace(edge, edge, edge);
  scene.shape_of.resize(n, 0);
  scene.poses.reserve(n);
  for (std::size_t k = 0; k < n; ++k) {
    Transformd pose = random_rotation(random);
    for (double* x : {&pose.translation.x, &pose.translation.y, &pose.translation.z}) {
      *x = edge * (random_in_unit_interval(random) - 0.5);
    }
    scene.poses.push_back(Pose::unchecked(pose));
  }
}

SceneCase boxes(std::string name, std::size_t n, const Vec3d& edges, double edge_of_box) {
  SceneCase scene;
  scene.name = std::move(name);
  scene.shapes.push_back(Box(edges.x, edges.y, edges.z));
  scene.edges.push_back(edges);
  place(n, edge_of_box, scene);
  return scene;
}

}  // namespace

Scene SceneCase::scene(const SceneSettings& settings) const {
  Scene made = box ? Scene(*box, settings) : Scene(settings);
  for (const ConvexBody& shape : shapes) made.add_shape(shape);
  for (std::size_t k = 0; k < poses.size(); ++k) made.add(shape_of[k], poses[k]);
  return made;
}

SceneCase cubes(std::size_t n, double eta) {
  return boxes("unit cubes", n, {1.0, 1.0, 1.0}, std::cbrt(static_cast<double>(n) / eta));
}

SceneCase needles(std::size_t n) {
  // 2 V + 2 S M / (4 pi) is what two of them exclude, averaged over orientations.
  const double v = 50.0, s = 202.0, m = 52.0 * 3.14159265358979;
  const double excluded = 2.0 * v + 2.0 * s * m / (4.0 * 3.14159265358979);
  return boxes("needles 1 x 1 x 50", n, {1.0, 1.0, 50.0}, std::cbrt(static_cast<double>(n) * excluded / 2.0));
}

SceneCase unlike_cubes(std::size_t n) {
  constexpr std::size_t kSizes = 24;
  SceneCase scene;
  scene.name = "cubes 1:1000";
  std::vector<double> shares;
  double sum = 0.0;
  for (std::size_t k = 0; k < kSizes; ++k) {
    const double edge = std::pow(1000.0, static_cast<double>(k) / (kSizes - 1));
    scene.shapes.push_back(Box(edge, edge, edge));
    scene.edges.push_back({edge, edge, edge});
    shares.push_back(std::pow(edge, -1.5));
    sum += shares.back();
  }
  place(n, 2.0 * std::sqrt(3.0) * 1000.0, scene);
  // The large ones first, at least one of each; their numbers are then mixed.
  std::size_t at = 0;
  for (std::size_t k = kSizes; k-- > 0 && at < n;) {
    const double of_size = std::round(static_cast<double>(n) * shares[k] / sum);
    for (double j = 0.0; j < std::fmax(of_size, 1.0) && at < n; j += 1.0) {
      scene.shape_of[at++] = static_cast<ShapeId>(k);
    }
  }
  std::mt19937_64 random(2);
  std::shuffle(scene.shape_of.begin(), scene.shape_of.end(), random);
  return scene;
}

SceneCase hulls(std::size_t n) {
  std::mt19937_64 random(1);
  std::vector<Vec3d> points;
  for (int k = 0; k < 100; ++k) {
    const Vec3d dir = random_direction(random);
    points.push_back((0.5 / norm(dir)) * dir);
  }
  SceneCase scene;
  scene.name = "hulls of 100 points";
  scene.shapes.push_back(Polytope(points, Vec3d{}, 0.38));
  // A ball of the same diameter has about the hull's volume.
  place(n, std::cbrt(static_cast<double>(n) * 0.5 / 0.2444), scene);
  return scene;
}

SceneCase numbered_by_place(SceneCase scene) {
  constexpr unsigned kBits = 10;  // of each coordinate, whose unit is the box's edge
  const Vec3d edges = scene.box->face_distances();
  const auto key = [&](const Pose& pose) {
    const Vec3d& t = pose.a_from_b().translation;
    const double shares[] = {t.x / edges.x + 0.5, t.y / edges.y + 0.5, t.z / edges.z + 0.5};
    std::uint32_t bits = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const auto cell = static_cast<std::uint32_t>(std::clamp(shares[axis], 0.0, 0.999) * (1u << kBits));
      for (unsigned bit = 0; bit < kBits; ++bit) bits |= (cell >> bit & 1u) << (3 * bit + axis);
    }
    return bits;
  };
  std::ranges::stable_sort(scene.poses, {}, key);
  return scene;
}

SceneCase in_open_space(SceneCase scene) {
  scene.box.reset();
  return scene;
}

}  // namespace vex
