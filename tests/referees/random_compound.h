// Compounds for tests, of the bodies that every test has.
#pragma once

#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include "engine/scene/compound.h"
#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {

/// Parts turned at random, up to `spread` from the origin.
inline Compound random_compound(std::mt19937_64& random, int n_parts, double spread) {
  std::vector<CompoundPart> parts;
  for (int k = 0; k < n_parts; ++k) {
    Transformd pose = random_rotation(random);
    pose.translation = spread * random_direction(random);
    parts.push_back({parse_shape(kTestBodies[static_cast<std::size_t>(k) % kTestBodies.size()]).body, pose});
  }
  return Compound(std::move(parts));
}

}  // namespace vex
