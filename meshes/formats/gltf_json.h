// What a glTF document says of itself before anybody reads its geometry.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vex {

struct GltfSummary {
  std::string version;                           // of the asset: "2.0"; empty where it has none
  std::vector<std::string> buffer_uris;          // as they stand, percent escapes and all; embedded data left out
  std::vector<std::string> required_extensions;  // "KHR_draco_mesh_compression"
  // Where a mesh's positions or indices are no 32-bit floats in threes, or no unsigned numbers, or not all within their
  // part of a buffer: of which accessor.
  std::optional<std::string> misread_accessor;
  std::string unread;  // what moves or repeats points and is not read: "skins", "morph targets", a list
                       // of another length than a transform has; empty without
};

/// Nothing where `json` is not JSON, is nested more than a thousand levels deep, has more parts of buffers than its
/// bytes can describe, or requires more than a thousand extensions.
std::optional<GltfSummary> gltf_summary(std::string_view json);

/// The document of a binary glTF (.glb) of version 2; nothing where it has none.
std::optional<std::string_view> glb_document(std::string_view bytes);
/// The version of a binary glTF; nothing where it is none.
std::optional<unsigned> glb_version(std::string_view bytes);

/// `uri` with its escapes like %20 resolved.
std::string percent_decoded(std::string_view uri);

}  // namespace vex
