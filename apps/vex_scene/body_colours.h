// Colours of bodies in a picture, by what was found of them.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/common/body_colours.h"
#include "apps/vex_scene/findings.h"

namespace vex {

/// Of each body the number of its colour.
std::vector<std::uint8_t> body_colours(SceneQuery query, const Findings& found, std::size_t n_bodies);

}  // namespace vex
