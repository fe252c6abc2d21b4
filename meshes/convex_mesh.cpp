#include "meshes/convex_mesh.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "engine/numeric/errors.h"
#include "meshes/convexity.h"
#include "meshes/hull_check.h"
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

void check_options(const MeshOptions& options) {
  if (!(options.convex_tolerance >= 0.0) || !std::isfinite(options.convex_tolerance)) {
    throw UsageError("the convex tolerance is not a finite number from 0 up (" + number_text(options.convex_tolerance) +
                     ") - give a fraction of the body's size such as 1e-6");
  }
}

/// Measured: the checks take up to 230 bytes for a triangle whose corners are its own (STL), of which the soup is 52.
void check_memory(const PolygonSoup& soup) {
  const std::uint64_t needed = 80 * std::uint64_t{soup.corners.size()};
  const std::uint64_t available = machine_memory() / 4 * 3;
  if (needed > available) {
    throw InputError("the mesh is too large for this machine (" + std::to_string(soup.face_sizes.size()) +
                     " faces need about " + std::to_string(needed >> 20U) + " MiB of " +
                     std::to_string(available >> 20U) + ") - simplify it");
  }
}

void note_what_reading_did(const PolygonSoup& soup, const WeldedSurface& welded, MeshReport* report) {
  report->n_parts = soup.n_parts;
  report->n_vertices = welded.surface.vertices.size();
  report->n_faces = welded.surface.n_faces();
  report->n_welded_vertices = welded.n_welded_vertices;
  if (soup.n_ignored_faces > 0) {
    report->notes.push_back(std::to_string(soup.n_ignored_faces) + " points or lines of the file were ignored");
  }
  if (welded.n_collapsed_faces > 0) {
    report->notes.push_back(std::to_string(welded.n_collapsed_faces) +
                            " faces with fewer than three different corners were dropped");
  }
}

ConvexMesh measured(const PolygonSurface& surface, const Triangles& triangles, const VolumeAndCentroid& solid,
                    MeshReport report) {
  const Measures measures{solid.volume, surface_area(triangles), integrated_mean_curvature(triangles)};
  const double widest_inradius = inscribed_radius(triangles, solid.centroid);
  const Vec3d centre = rounded_centre(solid.centroid, widest_inradius, report.size);
  const double inradius = inscribed_radius(triangles, {centre, {}});
  return {Polytope(surface.vertices, centre, inradius), measures, std::move(report)};
}

}  // namespace

ConvexMesh convex_mesh_from(const PolygonSoup& soup, const MeshOptions& options) {
  check_options(options);
  check_memory(soup);
  WeldedSurface welded = weld(soup);
  PolygonSurface& surface = welded.surface;
  MeshReport report;
  note_what_reading_did(soup, welded, &report);

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
  report.n_triangles = triangles.size();

  const std::optional<HullInstead> hull = checked_convexity(triangles, solid, report.size, options.convex_tolerance);
  if (!hull) {
    return measured(surface, triangles, solid, std::move(report));
  }
  report.hull_used = true;
  report.reflex_depth = hull->reflex_depth / report.size;
  report.hull_added_volume = hull->solid.volume - solid.volume;
  report.n_triangles = hull->triangles.size();
  report.notes.push_back("the mesh is convex only within the tolerance (by " + number_text(report.reflex_depth) +
                         " of its size): its convex hull is used");
  return measured(surface, hull->triangles, hull->solid, std::move(report));
}

ConvexMesh load_convex_mesh(const std::filesystem::path& path, const MeshOptions& options) {
  check_options(options);
  return convex_mesh_from(options.isolated_reader ? read_polygon_soup_isolated(path) : read_polygon_soup(path),
                          options);
}

}  // namespace vex
