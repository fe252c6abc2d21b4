#include "tests/referees/random_scenes.h"

#include <algorithm>
#include <cmath>

#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/cylinder.h"
#include "shapes/ellipsoid.h"
#include "shapes/polytope.h"
#include "shapes/sphere.h"
#include "tests/referees/bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

double between(std::mt19937_64& random, double least, double most) {
  return least + (most - least) * random_in_unit_interval(random);
}
bool one_in(std::mt19937_64& random, std::uint64_t n) { return random() % n == 0; }

ConvexBody known_body(std::mt19937_64& random) {
  static const std::vector<ConvexBody> bodies = [] {
    std::vector<ConvexBody> made;
    for (const char* name : kTestBodies) made.push_back(parse_shape(name).body);
    std::mt19937_64 own(3);
    made.push_back(displaced_hull(12, 0.5, {0.4, -2.0, 1.1}, own));
    made.push_back(displaced_hull(60, 0.6, {}, own));
    made.push_back(displaced_hull(4, 0.7, {30.0, 0.0, -20.0}, own));
    return made;
  }();
  return bodies[random() % bodies.size()];
}

// A body of about this size.
ConvexBody sized_body(double size, std::mt19937_64& random) {
  switch (random() % 6) {
    case 0: return Sphere(0.5 * size);
    case 1: return Box(size, 0.7 * size, 0.4 * size);
    case 2: return Ellipsoid(0.5 * size, 0.3 * size, 0.4 * size);
    case 3: return Capsule(0.6 * size, 0.2 * size);
    case 4: return Cylinder(0.8 * size, 0.3 * size);
    default: return displaced_hull(10, 0.5 * size, {0.0, 2.0 * size, 0.0}, random);
  }
}

ConvexBody thin_body(bool is_long, double size, std::mt19937_64& random) {
  const double thin = 0.01 * size;
  switch (random() % 4) {
    case 0: return is_long ? ConvexBody(Box(thin, thin, size)) : Box(size, thin, size);
    case 1: return is_long ? ConvexBody(Cylinder(size, 0.5 * thin)) : Cylinder(thin, 0.5 * size);
    case 2:
      return is_long ? ConvexBody(Ellipsoid(0.5 * size, 0.5 * thin, 0.5 * thin))
                     : Ellipsoid(0.5 * size, 0.5 * size, 0.5 * thin);
    default: return is_long ? ConvexBody(Capsule(size, 0.5 * thin)) : Box(thin, size, 0.5 * size);
  }
}

std::vector<ConvexBody> bodies_of(SceneStratum stratum, std::mt19937_64& random) {
  std::vector<ConvexBody> bodies;
  const std::size_t n = stratum == SceneStratum::crowded ? 1 + random() % 4 : 2 + random() % 60;
  const ConvexBody kind = known_body(random);
  const ConvexBody thin[] = {thin_body(stratum == SceneStratum::needles, 4.0, random),
                             thin_body(stratum == SceneStratum::needles, 4.0, random)};
  for (std::size_t k = 0; k < n; ++k) {
    switch (stratum) {
      case SceneStratum::one_kind: bodies.push_back(kind); break;
      case SceneStratum::mixed: bodies.push_back(known_body(random)); break;
      case SceneStratum::unlike_sizes:
        bodies.push_back(sized_body(k == 0   ? 10.0
                                    : k == 1 ? 0.01
                                             : std::pow(10.0, between(random, -2.0, 1.0)),
                                    random));
        break;
      case SceneStratum::needles:
      case SceneStratum::plates: bodies.push_back(thin[random() % 2]); break;
      case SceneStratum::crowded:
        bodies.push_back(one_in(random, 3) ? thin_body(one_in(random, 2), 3.0, random) : known_body(random));
        break;
    }
  }
  return bodies;
}

