// Reads the geometry of a mesh file, and nothing else of it.
//
// .obj .off .ply .stl .vtk .msh and points as text (.xyz .csv .txt), all of them also packed by gzip (.gz), are read
// strictly, in this process, in double (formats/strict_readers.h); the other formats by assimp, in a confined process
// of its own (isolated_reader.h). No file is opened but the one named, and for .gltf the .bin buffers beside it; one
// that changes while it is read is refused.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "meshes/confinement.h"  // Confining
#include "meshes/file_bytes.h"   // checked_file_size
#include "meshes/polygon_soup.h"

namespace vex {

/// Whether the extension is that of a format that holds meshes and is read. Formats of points alone (.xyz .csv .txt)
/// are not counted: whoever names an output so means a table, not a mesh.
bool names_a_mesh_format(const std::filesystem::path& path);

struct ReadOptions {
  std::string format;    // an extension (".ply", "stl.gz", in any case) to read the file by in place of its own
  bool isolated = true;  // assimp in a process of its own: the way to read what one did not write
  Confining confining = Confining::as_far_as_possible;  // of that process
};

/// The points and faces of all meshes of the file; "-" is standard input, which needs a format and takes those alone
/// that are read in this process. Throws UsageError for a format that is none or missing, and otherwise InputError.
PolygonSoup read_polygon_soup(const std::filesystem::path& path, const ReadOptions& options = {});

/// The files that reading `path` opens: itself, and for .gltf the buffers that it names and that are there. Empty for
/// "-". Never throws for what the file holds; `format` as in ReadOptions.
std::vector<std::filesystem::path> files_read_with(const std::filesystem::path& path, const std::string& format = {});

}  // namespace vex
