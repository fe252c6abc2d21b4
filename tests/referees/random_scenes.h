// Random scenes for tests: which bodies they hold, how many, and in what kind of box.
#pragma once

#include <array>
#include <optional>
#include <random>
#include <string_view>
#include <vector>

#include "engine/scene/scene.h"

namespace vex {

enum class SceneStratum {
  one_kind,      // of one of the bodies of bodies.h, or of a hull that is far from its frame's origin
  mixed,         // of all of them
  unlike_sizes,  // 1:1000, every body a shape of its own
  needles,       // 1:100
  plates,        // 100:1
  crowded,       // few bodies, larger than the box: they meet several copies of each other, and their own
};
inline constexpr std::array kSceneStrata = {SceneStratum::one_kind, SceneStratum::mixed,  SceneStratum::unlike_sizes,
                                            SceneStratum::needles,  SceneStratum::plates, SceneStratum::crowded};
std::string_view name_of(SceneStratum stratum);

struct RandomScene {
  std::vector<ConvexBody> bodies;  // copies of a body are one shape
  std::vector<Transformd> poses;
  std::optional<PeriodicBox> box;
  double size = 1.0;  // the edge of the region that the bodies are placed in
  SceneSettings settings;

  Scene scene() const { return scene(settings); }
  Scene scene(const SceneSettings& with) const;
  Scene empty(const SceneSettings& with) const;
};

/// Bodies at places that may be outside of the box, a quarter of them unturned, a fifth at multiples of a half; open,
/// orthorhombic and triclinic boxes, a third each (but crowded ones are all boxes); any broad phase, any instruction
/// set, 1, 2, 3 or 8 threads.
RandomScene random_scene(SceneStratum stratum, std::mt19937_64& random);

/// Anywhere in the scene's region and around it.
Transformd random_place(const RandomScene& scene, std::mt19937_64& random);
SceneSettings random_settings(std::mt19937_64& random);

/// The convex hull of random points on a sphere whose middle is `away` from the origin of the hull's frame.
ConvexBody displaced_hull(std::size_t n_points, double radius, const Vec3d& away, std::mt19937_64& random);

}  // namespace vex
