#include "apps/common/body_report.h"

#include <nlohmann/json.hpp>

#include "apps/common/common_options.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"

namespace vex {
namespace {

nlohmann::ordered_json point_json(const Vec3d& p) { return {p.x, p.y, p.z}; }

// The unit that the body's numbers have. A scale may have been meant as a change of it.
std::string unit_of(const LoadedBody& loaded) {
  return loaded.mesh && loaded.scale == 1.0 ? loaded.mesh->unit : std::string();
}

// For JSON: what the numbers are that the body was made from.
std::string coordinates_text(const LoadedBody& loaded) {
  const MeshReport& mesh = *loaded.mesh;
  std::string text;
  switch (mesh.digits.kind) {
    case CoordinateDigits::Kind::doubles: text = "doubles of the file"; break;
    case CoordinateDigits::Kind::floats: text = "numbers of the file, as fine as 32-bit floats"; break;
    case CoordinateDigits::Kind::decimals:
      text = "decimals of the file, " + std::to_string(mesh.digits.n_digits) + " digits";
      break;
  }
  if (!mesh.unit.empty()) text += ", in " + mesh.unit;
  return text + (loaded.scale == 1.0 ? "" : ", scaled and rounded");
}

// For the screen: the same, shorter.
std::string coordinates_remark(const LoadedBody& loaded) {
  const MeshReport& mesh = *loaded.mesh;
  std::string text;
  switch (mesh.digits.kind) {
    case CoordinateDigits::Kind::doubles: text = "its coordinates, 64-bit"; break;
    case CoordinateDigits::Kind::floats: text = "its coordinates, 32-bit"; break;
    case CoordinateDigits::Kind::decimals:
      text = "its coordinates, printed to " + std::to_string(mesh.digits.n_digits) +
             (mesh.digits.n_digits == 1 ? " digit" : " digits");
      break;
  }
  if (!mesh.unit.empty()) text += ", in " + mesh.unit;
  return text + (loaded.scale == 1.0 ? "" : ", scaled") + ", taken as exact";
}

// What the rounding of the coordinates leaves open, where that is among the digits that are shown. Of a body rounded by
// a ball it is not known.
std::string volume_remark(const LoadedBody& loaded) {
  constexpr double kShown = 1e-12;
  if (!loaded.mesh || !(loaded.mesh->volume_rounding > kShown) || !loaded.is_polytope()) return "";
  return "   (to " + short_number(loaded.mesh->volume_rounding, 2) + ", by the rounding of its coordinates)";
}

}  // namespace

nlohmann::ordered_json body_json(const LoadedBody& loaded, bool with_vertices) {
  const Body& shape = loaded.shape;
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
  json["coordinate_rounding"] = nullptr;
  json["unit"] = nullptr;
  json["dropped_vertices"] = 0;
  if (mesh) {
    json["coordinate_rounding"] = number_or_null(mesh->coordinate_rounding);
    if (const std::string unit = unit_of(loaded); !unit.empty()) json["unit"] = unit;
    json["dropped_vertices"] = mesh->n_dropped_vertices;
    json["triangles"] = mesh->n_triangles;
    json["parts"] = mesh->n_parts;
    json["points"] = mesh->n_points;
    json["hull_used"] = mesh->hull_used;
    json["coordinates"] = coordinates_text(loaded);
    json["volume_rounding"] = number_or_null(mesh->volume_rounding);
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
  const Body& shape = loaded.shape;
  const std::optional<MeshReport>& mesh = loaded.mesh;
  const Vec3d centre = shape.body.centre();
  const std::vector<Vec3d> vertices = vertices_of(shape.body);
  std::string text =
      label + "  " + printable(loaded.source == "-" ? "standard input" : loaded.source) + "  " + shape.kind;
  if (!vertices.empty()) {
    text += ", " + std::to_string(vertices.size()) + " vertices";
    if (mesh && mesh->n_points > mesh->n_vertices) text += " of " + std::to_string(mesh->n_points) + " points";
    if (shape.n_faces > 0) text += ", " + std::to_string(shape.n_faces) + " faces";
  }
  if (mesh) text += " (" + coordinates_remark(loaded) + ")";
  const auto line = [&](const std::string& name, double value, const std::string& remark = "") {
    text += "\n   " + name + std::string(34 - name.size(), ' ') + short_number(value, 12) + remark;
  };
  if (loaded.scale != 1.0) line("scaled by", loaded.scale);
  line("volume V", shape.measures.volume, volume_remark(loaded));
  line("surface area S", shape.measures.surface_area,
       shape.measures.volume == 0.0 && shape.measures.surface_area > 0.0 ? "   (of both sides)" : "");
  line("integrated mean curvature M", shape.measures.integrated_mean_curvature,
       "   (mean radius M/4pi = " + short_number(shape.measures.mean_radius(), 12) + ")");
  line("circumradius", shape.body.circumradius(),
       "   about (" + short_number(centre.x, 6) + ", " + short_number(centre.y, 6) + ", " + short_number(centre.z, 6) +
           ")");
  line("inradius", shape.body.inradius());
  if (mesh && mesh->n_dropped_vertices > 0) {
    line("vertices dropped", static_cast<double>(mesh->n_dropped_vertices), "   (no corners of the body)");
  }
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
