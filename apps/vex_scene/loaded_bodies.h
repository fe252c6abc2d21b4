// The bodies of a scene, loaded: each text once.
#pragma once

#include <vector>

#include "apps/common/bodies.h"
#include "apps/vex_scene/options.h"
#include "apps/vex_scene/scene_input.h"

namespace vex {

/// What the options want of every body, now that all of them are known. Throws UsageError as interpret_bodies does;
/// InputError, with the line, for a text of the file that is malformed.
BodyOptions body_options_of(const SceneOptions& options, const SceneInput& scene);

/// Of each shape of the scene the body. Throws UsageError or InputError for one of the command line, InputError with
/// the line for one of the file.
std::vector<LoadedBody> load_bodies(const SceneInput& scene, const SceneOptions& options,
                                    const BodyOptions& body_options);

}  // namespace vex
