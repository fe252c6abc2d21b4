// Reads the geometry of a file by assimp, and nothing else of it.
//
// The mesh is what assimp reads: its 32-bit coordinates, promoted. Node transforms, its floats too, are applied in
// double; polygons stay polygons; materials, textures and animations are not read.
#pragma once

#include <cstdint>
#include <filesystem>

#include "meshes/assimp_input.h"
#include "meshes/polygon_soup.h"

namespace vex {

/// What becomes of assimp's importer. In some files' pictures and scenes it deletes things twice (5.2): a process that
/// ends with the reading leaves it alone.
enum class ImporterFate : std::uint8_t { destroyed, left_alone };

/// The points and faces of all meshes of the file, with the unit of `input`. `digits` are floats', their last place
/// that of the largest coordinate, as the transforms scale it, and of the transforms' own floats. Throws InputError. A
/// broken file may crash the process: isolated_reader.h is the way to read what one did not write.
PolygonSoup read_by_assimp(const AssimpInput& input, ImporterFate fate = ImporterFate::destroyed);

/// The same of a file, in this process; the second opinion on formats that vex reads itself.
PolygonSoup read_by_assimp(const std::filesystem::path& path);

}  // namespace vex
