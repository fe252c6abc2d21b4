#include "meshes/assimp_input.h"

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <optional>
#include <string_view>

#include "meshes/folder_files.h"
#include "meshes/formats/content_kind.h"
#include "meshes/formats/gltf_json.h"
#include "meshes/formats/scene_formats.h"

namespace vex {
namespace {

/// Formats whose files cannot look like another's: what looks like another's is that.
constexpr std::array<std::string_view, 6> kUnmistakable{".gltf", ".glb", ".dae", ".3mf", ".fbx", ".amf"};

bool is_one_of(std::string_view extension, const auto& extensions) {
  return std::ranges::find(extensions, extension) != extensions.end();
}

void check_kind(const AssimpInput& input) {
  const std::optional<ContentKind> kind = content_kind(input.bytes.view());
  if (!kind || kind->extension == input.extension) return;
  const bool is_zip = kind->extension == ".zip" && input.extension == ".3mf";
  const bool is_building = input.extension == ".ifc" && input.bytes.view().starts_with("ISO-10303-21");
  if (is_zip || is_building) return;
  if (kind->extension.empty() || is_one_of(input.extension, kUnmistakable)) {
    refuse_kind(input.path.string(), *kind, input.extension);
  }
}

}  // namespace

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

std::optional<BufferFile> gltf_buffer_beside(const std::filesystem::path& mesh, const std::string& uri) {
  for (const std::string& name : {percent_decoded(uri), uri}) {
    if (lower_extension(name) != ".bin") continue;
    std::filesystem::path relative(name);
    // Behind a link, ".." is not where the words say.
    if (std::ranges::find(relative, "..") == relative.end()) relative = relative.lexically_normal();
    BufferFile buffer{mesh.parent_path() / relative, open_beneath(mesh.parent_path(), name)};
    if (buffer.file.number() >= 0) return buffer;
  }
  return std::nullopt;
}

bool is_read_by_assimp(const std::string& extension) {
  return extension.size() > 1 && !unread_format(extension) && Assimp::Importer().IsExtensionSupported(extension);
}

AssimpInput prepare_for_assimp(const std::filesystem::path& path, const std::string& extension) {
  AssimpInput input{path, extension, read_file_bytes(path), 0, {}, 0.0, {}};
  input.n_geometry_bytes = input.bytes.size();
  check_kind(input);
  if (extension == ".dae" ||
      (extension == ".xml" && input.bytes.view().substr(0, 4096).find("<COLLADA") != std::string_view::npos)) {
    look_into_collada(&input);
  } else if (extension == ".3mf") {
    look_into_3mf(&input);
  } else if (extension == ".gltf" || extension == ".glb") {
    look_into_gltf(&input);
  } else if (extension == ".amf") {
    look_into_amf(&input);
  } else if (extension == ".x3d") {
    look_into_x3d(&input);
  } else if (extension == ".nff" || extension == ".enff") {
    look_into_nff(&input);
  } else if (extension == ".ifc") {
    look_into_ifc(&input);
  }
  return input;
}

}  // namespace vex
