#include "apps/common/bodies.h"

#include <algorithm>
#include <filesystem>

#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

// `spher:1` and `Sphere:1` are mistyped bodies rather than missing files, and so is `sphere`.
bool looks_like_a_named_shape(const std::string& text) {
  std::error_code error;
  if (std::filesystem::exists(text, error)) return false;
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return names_a_shape(text + ":");
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return colon > 1 && std::ranges::all_of(text.substr(0, colon), is_letter);
}

// `sphere` alone: its sizes are missing.
[[noreturn]] void refuse_without_sizes(const std::string& name) {
  for (const NamedShape& shape : named_shapes()) {
    if (shape.name != name) continue;
    throw UsageError("a body without its sizes (" + name + ") - write " + name + ":" + std::string(shape.parameters) +
                     " (" + std::string(shape.meaning) + ")");
  }
  parse_shape(name + ":");
  throw UsageError("not a body (" + name + ") - name a mesh file or a body with its sizes");
}

// With two bodies on the command line it matters which one is refused.
ConvexMesh load_naming_the_file(const std::string& path, const MeshOptions& mesh_options) {
  try {
    return load_convex_mesh(path, mesh_options);
  } catch (const InputError& error) {
    const std::string problem = error.what();
    if (problem.find(path) != std::string::npos) throw;
    throw InputError(path + ": " + problem);
  }
}

nlohmann::ordered_json point_json(const Vec3d& p) { return {p.x, p.y, p.z}; }

nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
  if (!value) return nullptr;
  return *value;
}

}  // namespace

LoadedBody load_body(const std::string& text, const MeshOptions& mesh_options) {
  if (looks_like_a_named_shape(text) && text.find(':') == std::string::npos) refuse_without_sizes(text);
  if (names_a_shape(text) || looks_like_a_named_shape(text)) return {text, parse_shape(text), std::nullopt};
  ConvexMesh mesh = load_naming_the_file(text, mesh_options);
  LoadedBody loaded{text, {"polyhedron", ConvexBody(std::move(mesh.body)), mesh.measures}, std::move(mesh.report)};
  require_size_in_range(loaded.shape.body, loaded.shape.measures, text);
  return loaded;
}

nlohmann::ordered_json body_json(const LoadedBody& loaded) {
  const MeasuredBody& shape = loaded.shape;
  const std::optional<MeshReport>& mesh = loaded.mesh;
  nlohmann::ordered_json json;
  json["source"] = loaded.source;
  json["kind"] = shape.kind;
  json["vertices"] = nullptr;
  json["faces"] = nullptr;
  if (mesh) {
    json["vertices"] = mesh->n_vertices;
    json["faces"] = mesh->n_faces;
  }
  json["volume"] = shape.measures.volume;
  json["surface_area"] = shape.measures.surface_area;
  json["integrated_mean_curvature"] = shape.measures.integrated_mean_curvature;
  json["mean_radius"] = shape.measures.mean_radius();
  json["centre"] = point_json(shape.body.centre());
  json["circumradius"] = shape.body.circumradius();
  json["inradius"] = shape.body.inradius();
  json["convex"] = true;
  json["reflex_depth"] = number_or_null(mesh ? mesh->reflex_depth : 0.0);
  json["welded_vertices"] = mesh ? mesh->n_welded_vertices : 0;
  json["hull_added_volume"] = number_or_null(mesh ? mesh->hull_added_volume : 0.0);
  if (mesh) {
    json["triangles"] = mesh->n_triangles;
    json["parts"] = mesh->n_parts;
    json["hull_used"] = mesh->hull_used;
    json["coordinates"] = "32-bit floats of the file reader, promoted to double";
    json["notes"] = mesh->notes;
  }
  return json;
}

std::string body_text(const LoadedBody& loaded, const std::string& label) {
  const MeasuredBody& shape = loaded.shape;
  const Vec3d centre = shape.body.centre();
  std::string text = label + "  " + printable(loaded.source) + "  " + shape.kind;
  if (loaded.mesh) {
    text += ", " + std::to_string(loaded.mesh->n_vertices) + " vertices, " + std::to_string(loaded.mesh->n_faces) +
            " faces (its 32-bit coordinates, taken as exact)";
  }
  const auto line = [&](const std::string& name, double value, const std::string& remark = "") {
    text += "\n   " + name + std::string(34 - name.size(), ' ') + short_number(value, 12) + remark;
  };
  line("volume V", shape.measures.volume);
  line("surface area S", shape.measures.surface_area);
  line("integrated mean curvature M", shape.measures.integrated_mean_curvature,
       "   (mean radius M/4pi = " + short_number(shape.measures.mean_radius(), 12) + ")");
  line("circumradius", shape.body.circumradius(),
       "   about (" + short_number(centre.x, 6) + ", " + short_number(centre.y, 6) + ", " + short_number(centre.z, 6) +
           ")");
  line("inradius", shape.body.inradius());
  if (loaded.mesh) {
    for (const std::string& note : loaded.mesh->notes) text += "\n   note: " + printable(note);
  }
  return text + "\n";
}

}  // namespace vex
