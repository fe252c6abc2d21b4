// Reads the geometry of a mesh file, and nothing else of it.
//
// The reading is assimp's, so a mesh is whatever assimp reads. Node transforms are applied; polygons stay polygons;
// materials, textures and animations are not read, and no file is opened but the one named (for .gltf also the .bin
// buffers beside it). What assimp 5.2 misreads is mended on the way (reader_quirks.h).
//
// Points without faces are read from .ply, .obj, .off and .gltf too, for hulls. Where there are faces, points that none
// uses come from .ply and .off; of an .obj assimp delivers only the vertices that its elements (f, l, p) name.
#pragma once

#include <cstdint>
#include <filesystem>

#include "meshes/polygon_soup.h"

namespace vex {

/// The size in bytes of `path`, a regular file that can be opened and is not empty. Throws InputError otherwise; never
/// waits, whatever is there (a pipe, a device).
std::uintmax_t checked_file_size(const std::filesystem::path& path);

/// Whether the extension is that of a format that is read.
bool names_a_mesh_format(const std::filesystem::path& path);

/// The points and faces of all meshes of the file. Throws InputError. A broken file may crash the reading process:
/// isolated_reader.h is the way to read what one did not write.
PolygonSoup read_polygon_soup(const std::filesystem::path& path);

}  // namespace vex
