// The bodies that a command line names: mesh files and named shapes, rounded and scaled as asked for.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "meshes/convex_mesh.h"
#include "shapes/any_shape.h"

namespace vex {

/// What the command line wants of every body.
struct BodyOptions {
  double convex_tolerance = 1e-6;  // of meshes, as in MeshOptions
  bool hull = false;               // of meshes: the convex hull of whatever the file holds
  bool unit_volume = false;        // scale to V = 1 about the origin ...
  double scale = 1.0;              // ... and then by this
  bool with_measures = true;  // V, S and M must be finite: sizes of named bodies are kMeasuredSizes, or kQueriedSizes
};

struct LoadedBody {
  std::string source;                // as the user wrote it
  MeasuredBody shape;                // rounded and scaled
  double scale = 1.0;                // what every length was multiplied by
  std::optional<MeshReport> mesh{};  // of a mesh file; what was rounded is its core

  /// Whether it is the convex hull of the vertices that `vertices_of` gives.
  bool is_polytope() const { return !vertices_of(shape.body).empty(); }
};

/// `text`: a named shape (`box:1,2,3`), the path of a mesh, or `rounded:r,` and one of these. Throws UsageError or
/// InputError.
LoadedBody load_body(const std::string& text, const BodyOptions& options);

/// The file that the text names, without `rounded:r,` before it; the text itself where it names none.
std::string file_named_by(const std::string& text);

/// The entry of `bodies` in every program's JSON; with the vertices in hexadecimal if asked for.
nlohmann::ordered_json body_json(const LoadedBody& loaded, bool with_vertices);

/// The lines that describe the body on the screen; `label` is A or B.
std::string body_text(const LoadedBody& loaded, const std::string& label, bool with_vertices);

}  // namespace vex
