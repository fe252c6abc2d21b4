// What scenes find, as arrays of rows.
#pragma once

#include <vector>

#include "engine/scene/scene.h"
#include "python/bindings/arrays.h"

namespace vex::python {

/// -1 of no body.
inline std::int64_t body_number(BodyId body) { return body == kNoBody ? -1 : static_cast<std::int64_t>(body); }

py::array rows_of(const std::vector<ScenePair>& pairs);
py::array rows_of(const SceneDistances& distances);
/// A row each contact, those of a pair one after another.
py::array rows_of(const SceneManifolds& manifolds);

/// Of each stage that had any: how many pairs it saw, and how many it settled.
py::dict stages_of(const SceneCounts& counts);

/// Tells NumPy of the rows, once.
void register_scene_rows();

}  // namespace vex::python
