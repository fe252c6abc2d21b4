// The bodies that a command line names: mesh files and named shapes.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "meshes/convex_mesh.h"
#include "shapes/any_shape.h"

namespace vex {

struct LoadedBody {
  std::string source;  // as the user wrote it
  MeasuredBody shape;
  std::optional<MeshReport> mesh;  // of a mesh file
};

/// `text`: a named shape (`box:1,2,3`) or the path of a mesh. Throws UsageError or InputError.
LoadedBody load_body(const std::string& text, const MeshOptions& mesh_options);

/// The entry of `bodies` in every program's JSON.
nlohmann::ordered_json body_json(const LoadedBody& loaded);

/// The lines that describe the body on the screen; `label` is A or B.
std::string body_text(const LoadedBody& loaded, const std::string& label);

}  // namespace vex
