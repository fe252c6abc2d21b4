// A file as assimp is shown it: read whole, looked into, and made to keep the coordinates that it states.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "meshes/file_bytes.h"

namespace vex {

/// The files beside a .gltf file that hold its geometry, read whole before anybody looks into them.
struct GltfBuffers {
  std::vector<FileBytes> files;               // each once, however often and in whatever words it is named
  std::map<std::string, std::size_t> by_uri;  // as the document names them
};

struct AssimpInput {
  std::filesystem::path path;          // the file
  std::string extension;               // of its format, in lower case, with its point
  FileBytes bytes;                     // what assimp is shown of it
  std::uint64_t n_geometry_bytes = 0;  // with the buffers beside it, unpacked: what its reading may cost goes by this
  std::string unit;                    // as in PolygonSoup
  double unit_metres = 0.0;
  GltfBuffers buffers = {};
};

/// Whether assimp reads files of that extension (in lower case, with its point), and vex lets it.
bool is_read_by_assimp(const std::string& extension);

/// The file, to be read as `extension` says. Throws InputError for what is no file of that format or needs what assimp
/// does not heed. Changed for assimp are the unit of a COLLADA scene (set to 1: assimp would scale by it) and the names
/// of pictures in a .3mf archive (assimp would read them, and delete them twice).
AssimpInput prepare_for_assimp(const std::filesystem::path& path, const std::string& extension);

struct BufferFile {
  std::filesystem::path path;
  OpenFile file;
};

/// The .bin buffer that a .gltf file names, opened: in the folder of `mesh` or below, wherever links lead
/// (folder_files.h). Its name's escapes like %20 are resolved; where there is no such file, the name is taken as it
/// stands. Nothing where there is neither, or for another place.
std::optional<BufferFile> gltf_buffer_beside(const std::filesystem::path& mesh, const std::string& uri);

/// The extension of a path in lower case.
std::string lower_extension(const std::filesystem::path& path);

}  // namespace vex