// So that a body has a few neighbours.
double region_of(SceneStratum stratum, const std::vector<ConvexBody>& bodies, std::mt19937_64& random) {
  double volume = 0.0, largest = 0.0;
  for (const ConvexBody& body : bodies) {
    volume += std::pow(2.0 * body.circumradius(), 3);
    largest = std::fmax(largest, 2.0 * body.circumradius());
  }
  if (stratum == SceneStratum::crowded) return largest * between(random, 0.2, 0.9);
  const bool is_thin = stratum == SceneStratum::needles || stratum == SceneStratum::plates;
  const double share = stratum == SceneStratum::needles ? between(random, 0.004, 0.05)
                       : is_thin                        ? between(random, 0.05, 0.4)
                                                        : between(random, 0.2, 1.2);
  return std::fmax(std::cbrt(volume * share), 0.4 * largest);
}

}  // namespace

std::string_view name_of(SceneStratum stratum) {
  switch (stratum) {
    case SceneStratum::one_kind: return "one_kind";
    case SceneStratum::mixed: return "mixed";
    case SceneStratum::unlike_sizes: return "unlike_sizes";
    case SceneStratum::needles: return "needles";
    case SceneStratum::plates: return "plates";
    case SceneStratum::crowded: break;
  }
  return "crowded";
}

Scene RandomScene::empty(const SceneSettings& with) const { return box ? Scene(*box, with) : Scene(with); }

Scene RandomScene::scene(const SceneSettings& with) const {
  Scene made = empty(with);
  for (std::size_t k = 0; k < bodies.size(); ++k) made.add(bodies[k], poses[k]);
  return made;
}

ConvexBody displaced_hull(std::size_t n_points, double radius, const Vec3d& away, std::mt19937_64& random) {
  std::vector<Vec3d> points;
  Vec3d sum;
  for (std::size_t k = 0; k < n_points; ++k) {
    const Vec3d dir = random_direction(random);
    points.push_back(away + (radius / norm(dir)) * dir);
    sum = sum + points.back();
  }
  return Polytope(points, (1.0 / static_cast<double>(n_points)) * sum, 0.0);
}

SceneSettings random_settings(std::mt19937_64& random) {
  constexpr int kThreads[] = {1, 2, 3, 8};
  constexpr BroadPhase kPhases[] = {BroadPhase::automatic, BroadPhase::grid, BroadPhase::tree};
  const std::span<const InstructionSet> sets = instruction_sets();
  SceneSettings settings;
  settings.broad_phase = kPhases[random() % 3];
  settings.n_threads = kThreads[random() % 4];
  settings.instruction_set = sets[random() % sets.size()];
  return settings;
}

Transformd random_place(const RandomScene& scene, std::mt19937_64& random) {
  Transformd pose = one_in(random, 4) ? Transformd{} : random_rotation(random);
  const double reach = scene.box ? 1.5 * scene.size : 0.5 * scene.size;
  Vec3d t{between(random, -reach, reach), between(random, -reach, reach), between(random, -reach, reach)};
  if (one_in(random, 5)) t = {std::round(2.0 * t.x) / 2.0, std::round(2.0 * t.y) / 2.0, std::round(2.0 * t.z) / 2.0};
  pose.translation = t;
  return pose;
}

RandomScene random_scene(SceneStratum stratum, std::mt19937_64& random) {
  RandomScene scene;
  scene.settings = random_settings(random);
  scene.bodies = bodies_of(stratum, random);
  scene.size = region_of(stratum, scene.bodies, random);
  const double l = scene.size;
  const std::uint64_t kind = stratum == SceneStratum::crowded ? 1 + random() % 2 : random() % 3;
  if (kind == 1) scene.box.emplace(l, between(random, 0.6, 1.6) * l, between(random, 0.8, 1.3) * l);
  if (kind == 2) {
    scene.box.emplace(l, between(random, 0.6, 1.6) * l, between(random, 0.8, 1.3) * l, between(random, -1.0, 1.0),
                      between(random, -0.7, 0.7), between(random, -0.7, 0.7));
  }
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) scene.poses.push_back(random_place(scene, random));
  return scene;
}

}  // namespace vex
