// A scene as a binary glTF 2.0 file, which viewers show.
#pragma once

#include <string>

#include "apps/vex_scene/scene_run.h"

namespace vex {

/// Up to so many bodies are a node each, which every viewer shows. More are instances (EXT_mesh_gpu_instancing, which
/// the file then requires): one node for all bodies of a shape and a colour.
inline constexpr std::size_t kMostNodes = 10000;

/// A mesh a shape, z up, the box as lines. Colours: of clusters the largest stands out, others take turns, single
/// bodies are pale; of pairs the bodies that have one stand out. In a periodic box bodies are shown once, where their
/// centre is in the box. Throws InputError where 32-bit numbers do not hold the scene.
std::string scene_gltf(const SceneRun& run, const Scene& scene);

}  // namespace vex
