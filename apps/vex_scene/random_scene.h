// A scene of random bodies: isotropic, uniform in a periodic cube.
#pragma once

#include <cstdint>

#include "apps/common/bodies.h"
#include "apps/vex_scene/options.h"
#include "apps/vex_scene/scene_input.h"

namespace vex {

/// The cube in which so many bodies of this volume are at that share of space: N V / L^3 = eta. Throws InputError where
/// the body is flat, or the edge out of range.
PeriodicBox box_of_random_scene(const RandomScene& scene, const LoadedBody& body);

/// The bodies: of body k a function of the seed and k alone. Its origin is uniform in the cube, its rotation over all
/// rotations. `scene` has the one shape, and no bodies yet.
void place_at_random(SceneInput& scene, const RandomScene& random, std::uint32_t shape, const PeriodicBox& box,
                     std::uint64_t seed);

}  // namespace vex
