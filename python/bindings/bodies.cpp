#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "engine/query/separation.h"
#include "engine/support/validate.h"
#include "meshes/body_mesh.h"
#include "meshes/hull_of_points.h"
#include "meshes/polyhedron_measures.h"
#include "meshes/reader.h"
#include "python/bindings/body.h"
#include "shapes/any_shape.h"
#include "shapes/polytope.h"
#include "shapes/rounded.h"
#include "shapes/scaled.h"

namespace vex::python {
namespace {

using Indices = py::array_t<std::uint32_t, py::array::c_style>;

Floats array_of(std::span<const Vec3d> points) {
  Floats array({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
  double* to = array.mutable_data();
  for (const Vec3d& p : points) {
    put(to, p);
    to += 3;
  }
  return array;
}

std::vector<Vec3d> points_of(const Floats& array) {
  const Rows3 rows(array);
  std::vector<Vec3d> points(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) points[k] = rows[k];
  return points;
}

PolygonSoup soup_of(const Floats& points, const Indices& corners, const Indices& face_sizes) {
  PolygonSoup soup;
  soup.points = points_of(points);
  soup.corners.assign(corners.data(), corners.data() + corners.size());
  soup.face_sizes.assign(face_sizes.data(), face_sizes.data() + face_sizes.size());
  std::uint64_t n_corners = 0;
  for (const std::uint32_t n : soup.face_sizes) {
    if (n < 3) throw InputError("a face of fewer than three corners - leave it out");
    n_corners += n;
  }
  if (n_corners != soup.corners.size()) throw UsageError("sizes of faces that do not add up to the corners");
  for (const std::uint32_t corner : soup.corners) {
    if (corner >= soup.points.size()) {
      throw InputError("a face names a vertex that is not there (" + std::to_string(corner) + " of " +
                       std::to_string(soup.points.size()) + ") - count vertices from 0 on");
    }
  }
  soup.n_parts = 1;
  return soup;
}

/// All that a file said, so that a body can be made from it again.
py::tuple state_of(const PolygonSoup& soup) {
  return py::make_tuple(array_of(soup.points),
                        Indices(static_cast<py::ssize_t>(soup.corners.size()), soup.corners.data()),
                        Indices(static_cast<py::ssize_t>(soup.face_sizes.size()), soup.face_sizes.data()), soup.n_parts,
                        soup.n_ignored_faces, static_cast<int>(soup.digits.kind), soup.digits.n_digits,
                        soup.digits.last_place, soup.unit, soup.unit_metres);
}
PolygonSoup soup_from(const py::tuple& state) {
  if (state.size() != 10) throw UsageError("no state of a surface");
  PolygonSoup soup = soup_of(state[0].cast<Floats>(), state[1].cast<Indices>(), state[2].cast<Indices>());
  soup.n_parts = state[3].cast<std::size_t>();
  soup.n_ignored_faces = state[4].cast<std::size_t>();
  const int kind = state[5].cast<int>();
  if (kind < 0 || kind > static_cast<int>(CoordinateDigits::Kind::decimals)) throw UsageError("no kind of digits");
  soup.digits = {static_cast<CoordinateDigits::Kind>(kind), state[6].cast<int>(), state[7].cast<double>()};
  soup.unit = state[8].cast<std::string>();
  soup.unit_metres = state[9].cast<double>();
  return soup;
}

double scale_factor(double scale, bool unit_volume, const Measures& measures) {
  if (!(scale > 0.0) || !std::isfinite(scale))
    throw UsageError("a scale is a finite number above 0 - `mirrored`, and three factors of `scaled`, mirror");
  if (!unit_volume) return scale;
  if (!(measures.volume > 0.0) || !std::isfinite(measures.volume)) {
    throw InputError("a body without a volume cannot be scaled to volume 1 - leave out unit_volume");
  }
  return scale / std::cbrt(measures.volume);
}

/// What make() gives, as Python holds it.
template <class Make>
PyBody body_of_mesh(const char* what, const Make& make) {
  return interruptibly([&]() -> PyBody {
    ConvexMesh mesh = make();
    require_size_in_range(mesh.body, mesh.measures, what);
    MeshReport report = std::move(mesh.report);
    return {std::move(mesh), std::move(report)};
  });
}

PyBody mesh_body(const PolygonSoup& soup, bool hull, std::optional<double> convex_tolerance, std::optional<double> weld,
                 const std::string& unit, double scale, bool unit_volume) {
  MeshOptions options;
  options.hull = hull;
  options.convex_tolerance = convex_tolerance;
  options.weld = weld;
  options.unit = unit;
  scale_factor(scale, false, {});
  if (scale != 1.0 || unit_volume) {
    options.scale = [&](const Measures& measures) { return scale_factor(scale, unit_volume, measures); };
  }
  return body_of_mesh("the mesh", [&] { return convex_mesh_from(soup, options); });
}

PyBody hull_body(const Floats& array) {
  const std::vector<Vec3d> points = points_of(array);
  return body_of_mesh("the hull", [&] { return hull_of(points); });
}

PyBody scaled_body(const PyBody& body, const std::array<double, 3>& factors) {
  return {scaled(body.body, Vec3d{factors[0], factors[1], factors[2]})};
}

PyBody mapped_body(const PyBody& body, const Floats& matrix) {
  const Rows3 rows(matrix);
  if (rows.size() != 3) throw UsageError("not a matrix - give one of shape (3, 3)");
  return {mapped(body.body, {rows[0], rows[1], rows[2]})};
}

PyBody named_body(const std::string& text, double scale, bool unit_volume) {
  scale_factor(scale, false, {});
  if (!unit_volume) return {parse_shape(text, scale)};
  return {parse_shape(text, scale_factor(scale, true, parse_shape(text).measures))};
}

py::dict dict_of(const MeshReport& report) {
  py::dict dict;
  dict["n_vertices"] = report.n_vertices;
  dict["n_points"] = report.n_points;
  dict["n_dropped_vertices"] = report.n_dropped_vertices;
  dict["n_faces"] = report.n_faces;
  dict["n_triangles"] = report.n_triangles;
  dict["n_parts"] = report.n_parts;
  dict["n_welded_vertices"] = report.n_welded_vertices;
  dict["weld_distance"] = report.weld_distance;
  dict["size"] = report.size;
  dict["hull_used"] = report.hull_used;
  dict["unit"] = report.unit;
  dict["coordinate_rounding"] = report.coordinate_rounding;
  dict["volume_rounding"] = report.volume_rounding;
  dict["reflex_depth"] = report.reflex_depth;
  dict["hull_added_volume"] = report.hull_added_volume;
  dict["reader_unconfined"] = report.reader_unconfined;
  dict["notes"] = report.notes;
  return dict;
}

Floats support(const PyBody& body, const Floats& directions) {
  const Rows3 dirs(directions);
  for (std::size_t k = 0; k < dirs.size(); ++k) {
    if (!is_finite(dirs[k]) || norm_1(dirs[k]) == 0.0) {
      throw InputError("direction " + std::to_string(k) + " is 0 or not finite - any other length will do");
    }
  }
  Floats points({static_cast<py::ssize_t>(dirs.size()), py::ssize_t{3}});
  double* const to = points.mutable_data();
  const ConvexBody& convex = body.body;
  over_each_row(dirs.size(), 1, [&](std::size_t k) { put(to + 3 * k, convex.support(dirs[k])); });
  return points;
}

/// The exact form in arrays: points, pieces (centre, semi-axes, whether a dome), the ball's radius.
py::object exact_form(const PyBody& body) {
  const std::optional<ExactForm> form = body.body.body.exact_form();
  if (!form) return py::none();
  py::list pieces;
  for (const ExactForm::Piece& piece : form->pieces) {
    const Vec3d &c = piece.centre, &s = piece.semi_axes;
    pieces.append(py::make_tuple(py::make_tuple(c.x, c.y, c.z), py::make_tuple(s.x, s.y, s.z), piece.is_dome));
  }
  return py::make_tuple(array_of(form->points), pieces, form->ball_radius);
}

std::vector<std::string> violations(const PyBody& body, std::size_t n_directions, std::uint64_t seed) {
  return interruptibly([&] {
    std::vector<std::string> texts;
    for (const Violation& violation : validate(body.body.body, {n_directions, seed})) texts.push_back(violation.text);
    return texts;
  });
}

/// Triangles (N, 3) of the hull: indices of these points.
Indices hull_triangles(const Floats& array) {
  const std::vector<Vec3d> points = points_of(array);
  const HullOfPoints hull = interruptibly([&] { return hull_of_points(points); });
  // The hull's vertices are points in their order, some of them left out.
  std::vector<std::uint32_t> index;
  for (std::uint32_t k = 0; k < points.size() && index.size() < hull.vertices.size(); ++k) {
    const Vec3d &p = points[k], &vertex = hull.vertices[index.size()];
    if (p.x == vertex.x && p.y == vertex.y && p.z == vertex.z) index.push_back(k);
  }
  Indices triangles({static_cast<py::ssize_t>(hull.triangles.size()), py::ssize_t{3}});
  std::uint32_t* to = triangles.mutable_data();
  for (const auto& corners : hull.triangles.corners) {
    for (const std::uint32_t corner : corners) *to++ = index[corner];
  }
  return triangles;
}

/// Volume, centroid (3,) and second moments (3, 3) about it, of unit density; none where they are not known.
py::object moments_of(const PyBody& body) {
  std::optional<SolidMoments> moments = body.body.moments;
  const std::vector<Vec3d> vertices = vertices_of(body.body.body);
  if (!vertices.empty() && body.body.measures.volume > 0.0) {
    moments = interruptibly([&] { return solid_moments(hull_of_points(vertices).triangles); });
  }
  if (!moments) return py::none();
  return py::make_tuple(moments->volume, array_of(std::span(&moments->centroid, 1)), array_of(moments->second));
}

/// For pictures: points (N, 3), and whether they are the ends of a line.
py::tuple picture_points(const PyBody& body, int n_around) {
  BodyMesh mesh = mesh_of(body.body.body, n_around);
  for (Vec3d& point : mesh.points) point = point + mesh.origin;
  return py::make_tuple(array_of(mesh.points), mesh.is_line);
}

std::array<double, 3> triple(const Vec3d& v) { return {v.x, v.y, v.z}; }

}  // namespace

void bind_bodies(py::module_& module) {
  py::class_<PolygonSoup>(module, "Surface", "Points and faces, as a file or arrays have them.")
      .def(py::init(&soup_of), py::arg("points"), py::arg("corners"), py::arg("face_sizes"))
      .def_property_readonly("unit", [](const PolygonSoup& soup) { return soup.unit; })
      .def_property_readonly("unconfined", [](const PolygonSoup& soup) { return soup.unconfined; })
      .def(py::pickle(&state_of, &soup_from));
  module.def(
      "read_surface",
      [](const std::string& path, const std::string& format, bool require_confinement) {
        return interruptibly([&] {
          return read_polygon_soup(
              path, {.format = format,
                     .confining = require_confinement ? Confining::required : Confining::as_far_as_possible});
        });
      },
      py::arg("path"), py::arg("format"), py::arg("require_confinement"));

  py::class_<PyBody>(module, "Body", "A convex body; made by the functions beside it.")
      .def_property_readonly("kind", [](const PyBody& b) { return b.body.kind; })
      .def_property_readonly("volume", [](const PyBody& b) { return b.body.measures.volume; })
      .def_property_readonly("surface_area", [](const PyBody& b) { return b.body.measures.surface_area; })
      .def_property_readonly("integrated_mean_curvature",
                             [](const PyBody& b) { return b.body.measures.integrated_mean_curvature; })
      .def_property_readonly("centre", [](const PyBody& b) { return triple(b.body.body.centre()); })
      .def_property_readonly("circumradius", [](const PyBody& b) { return b.body.body.circumradius(); })
      .def_property_readonly("inradius", [](const PyBody& b) { return b.body.body.inradius(); })
      .def_property_readonly("reach", [](const PyBody& b) { return b.body.body.reach(); })
      .def_property_readonly("ball_radius", [](const PyBody& b) { return b.body.body.ball_radius(); })
      .def_property_readonly("support_error", [](const PyBody& b) { return b.body.body.support_error(); })
      .def_property_readonly("vertices", [](const PyBody& b) { return array_of(vertices_of(b.body.body)); })
      .def_property_readonly("n_faces", [](const PyBody& b) { return b.body.n_faces; })
      .def_property_readonly("report",
                             [](const PyBody& b) -> py::object {
                               if (!b.report) return py::none();
                               return dict_of(*b.report);
                             })
      .def("exact_form", &exact_form)
      .def("support", &support, py::arg("directions"))
      .def("violations", &violations, py::arg("n_directions"), py::arg("seed"));

  module.def("hull_triangles", &hull_triangles, py::arg("points"));
  module.def("moments", &moments_of, py::arg("body"));
  module.def("picture_points", &picture_points, py::arg("body"), py::arg("n_around"));
  module.def("named_body", &named_body, py::arg("text"), py::arg("scale"), py::arg("unit_volume"));
  module.def(
      "names_a_shape", [](const std::string& text) { return names_a_shape(text); }, py::arg("text"));
  module.def(
      "names_a_mesh_format", [](const std::string& path) { return names_a_mesh_format(path); }, py::arg("path"));
  module.def(
      "parse_rounded",
      [](const std::string& text) -> py::object {
        const std::optional<RoundedText> round = parse_rounded(text);
        if (!round) return py::none();
        return py::make_tuple(round->radius, std::string(round->body));
      },
      py::arg("text"));
  module.def("named_shapes", [] {
    std::vector<std::tuple<std::string, std::string, std::string>> lines;
    for (const NamedShape& shape : named_shapes()) {
      lines.emplace_back(shape.name, shape.parameters, shape.meaning);
    }
    return lines;
  });
  module.def("mesh_body", &mesh_body, py::arg("surface"), py::arg("hull"), py::arg("convex_tolerance"), py::arg("weld"),
             py::arg("unit"), py::arg("scale"), py::arg("unit_volume"));
  module.def("hull_body", &hull_body, py::arg("points"));
  module.def(
      "rounded_body",
      [](const PyBody& body, double radius, const std::string& source) {
        if (!body.body.measures.are_known()) return PyBody{Body(with_margin(body.body.body, radius))};
        return PyBody{rounded(body.body, radius, source), body.report};
      },
      py::arg("body"), py::arg("radius"), py::arg("source"));
  module.def("scaled_body", &scaled_body, py::arg("body"), py::arg("factors"));
  module.def("mapped_body", &mapped_body, py::arg("body"), py::arg("matrix"));
  module.def(
      "callable_body",
      [](py::function support, double support_error, const std::array<double, 3>& centre, double circumradius,
         double inradius) {
        return PyBody{Body(callable_body(std::move(support), support_error, {centre[0], centre[1], centre[2]},
                                         circumradius, inradius))};
      },
      py::arg("support"), py::arg("support_error"), py::arg("centre"), py::arg("circumradius"), py::arg("inradius"));
}

}  // namespace vex::python
