// A scene as a binary glTF 2.0 file, which viewers show.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/common/body_colours.h"
#include "engine/scene/scene.h"

namespace vex {

/// Up to so many bodies are a node each, which every viewer shows. More are instances (EXT_mesh_gpu_instancing, which
/// the file then requires): one node for all bodies of a shape and a colour.
inline constexpr std::size_t kMostNodes = 10000;

/// Throws UsageError, with `option` in the message, where a path does not end in .glb; none is as good.
void require_glb_name(const std::string& path, const std::string& option);

/// A mesh a shape, z up, the box as lines. `names`: of each shape. `colours`: of each body the number in kBodyColours;
/// the bodies of a scene without gaps. In a periodic box bodies are shown once, where their centre is in the box.
/// Throws InputError where 32-bit numbers do not hold the scene.
std::string scene_gltf(const Scene& scene, std::span<const std::string> names,
                       const std::vector<std::uint8_t>& colours);

}  // namespace vex
