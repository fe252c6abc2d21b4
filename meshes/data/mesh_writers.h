// Writes soups as mesh files of the common formats, and keeps a folder for a test's files.
#pragma once

#include <filesystem>
#include <string>

#include "meshes/polygon_soup.h"

namespace vex::tests {

/// A folder under the system's temporary one, gone with this.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file of this folder and returns its path.
  std::filesystem::path file(const std::string& name, const std::string& bytes) const;

 private:
  std::filesystem::path path_;
};

std::string obj_text(const PolygonSoup& soup);
std::string off_text(const PolygonSoup& soup);
std::string ply_text(const PolygonSoup& soup);
std::string ply_binary(const PolygonSoup& soup);
std::string stl_text(const PolygonSoup& soup);    // triangles
std::string stl_binary(const PolygonSoup& soup);  // triangles
std::string gltf_embedded(const PolygonSoup& soup);  // triangles; the buffer as a data URI
/// triangles; `buffer_uri` names the file that holds gltf_buffer(soup). `nodes` is the JSON of the node array, whose
/// element 0 is the scene's root; mesh 0 is the soup.
std::string gltf_text(const PolygonSoup& soup, const std::string& buffer_uri,
                      const std::string& nodes = R"([{"mesh": 0}])");
std::string gltf_buffer(const PolygonSoup& soup);
std::string glb(const PolygonSoup& soup);
std::string dae_text(const PolygonSoup& soup);
std::string threemf_model_text(const PolygonSoup& soup);

/// The soup as the format that the extension names (".obj", ".off", ".ply", ".stl", ".gltf", ".glb", ".dae").
std::string mesh_bytes(const PolygonSoup& soup, const std::string& extension);

}  // namespace vex::tests
