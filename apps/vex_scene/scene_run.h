// All that vex_scene reports of one scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/vex_scene/findings.h"

namespace vex {

struct SceneRun {
  std::string command;
  SceneOptions options;
  bool is_loaded = false;               // false: of the scene nothing is known but the options
  bool is_interrupted = false;          // while rows or files were written, where there is an answer
  std::vector<LoadedBody> bodies;       // a shape each
  std::vector<std::uint64_t> n_copies;  // of each
  std::uint64_t n_bodies = 0;
  std::optional<PeriodicBox> box;
  Findings found;
  double read_seconds = 0.0;  // and load the bodies
  double seconds = 0.0;
};

}  // namespace vex
