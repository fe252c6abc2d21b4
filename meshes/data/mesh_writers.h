// Writes soups as mesh files of the common formats: for the sample bodies and for the tests. Text has each coordinate as
// the shortest that reads back the same double, a 32-bit float's too: so every format says the same.
// Binary formats round to floats, but for .ply, which has doubles where one coordinate is no float.
#pragma once

#include <string>

#include "meshes/polygon_soup.h"

namespace vex {

/// The same points; every polygon cut into triangles that fan out from its first corner.
PolygonSoup triangulated(const PolygonSoup& soup);
/// Every corner a point of its own, as in an STL file.
PolygonSoup with_own_corners(const PolygonSoup& soup);

std::string obj_text(const PolygonSoup& soup);
std::string off_text(const PolygonSoup& soup);
std::string ply_text(const PolygonSoup& soup);
std::string ply_binary(const PolygonSoup& soup);
std::string stl_text(const PolygonSoup& soup);       // triangles
std::string stl_binary(const PolygonSoup& soup);     // triangles
std::string gltf_embedded(const PolygonSoup& soup);  // triangles; the buffer as a data URI
/// triangles; `buffer_uri` names the file that holds gltf_buffer(soup). `nodes` is the JSON of the node array, whose
/// element 0 is the scene's root; mesh 0 is the soup.
std::string gltf_text(const PolygonSoup& soup, const std::string& buffer_uri,
                      const std::string& nodes = R"([{"mesh": 0}])");
std::string gltf_buffer(const PolygonSoup& soup);
std::string glb(const PolygonSoup& soup);
std::string dae_text(const PolygonSoup& soup);
std::string threemf(const PolygonSoup& soup);  // triangles; the archive is not compressed

/// The soup as the format that the extension names (".obj", ".off", ".ply", ".stl", ".gltf", ".glb", ".dae", ".3mf", in
/// any case).
std::string mesh_bytes(const PolygonSoup& soup, const std::string& extension);

}  // namespace vex
