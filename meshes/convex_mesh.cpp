#include "meshes/convex_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "meshes/convexity.h"
#include "meshes/exact_hull.h"
#include "meshes/hull_check.h"
#include "meshes/hull_of_points.h"
#include "meshes/isolated_reader.h"
#include "meshes/machine_memory.h"
#include "meshes/polyhedron_measures.h"
#include "meshes/reader.h"
#include "meshes/report_text.h"
#include "meshes/surface.h"
#include "meshes/triangles.h"
#include "meshes/weld.h"

namespace vex {
namespace {

// What exact_sign.h asks of coordinates. Floats are far inside.
constexpr double kLargestCoordinate = 0x1p300;
constexpr double kSmallestCoordinate = 0x1p-300;

constexpr double kLargestVolumeError = 1e-13;  // relative: what convex_mesh.h promises, with room for other roundings

void check_options(const MeshOptions& options) {
  if (!(options.convex_tolerance >= 0.0) || !std::isfinite(options.convex_tolerance)) {
    throw UsageError("the convex tolerance is not a finite number from 0 up (" + number_text(options.convex_tolerance) +
                     ") - give a fraction of the body's size such as 1e-6");
  }
}

/// Measured: the checks take up to 230 bytes for a triangle whose corners are its own (STL), of which the soup is 52; a
/// hull up to 180 for each of its points, of which the soup is 12.
void check_memory(const PolygonSoup& soup, bool hull) {
  const std::uint64_t needed =
      80 * std::uint64_t{soup.corners.size()} + (hull ? 180 * std::uint64_t{soup.points.size()} : 0);
  const std::uint64_t available = machine_memory() / 4 * 3;
  if (needed > available) {
    throw InputError("the mesh is too large for this machine (" + std::to_string(soup.points.size()) +
                     " vertices and " + std::to_string(soup.face_sizes.size()) + " faces need about " +
                     std::to_string(needed >> 20U) + " MiB of " + std::to_string(available >> 20U) + ") - simplify it");
  }
}

void note_what_reading_did(const PolygonSoup& soup, const WeldedSurface& welded, bool hull, MeshReport* report) {
  report->n_parts = soup.n_parts;
  report->n_vertices = welded.surface.vertices.size();
  report->n_points = report->n_vertices;
  report->n_faces = welded.surface.n_faces();
  report->n_welded_vertices = welded.n_welded_vertices;
  if (soup.n_ignored_faces > 0) {
    report->notes.push_back(std::to_string(soup.n_ignored_faces) + " points or lines of the file " +
                            (hull ? "have no faces: their vertices count all the same" : "were ignored"));
  }
  if (welded.n_collapsed_faces > 0) {
    report->notes.push_back(std::to_string(welded.n_collapsed_faces) +
                            " faces with fewer than three different corners were dropped" +
                            (hull ? ", their vertices were not" : ""));
  }
}

/// A body on its way: `triangles` are convex, over some or all of `vertices`, and enclose `solid`.
struct Body {
  std::vector<Vec3d> vertices;
  Triangles triangles;
  VolumeAndCentroid solid;
  bool own_vertices_only = false;
};

Measures measures_of(const Body& body) {
  return {body.solid.volume, surface_area(body.triangles), integrated_mean_curvature(body.triangles)};
}

/// The surface, kept for whoever asks where it faces.
struct KeptSurface {
  std::vector<Vec3d> vertices;
  Triangles triangles;
};

NormalMeasures normals_of(Body body) {
  const auto kept = std::make_shared<KeptSurface>();
  kept->vertices = std::move(body.vertices);
  kept->triangles = std::move(body.triangles);
  kept->triangles.vertices = kept->vertices;
  return {[kept] { return area_measure(kept->triangles); }, [kept] { return mean_curvature_measure(kept->triangles); }};
}

ConvexMesh finished(Body body, MeshReport report) {
  report.n_vertices = body.vertices.size();
  report.n_triangles = body.triangles.size();
  report.size = bounding_diagonal(body.vertices);
  const double widest_inradius = inscribed_radius(body.triangles, body.solid.centroid);
  const Vec3d centre = rounded_centre(body.solid.centroid, widest_inradius, report.size);
  const double inradius = inscribed_radius(body.triangles, {centre, {}});
  ConvexMesh mesh{Polytope(body.vertices, centre, inradius), measures_of(body), std::move(report)};
  mesh.normals = normals_of(std::move(body));
  return mesh;
}

/// What the hull adds to surfaces that enclose `mesh`: 0 where no rounding tells them apart.
double added_volume(const VolumeAndCentroid& hull, const VolumeAndCentroid& mesh) {
  const DoubleDouble six_mesh = mesh.volume < 0.0 ? -mesh.six_volumes : mesh.six_volumes;
  const double added = (hull.six_volumes - six_mesh).value() / 6.0;
  return std::fabs(added) > hull.volume_error + mesh.volume_error ? added : 0.0;
}

[[noreturn]] void refuse_scaled(const std::string& what, double scale) {
  throw InputError("the scaled body is " + what + " (its scale is " + number_text(scale) + ") - choose another scale");
}

void check_scaled(const std::vector<Vec3d>& vertices, double scale) {
  for (const Vec3d& v : vertices) {
    for (const double x : {v.x, v.y, v.z}) {
      if (!(std::fabs(x) <= kLargestCoordinate)) {
        refuse_scaled("too large", scale);
      }
      if (x != 0.0 && std::fabs(x) < kSmallestCoordinate) {
        refuse_scaled("too small", scale);
      }
    }
  }
}

void check_scaled(const Measures& measures, double scale) {
  for (const double value : {measures.volume, measures.surface_area, measures.integrated_mean_curvature}) {
    if (!std::isfinite(value)) {
      refuse_scaled("too large", scale);
    }
    if (!(value >= std::numeric_limits<double>::min())) {
      refuse_scaled("too small", scale);
    }
  }
}

/// The vertices times `scale`; where these, rounded, are not convex by the same triangles, their hull's.
Body scaled(Body body, double scale) {
  for (Vec3d& v : body.vertices) {
    v = scale * v;
  }
  check_scaled(body.vertices, scale);
  body.solid = volume_and_centroid(body.triangles);
  const ConvexityCensus census = convexity_census(body.triangles, body.solid.centroid);
  if (census.locally_convex() && census.winding_number == 1) {
    return body;
  }
  if (body.own_vertices_only) {
    HullOfPoints hull = hull_of_points(body.vertices);
    body.vertices = std::move(hull.vertices);
    body.triangles = std::move(hull.triangles);
  } else if (std::optional<Triangles> hull = exact_hull(body.vertices)) {
    body.triangles = std::move(*hull);
  } else {
    refuse_scaled("too thin for its coordinates", scale);
  }
  body.solid = volume_and_centroid(body.triangles);
  return body;
}

/// The body, scaled if so asked. `mesh`: the surface whose volume the hull's is compared with, if it is.
ConvexMesh finished(Body body, const MeshOptions& options, Triangles mesh, std::vector<Vec3d> mesh_vertices,
                    MeshReport report) {
  if (!options.scale) {
    return finished(std::move(body), std::move(report));
  }
  const double scale = options.scale(measures_of(body));
  if (!(scale > 0.0) || !std::isfinite(scale)) {
    refuse_scaled(scale > 0.0 ? "too large" : (scale == 0.0 ? "too small" : "none, for the scale is not positive"),
                  scale);
  }
  body = scaled(std::move(body), scale);
  if (report.hull_added_volume && *report.hull_added_volume != 0.0) {
    for (Vec3d& v : mesh_vertices) {
      v = scale * v;
    }
    check_scaled(mesh_vertices, scale);
    mesh.vertices = mesh_vertices;
    report.hull_added_volume = added_volume(body.solid, volume_and_centroid(mesh));
  }
  ConvexMesh result = finished(std::move(body), std::move(report));
  check_scaled(result.measures, scale);
  return result;
}

/// The volume that each part of a closed surface encloses, negative where it is inside out; by the part's first vertex.
/// Rounded: for comparing parts with each other.
std::map<std::uint32_t, double> volume_of_each_part(const PolygonSurface& surface, const Triangles& triangles) {
  const std::vector<std::uint32_t> component = component_of_each_vertex(surface);
  std::map<std::uint32_t, double> volumes;
  for (const auto& [a, b, c] : triangles.corners) {
    const Vec3d base = surface.vertices[component[a]];
    volumes[component[a]] +=
        dot(surface.vertices[a] - base, cross(surface.vertices[b] - base, surface.vertices[c] - base)) / 6.0;
  }
  return volumes;
}

/// What the file's faces enclose, if that is defined.
void compare_volumes(const PolygonSurface& surface, const Body& body, Triangles* mesh, MeshReport* report) {
  const auto not_defined = [report](const std::string& why) {
    report->hull_added_volume = std::nullopt;
    report->notes.push_back("how much volume the hull added is not defined: " + why);
  };
  HalfEdgePairs pairs = half_edge_pairs(surface);
  if (!pairs.problem.empty()) {
    not_defined(pairs.problem);
    return;
  }
  *mesh = fan_triangles(surface, pairs.mates);
  const std::map<std::uint32_t, double> parts = volume_of_each_part(surface, *mesh);
  const std::string n_surfaces = std::to_string(parts.size()) + " surfaces share no vertex";
  const auto [least, most] = std::ranges::minmax(parts | std::views::values);
  if (least < 0.0 && most > 0.0) {
    not_defined("the file's " + n_surfaces + ", and some of them are inside out, as parts or as cavities");
    return;
  }
  report->hull_added_volume = added_volume(body.solid, volume_and_centroid(*mesh));
  if (*report->hull_added_volume < 0.0) {
    not_defined("the file's surfaces overlap or wind several times: together they enclose more than the hull");
  } else if (parts.size() > 1) {
    report->notes.push_back("the file's " + n_surfaces + ": the volumes that they enclose were added as they stand, " +
                            "as if none overlapped, to say how much the hull added");
  }
}

ConvexMesh hull_from(const PolygonSoup& soup, const MeshOptions& options) {
  WeldedSurface welded = weld(soup, UnusedPoints::kept);
  PolygonSurface& surface = welded.surface;
  MeshReport report;
  note_what_reading_did(soup, welded, options.hull, &report);
  HullOfPoints hull = hull_of_points(surface.vertices);
  Body body{std::move(hull.vertices), std::move(hull.triangles), {}, true};
  body.solid = volume_and_centroid(body.triangles);
  if (!(body.solid.volume_error <= kLargestVolumeError * body.solid.volume)) {
    throw InputError("the points are too near to one plane (their hull's volume is " + number_text(body.solid.volume) +
                     ", known to " + number_text(body.solid.volume_error) +
                     ") - for a flat body use plate:A,B or disc:R");
  }
  report.hull_used = true;
  report.notes.push_back("the convex hull was taken: " + std::to_string(body.vertices.size()) + " of " +
                         std::to_string(report.n_points) + " points are its vertices");
  Triangles mesh;
  compare_volumes(surface, body, &mesh, &report);
  if (report.hull_added_volume != 0.0) {
    report.reflex_depth = std::nullopt;
  }
  return finished(std::move(body), options, std::move(mesh), std::move(surface.vertices), std::move(report));
}

}  // namespace

ConvexMesh convex_mesh_from(const PolygonSoup& soup, const MeshOptions& options) {
  check_options(options);
  check_memory(soup, options.hull);
  if (options.hull) {
    return hull_from(soup, options);
  }
  WeldedSurface welded = weld(soup);
  PolygonSurface& surface = welded.surface;
  MeshReport report;
  note_what_reading_did(soup, welded, options.hull, &report);

  std::vector<std::uint32_t> mates = checked_half_edges(surface);
  Triangles triangles = fan_triangles(surface, mates);
  report.size = bounding_diagonal(surface.vertices);
  VolumeAndCentroid solid = volume_and_centroid(triangles);
  if (!(std::fabs(solid.volume) > solid.volume_error)) {
    throw InputError("the mesh has no volume (" + number_text(solid.volume) + " at a size of " +
                     number_text(report.size) + ") - for a flat body use plate:A,B or disc:R");
  }
  if (solid.volume < 0.0) {
    surface.turn_inside_out();
    mates = checked_half_edges(surface);
    triangles = fan_triangles(surface, mates);
    solid = volume_and_centroid(triangles);
    report.notes.emplace_back("the mesh was inside out and has been turned");
  }
  mates = {};

  std::optional<HullInstead> hull = checked_convexity(triangles, solid, report.size, options.convex_tolerance);
  if (!hull) {
    return finished({std::move(surface.vertices), std::move(triangles), solid}, options, {}, {}, std::move(report));
  }
  report.hull_used = true;
  report.reflex_depth = hull->reflex_depth / report.size;
  report.hull_added_volume = added_volume(hull->solid, solid);
  report.notes.push_back("the mesh is convex only within the tolerance (by " + number_text(*report.reflex_depth) +
                         " of its size): its convex hull is used");
  std::vector<Vec3d> mesh_vertices = options.scale ? surface.vertices : std::vector<Vec3d>{};
  return finished({std::move(surface.vertices), std::move(hull->triangles), hull->solid}, options, std::move(triangles),
                  std::move(mesh_vertices), std::move(report));
}

ConvexMesh load_convex_mesh(const std::filesystem::path& path, const MeshOptions& options) {
  check_options(options);
  return convex_mesh_from(options.isolated_reader ? read_polygon_soup_isolated(path) : read_polygon_soup(path),
                          options);
}

}  // namespace vex
