#include "meshes/convex_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "meshes/closed_surface.h"
#include "meshes/coordinate_rounding.h"
#include "meshes/extreme_vertices.h"
#include "meshes/hull_added_volume.h"
#include "meshes/hull_check.h"
#include "meshes/hull_of_points.h"
#include "meshes/length_unit.h"
#include "meshes/machine_memory.h"
#include "meshes/mesh_body.h"
#include "meshes/polyhedron_measures.h"
#include "meshes/reader.h"
#include "meshes/report_text.h"
#include "meshes/scaled_body.h"
#include "meshes/surface.h"
#include "meshes/triangles.h"

namespace vex {
namespace {

constexpr double kLargestVolumeError = 1e-13;    // relative: what convex_mesh.h promises, with room for other roundings
constexpr double kLeastDefaultTolerance = 1e-6;  // of the size
constexpr double kMostDropped = 1e-5;            // of V/S: so no more of V is lost with the vertices that are dropped
constexpr double kWorthAWarning = 1e-6;          // of V
constexpr double kMostRounded = 0.5;             // of V: beyond, it says nothing

void check_options(const MeshOptions& options) {
  const auto check = [](const std::optional<double>& fraction, const char* what, const char* advice) {
    if (fraction && (!(*fraction >= 0.0) || !std::isfinite(*fraction))) {
      throw UsageError("the " + std::string(what) + " is not a finite number from 0 up (" + number_text(*fraction) +
                       ") - give a fraction of the body's size such as " + advice);
    }
  };
  check(options.convex_tolerance, "convex tolerance", "1e-6");
  check(options.weld, "weld distance", "1e-6");
}

/// Measured: the checks take up to 270 bytes for a triangle whose corners are its own (STL), of which the soup is 88; a
/// hull up to 190 for each of its points, of which the soup is 24.
void check_memory(const PolygonSoup& soup, bool hull) {
  const std::uint64_t needed =
      90 * std::uint64_t{soup.corners.size()} + (hull ? 190 * std::uint64_t{soup.points.size()} : 0);
  const std::uint64_t available = machine_memory() / 4 * 3;
  if (needed > available) {
    throw InputError("the mesh is too large for this machine (" + std::to_string(soup.points.size()) +
                     " vertices and " + std::to_string(soup.face_sizes.size()) + " faces need about " +
                     std::to_string(needed >> 20U) + " MiB of " + std::to_string(available >> 20U) + ") - simplify it");
  }
}

/// A coordinate too small for exact signs, beside others so large that a double of their size could not hold it: noise.
std::size_t take_noise_for_zero(PolygonSoup* soup) {
  constexpr double kNotNoise = kLeastFileCoordinate * 0x1p53;
  double largest = 0.0;
  for (const Vec3d& p : soup->points) {
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
  if (!(largest >= kNotNoise)) {
    return 0;
  }
  std::size_t n = 0;
  for (Vec3d& p : soup->points) {
    for (double* x : {&p.x, &p.y, &p.z}) {
      if (*x != 0.0 && std::fabs(*x) < kLeastFileCoordinate) {
        *x = 0.0;
        ++n;
      }
    }
  }
  return n;
}

/// A mesh on its way from the soup to the body.
struct Passage {
  const MeshOptions& options;
  CoordinateRounding rounding;  // in the unit that the coordinates are used in, but for its digits
  double stated_place = 0.0;    // the digits' last place, in that unit
  MeshReport report;
};

/// Noise is zero, and the unit is the one that was asked for.
Passage start(PolygonSoup* soup, const MeshOptions& options) {
  Passage passage{options, coordinate_rounding(*soup), 0.0, {}};
  CoordinateRounding& rounding = passage.rounding;
  double ratio = 1.0;
  if (!options.unit.empty()) {
    const std::optional<LengthUnit> unit = parse_length_unit(options.unit);
    if (!unit) {
      throw UsageError("no unit of length (\"" + options.unit + "\") - give m, cm, mm, um, nm, in or ft");
    }
    const double metres = soup->unit_metres;
    convert_unit(*soup, *unit);
    ratio = metres / unit->metres;
  }
  rounding.last_places = ratio * rounding.last_places;
  rounding.reach *= ratio;
  passage.stated_place = ratio * rounding.digits.last_place;
  passage.report.digits = rounding.digits;
  passage.report.unit = soup->unit;
  passage.report.n_parts = soup->n_parts;
  if (const std::size_t n = take_noise_for_zero(soup); n > 0) {
    passage.report.notes.push_back("coordinates below 1.4e-45 were taken for 0 (" + std::to_string(n) + " of them)");
  }
  return passage;
}

void note_what_reading_did(const PolygonSoup& soup, const ClosedSurface& closed, bool hull, MeshReport* report) {
  const WeldedSurface& welded = closed.welded;
  report->n_points = welded.surface.vertices.size();
  report->n_faces = welded.surface.n_faces();
  report->n_welded_vertices = welded.n_welded_vertices;
  report->weld_distance = welded.distance;
  report->reader_unconfined = soup.unconfined;
  if (soup.n_ignored_faces > 0) {
    report->notes.push_back(std::to_string(soup.n_ignored_faces) + " points or lines of the file " +
                            (hull ? "have no faces: their vertices count all the same" : "were ignored"));
  }
  if (welded.n_collapsed_faces > 0) {
    report->notes.push_back(std::to_string(welded.n_collapsed_faces) +
                            " faces with fewer than three different corners were dropped" +
                            (hull ? ", their vertices were not" : ""));
  }
  if (!closed.note.empty()) {
    report->notes.push_back(closed.note);
  }
}

/// The surface, kept for whoever asks where it faces.
struct KeptSurface {
  std::vector<Vec3d> vertices;
  Triangles triangles;
};

NormalMeasures normals_of(MeshBody body) {
  const auto kept = std::make_shared<KeptSurface>();
  kept->vertices = std::move(body.vertices);
  kept->triangles = std::move(body.triangles);
  kept->triangles.vertices = kept->vertices;
  return {[kept] { return area_measure(kept->triangles); }, [kept] { return mean_curvature_measure(kept->triangles); }};
}

/// `faces_are_triangles`: the file's own, whatever they are, are not the body's.
ConvexMesh finished(MeshBody body, MeshReport report, bool faces_are_triangles) {
  end_if_interrupted();
  report.n_vertices = body.vertices.size();
  report.n_dropped_vertices = report.n_points - report.n_vertices;
  report.n_triangles = body.triangles.size();
  report.size = bounding_diagonal(body.vertices);
  const double widest_inradius = inscribed_radius(body.triangles, body.solid.centroid);
  const Vec3d centre = rounded_centre(body.solid.centroid, widest_inradius, report.size);
  const double inradius = inscribed_radius(body.triangles, {centre, {}});
  const Measures measures = measures_of(body);
  Polytope polytope(body.vertices, centre, inradius);
  const std::size_t n_faces =
      faces_are_triangles || report.n_dropped_vertices > 0 ? report.n_triangles : report.n_faces;
  return {{"polyhedron", ConvexBody(std::move(polytope)), measures, n_faces, normals_of(std::move(body))},
          std::move(report)};
}

/// The convex body with as few vertices as its coordinates' rounding allows. The power of two: what rounding makes of
/// V/S when faces are cut another way must not choose the vertices.
MeshBody with_fewest_vertices(MeshBody body, Passage* passage) {
  end_if_interrupted();
  const double thickness = body.solid.volume / surface_area(body.triangles);
  const double most = std::ldexp(1.0, std::ilogb(kMostDropped * thickness));
  const std::size_t n_triangles = body.triangles.size();
  ExtremeVertices extreme =
      extreme_vertices({std::move(body.vertices), std::move(body.triangles)}, std::min(passage->rounding.reach, most),
                       passage->report.hull_used ? MadeFrom::vertices : MadeFrom::faces);
  const std::size_t n_vertices = extreme.hull.vertices.size();
  if (extreme.farthest_outside > 0.0) {
    passage->report.notes.push_back(
        std::to_string(passage->report.n_points - n_vertices) + " of its " + std::to_string(passage->report.n_points) +
        " vertices are no corners of the body to within the rounding of the coordinates, and were left out: none is "
        "farther than " +
        rough_text(extreme.farthest_outside) + " outside it");
  }
  MeshBody result{std::move(extreme.hull.vertices), std::move(extreme.hull.triangles), body.solid};
  if (result.triangles.size() != n_triangles) {
    result.solid = volume_and_centroid(result.triangles);
  }
  return result;
}

void note_rounding(const MeshBody& body, const Passage& passage, MeshReport* report) {
  report->coordinate_rounding = passage.stated_place / bounding_diagonal(body.vertices);
  report->volume_rounding = volume_rounding(body.triangles, body.solid.volume, passage.rounding.last_places);
  // Of numbers of three digits or fewer nobody knows that they were rounded.
  const bool is_stated = report->digits.kind != CoordinateDigits::Kind::decimals || report->digits.n_digits > 3;
  if (report->volume_rounding > kMostRounded && is_stated) {
    throw InputError("the coordinates are too coarse for the body (" + coordinates_text(report->digits) +
                     ", so that its volume may differ by " + rough_text(report->volume_rounding) +
                     " of itself) - write them with more digits, or move the body to the origin first");
  }
  if (report->volume_rounding > kWorthAWarning) {
    report->notes.push_back(coordinates_text(report->digits) + ": the volume of what was meant may differ by " +
                            rough_text(report->volume_rounding) + " of itself");
  }
}

/// The body, scaled if so asked. What the report has of lengths and volumes is of the file's surface.
ConvexMesh finished(MeshBody body, Passage passage) {
  body = with_fewest_vertices(std::move(body), &passage);
  MeshReport report = std::move(passage.report);
  note_rounding(body, passage, &report);
  if (!passage.options.scale) {
    return finished(std::move(body), std::move(report), passage.options.hull);
  }
  const double scale = passage.options.scale(measures_of(body));
  body = scaled_body(std::move(body), scale);
  report.weld_distance *= scale;
  if (report.hull_added_volume) {
    report.hull_added_volume = scale * scale * scale * *report.hull_added_volume;
  }
  ConvexMesh result = finished(std::move(body), std::move(report), passage.options.hull);
  check_scaled_measures(result.measures, scale);
  return result;
}

ConvexMesh hull_from(PolygonSoup soup, Passage passage) {
  MeshReport& report = passage.report;
  const ClosedSurface any = any_surface(soup, passage.options.weld);
  const PolygonSurface& surface = any.welded.surface;
  note_what_reading_did(soup, any, true, &report);
  soup = {};
  HullOfPoints hull = hull_of_points(surface.vertices);
  MeshBody body{std::move(hull.vertices), std::move(hull.triangles), {}};
  body.solid = volume_and_centroid(body.triangles);
  if (!(body.solid.volume_error <= kLargestVolumeError * body.solid.volume)) {
    throw InputError("the points are too near to one plane (their hull's volume is " + number_text(body.solid.volume) +
                     ", known to " + number_text(body.solid.volume_error) +
                     ") - for a flat body use plate:A,B or disc:R");
  }
  report.hull_used = true;
  AddedVolume added = volume_added_to(surface, body.solid);
  report.hull_added_volume = added.volume;
  std::ranges::move(added.notes, std::back_inserter(report.notes));
  if (report.hull_added_volume != 0.0) {
    report.reflex_depth = std::nullopt;
  }
  ConvexMesh mesh = finished(std::move(body), std::move(passage));
  std::vector<std::string>& notes = mesh.report.notes;
  notes.push_back("the convex hull was taken: " + std::to_string(mesh.report.n_vertices) + " of " +
                  std::to_string(mesh.report.n_points) + " points are its vertices");
  std::rotate(notes.begin(), notes.end() - 1, notes.end());
  return mesh;
}

/// How far from convex the mesh may be, and why.
ConvexTolerance tolerance_of(const Passage& passage, double size) {
  if (passage.options.convex_tolerance) {
    return {*passage.options.convex_tolerance, ""};
  }
  const double explained = passage.rounding.reach / size;
  if (!(explained > kLeastDefaultTolerance)) {
    return {kLeastDefaultTolerance, ""};
  }
  const std::string digits = digits_text(passage.report.digits);
  return explained <= kMostExplained
             ? ConvexTolerance{explained, "what rounding to " + digits + " explains"}
             : ConvexTolerance{kMostExplained, "for rounding to " + digits + " is too coarse to explain anything"};
}

void note_hull(const HullInstead& hull, const VolumeAndCentroid& mesh, double size, Passage* passage) {
  MeshReport& report = passage->report;
  report.hull_used = true;
  report.reflex_depth = hull.reflex_depth / size;
  report.hull_added_volume = added_volume(hull.solid, mesh);
  const bool by_digits = !passage->options.convex_tolerance && *report.reflex_depth > kLeastDefaultTolerance;
  const std::string within = by_digits ? "the mesh is convex to within its " + digits_text(report.digits) + " (by "
                                       : "the mesh is convex only within the tolerance (by ";
  report.notes.push_back(within + number_text(*report.reflex_depth) + " of its size): its convex hull is used");
}

ConvexMesh body_from(PolygonSoup soup, Passage passage) {
  MeshReport& report = passage.report;
  ClosedSurface closed = closed_surface(soup, passage.options.weld, passage.rounding.reach);
  note_what_reading_did(soup, closed, false, &report);
  soup = {};
  PolygonSurface& surface = closed.welded.surface;
  end_if_interrupted();
  Triangles triangles = fan_triangles(surface, closed.mates);
  const double size = bounding_diagonal(surface.vertices);
  VolumeAndCentroid solid = volume_and_centroid(triangles);
  if (!(std::fabs(solid.volume) > solid.volume_error)) {
    throw InputError("the mesh has no volume (" + number_text(solid.volume) + " at a size of " + number_text(size) +
                     ") - for a flat body use plate:A,B or disc:R");
  }
  if (solid.volume < 0.0) {
    surface.turn_inside_out();
    triangles = fan_triangles(surface, checked_half_edges(surface));
    solid = volume_and_centroid(triangles);
    report.notes.emplace_back("the mesh was inside out and has been turned");
  }
  closed.mates = {};
  end_if_interrupted();
  if (std::optional<HullInstead> hull = checked_convexity(triangles, solid, size, tolerance_of(passage, size))) {
    note_hull(*hull, solid, size, &passage);
    triangles = std::move(hull->triangles);
    solid = hull->solid;
  }
  std::vector<Vec3d> vertices = std::move(surface.vertices);
  closed = {};
  return finished({std::move(vertices), std::move(triangles), solid}, std::move(passage));
}

}  // namespace

ConvexMesh convex_mesh_from(PolygonSoup soup, const MeshOptions& options) {
  check_options(options);
  check_memory(soup, options.hull);
  Passage passage = start(&soup, options);
  return options.hull ? hull_from(std::move(soup), std::move(passage)) : body_from(std::move(soup), std::move(passage));
}

ConvexMesh hull_of(std::span<const Vec3d> points) {
  if (points.empty()) throw InputError("a hull of no points (0 were given) - give four or more, not all in one plane");
  PolygonSoup soup;
  soup.points.assign(points.begin(), points.end());
  return convex_mesh_from(std::move(soup), {.hull = true});
}

const Polytope& ConvexMesh::polytope() const { return *body.target<Polytope>(); }

ConvexMesh load(const std::filesystem::path& path, const MeshOptions& options) {
  check_options(options);
  return convex_mesh_from(
      read_polygon_soup(
          path, {.format = options.format,
                 .isolated = options.isolated_reader,
                 .confining = options.require_confinement ? Confining::required : Confining::as_far_as_possible}),
      options);
}

}  // namespace vex
