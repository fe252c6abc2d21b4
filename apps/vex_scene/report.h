// What vex_scene says of a scene: on the screen, and as a document.
#pragma once

#include <string>

#include "apps/vex_scene/scene_run.h"

namespace vex {

/// A document lists at most so many rows, undecided pairs, shapes and clusters each.
inline constexpr std::size_t kMostListed = 1000;

/// The summary: what was found, and what each stage saw and settled.
std::string summary_text(const SceneRun& run);

/// The document of --json.
std::string report_json(const SceneRun& run);

}  // namespace vex
