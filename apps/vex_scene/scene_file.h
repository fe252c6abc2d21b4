// A file of bodies and poses: CSV, a body a row.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "apps/vex_scene/scene_input.h"

namespace vex {

/// Both headers, as messages and the help show them.
inline constexpr const char* kSceneHeaders = "body,x,y,z,qw,qx,qy,qz or body,x,y,z,r11,r12,r13,r21,r22,r23,r31,r32,r33";

/// What `named` gives a name to is known by it in the column `body`; other cells there are texts of bodies. `path`: "-"
/// is standard input. Empty lines may stand at the end. `n_lines`: where to count those that are read, for whoever
/// looks from another thread. Throws InputError with the line of what is wrong.
SceneInput read_scene_file(const std::string& path, const std::map<std::string, std::string, std::less<>>& named,
                           std::atomic<std::uint64_t>* n_lines = nullptr);

/// The scene as such a file, with the poses as matrices: they come back bit for bit.
std::string scene_file_text(const SceneInput& scene);

}  // namespace vex
