#include "apps/common/bodies.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/common/common_options.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "engine/numeric/errors.h"
#include "shapes/rounded.h"

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

constexpr const char* kCoordinates = "32-bit floats of the file reader, promoted to double";

double scale_factor(const Measures& measures, const BodyOptions& options, const std::string& text) {
  if (!options.unit_volume) return options.scale;
  if (!std::isfinite(measures.volume)) {
    throw InputError("the volume overflows (" + text + ") - leave out --unit-volume");
  }
  if (measures.volume == 0.0) {
    throw InputError("a flat body has no volume to scale to 1 (" + text + ") - leave out --unit-volume");
  }
  return options.scale / std::cbrt(measures.volume);
}

}  // namespace

LoadedBody load_body(const std::string& text, const BodyOptions& options) {
  const std::optional<RoundedText> round = parse_rounded(text);
  const std::string core(round ? round->body : std::string_view(text));
  const double radius = round ? round->radius : 0.0;
  // From the measures of the core as it stands.
  const auto factor = [&](const Measures& measures) {
    return scale_factor(radius > 0.0 ? parallel_body_measures(measures, radius) : measures, options, text);
  };

  const SizeRange& range = options.with_measures ? kMeasuredSizes : kQueriedSizes;
  if (looks_like_a_named_shape(core) && core.find(':') == std::string::npos) refuse_without_sizes(core);
  if (names_a_shape(core) || looks_like_a_named_shape(core)) {
    const double scale = factor(parse_shape(core, 1.0, range).measures);
    return {text, parse_shape(text, scale, range), scale};
  }
  double scale = 1.0;
  MeshOptions mesh_options;
  mesh_options.convex_tolerance = options.convex_tolerance;
  mesh_options.hull = options.hull;
  if (options.unit_volume || options.scale != 1.0) {
    mesh_options.scale = [&](const Measures& measures) { return scale = factor(measures); };
  }
  ConvexMesh mesh = load_naming_the_file(core, mesh_options);
  LoadedBody loaded{text, {"polyhedron", ConvexBody(std::move(mesh.body)), mesh.measures}, scale, mesh.report};
  loaded.shape.normals = std::move(mesh.normals);
  loaded.shape.n_faces = options.hull ? mesh.report.n_triangles : mesh.report.n_faces;
  require_size_in_range(loaded.shape.body, loaded.shape.measures, text, range);
  if (round) loaded.shape = rounded(loaded.shape, radius * scale, text, range);
  return loaded;
}

std::string file_named_by(const std::string& text) {
  const std::optional<RoundedText> round = parse_rounded(text);
  return round ? std::string(round->body) : text;
}

nlohmann::ordered_json body_json(const LoadedBody& loaded, bool with_vertices) {
  const MeasuredBody& shape = loaded.shape;
  const std::optional<MeshReport>& mesh = loaded.mesh;
  const std::vector<Vec3d> vertices = vertices_of(shape.body);
  nlohmann::ordered_json json;
  json["source"] = loaded.source;
  json["kind"] = shape.kind;
  json["vertices"] = nullptr;
  json["faces"] = nullptr;
  if (!vertices.empty()) {
    json["vertices"] = vertices.size();
    json["faces"] = shape.n_faces;
  }
  json["volume"] = number_or_null(shape.measures.volume);
  json["surface_area"] = number_or_null(shape.measures.surface_area);
  json["integrated_mean_curvature"] = shape.measures.integrated_mean_curvature;
  json["mean_radius"] = shape.measures.mean_radius();
  json["centre"] = point_json(shape.body.centre());
  json["circumradius"] = shape.body.circumradius();
  json["inradius"] = shape.body.inradius();
  json["scale"] = loaded.scale;
  json["convex"] = true;
  json["reflex_depth"] = number_or_null(mesh ? mesh->reflex_depth : 0.0);
  json["welded_vertices"] = mesh ? mesh->n_welded_vertices : 0;
  json["hull_added_volume"] = number_or_null(mesh ? mesh->hull_added_volume : 0.0);
  if (mesh) {
    json["triangles"] = mesh->n_triangles;
    json["parts"] = mesh->n_parts;
    json["points"] = mesh->n_points;
    json["hull_used"] = mesh->hull_used;
    json["coordinates"] = kCoordinates + std::string(loaded.scale == 1.0 ? "" : ", scaled and rounded");
    json["notes"] = mesh->notes;
  }
  if (with_vertices) {
    json["vertex_coordinates"] = nlohmann::ordered_json::array();
    for (const Vec3d& v : vertices) {
      json["vertex_coordinates"].push_back({hex_number(v.x), hex_number(v.y), hex_number(v.z)});
    }
  }
  return json;
}

std::string body_text(const LoadedBody& loaded, const std::string& label, bool with_vertices) {
  const MeasuredBody& shape = loaded.shape;
  const std::optional<MeshReport>& mesh = loaded.mesh;
  const Vec3d centre = shape.body.centre();
  const std::vector<Vec3d> vertices = vertices_of(shape.body);
  std::string text = label + "  " + printable(loaded.source) + "  " + shape.kind;
  if (!vertices.empty()) {
    text += ", " + std::to_string(vertices.size()) + " vertices";
    if (mesh && mesh->n_points > mesh->n_vertices) text += " of " + std::to_string(mesh->n_points) + " points";
    if (shape.n_faces > 0) text += ", " + std::to_string(shape.n_faces) + " faces";
  }
  if (mesh)
    text += std::string(" (its 32-bit coordinates, ") + (loaded.scale == 1.0 ? "" : "scaled, ") + "taken as exact)";
  const auto line = [&](const std::string& name, double value, const std::string& remark = "") {
    text += "\n   " + name + std::string(34 - name.size(), ' ') + short_number(value, 12) + remark;
  };
  if (loaded.scale != 1.0) line("scaled by", loaded.scale);
  line("volume V", shape.measures.volume);
  line("surface area S", shape.measures.surface_area,
       shape.measures.volume == 0.0 && shape.measures.surface_area > 0.0 ? "   (of both sides)" : "");
  line("integrated mean curvature M", shape.measures.integrated_mean_curvature,
       "   (mean radius M/4pi = " + short_number(shape.measures.mean_radius(), 12) + ")");
  line("circumradius", shape.body.circumradius(),
       "   about (" + short_number(centre.x, 6) + ", " + short_number(centre.y, 6) + ", " + short_number(centre.z, 6) +
           ")");
  line("inradius", shape.body.inradius());
  if (mesh && mesh->hull_used && mesh->hull_added_volume) line("volume added by the hull", *mesh->hull_added_volume);
  if (mesh) {
    for (const std::string& note : mesh->notes) text += "\n   note: " + printable(note);
  }
  if (with_vertices && !vertices.empty()) {
    text += "\n   vertices, exactly: x y z";
    for (const Vec3d& v : vertices)
      text += "\n      " + hex_number(v.x) + " " + hex_number(v.y) + " " + hex_number(v.z);
  }
  return text + "\n";
}

}  // namespace vex
