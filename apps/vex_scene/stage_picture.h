// How many pairs came to each stage of a scene's search, and how many it settled: a picture for --svg.
#pragma once

#include <string>

#include "apps/vex_scene/scene_run.h"

namespace vex {

/// An SVG file: a bar a stage, as long as the pairs that it saw are many.
std::string stage_picture(const SceneRun& run);

}  // namespace vex
