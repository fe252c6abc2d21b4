// File -> checked convex body; or, where the hull is asked for, the convex hull of whatever points the file holds.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "meshes/polygon_soup.h"
#include "shapes/body.h"
#include "shapes/polytope.h"

namespace vex {

struct MeshOptions {
  /// A fraction of the size: how deep a reflex edge or a vertex below the hull may be. Where it is not given: 1e-6, or
  /// what the rounding of the coordinates explains where that is more, but 1e-3 at most.
  std::optional<double> convex_tolerance = {};

  /// A fraction of the size: points that are not farther apart become one vertex. Where it is not given: equal points
  /// do, and where the surface is not closed then, those that the rounding of the coordinates explains, if that closes
  /// it. 0: equal points and no others.
  std::optional<double> weld = {};

  std::string unit = {};        // of length, to convert the file's coordinates to: "mm"; empty: they stay as they are
  std::string format = {};      // an extension such as ".obj": what to read the file as, whatever its name
  bool isolated_reader = true;  // read the file in a process of its own, so that a broken one cannot crash this one
  bool require_confinement = false;  // refuse a file whose reader cannot be confined there (docs/security.md)

  /// Take the convex hull of all points that the reader delivers, those that no face uses included, and ask nothing of
  /// the surface: it may be open, turned about, in several parts, without volume, or not there at all. What is asked:
  /// finite coordinates, and points that do not all lie in one plane.
  bool hull = false;

  /// Where given: called once, after all checks, with the measures of the body as the file has it. What it returns,
  /// positive and finite, multiplies every coordinate of every vertex, about the origin, each product rounded to
  /// nearest: a vertex moves by at most u = 2^-53 of each coordinate from where exact arithmetic has it, and the
  /// rounded vertices are the body. Everything that is a length, an area or a volume is measured anew on them, but for
  /// what is about the file's surface, which is multiplied. A power of two changes no bit but exponents.
  std::function<double(const Measures&)> scale = {};
};

/// What was found and done on the way. Lengths are in the unit that the coordinates are used in, times the scale where
/// there is one.
struct MeshReport {
  std::size_t n_vertices = 0;          // of the body
  std::size_t n_points = 0;            // different points that the vertices were found among
  std::size_t n_dropped_vertices = 0;  // those of them that are no vertices of the body
  std::size_t n_faces = 0;             // polygons of the file, without those that collapsed, whatever became of them
  std::size_t n_triangles = 0;         // of the body's surface, as it was measured
  std::size_t n_parts = 0;             // meshes of the file
  std::size_t n_welded_vertices = 0;   // vertices of the file that became one with another
  double weld_distance = 0.0;          // points not farther apart were joined; 0 where equal ones alone were
  double size = 0.0;                   // the diagonal of the bounding box
  bool hull_used = false;  // the measures are the hull's: it was asked for, or the mesh is convex only to tolerance

  CoordinateDigits digits;           // how finely the file states its coordinates; the last place is not scaled
  std::string unit;                  // of length, of the coordinates as they are used; empty where the file names none
  double coordinate_rounding = 0.0;  // one unit in the last place of the largest coordinate, a fraction of the size
  double volume_rounding = 0.0;      // by how much of itself V may differ for it (meshes/coordinate_rounding.h)

  /// A fraction of the size; 0 where the mesh is convex as it is. Not measured, and nothing, for a hull that was asked
  /// for and added volume.
  std::optional<double> reflex_depth = 0.0;

  /// The hull's volume less the mesh's, which for several closed surfaces is the sum of theirs, as if none overlapped;
  /// 0 where the mesh is convex as it is. The hull is that of all points here, before any corner was left out. Nothing,
  /// and a note says why, where the file's faces enclose no defined volume: where an edge is not shared by exactly two
  /// of them that run oppositely along it, where some parts are inside out and others are not, or where together they
  /// enclose more than the hull.
  std::optional<double> hull_added_volume = 0.0;

  std::vector<std::string> notes;  // for the user to read

  /// Why the process that read the file was not confined, though its limits held; empty where it was, or where the
  /// file needed no such process.
  std::string reader_unconfined;
};

/// A body that is the convex hull of its vertices, exactly. These are points of the file (converted and scaled, if so
/// asked), in lexicographic order, so that the same points give the same body from any file. V, S and M are within
/// 1e-12 of the exact polyhedron's. Points inside, or on a facet or an edge, are left out where exact signs prove that
/// they are there; and corners of the hull that are no farther outside the others' hull than the rounding of the
/// coordinates explains, where that is not more than 1e-5 of V/S (meshes/extreme_vertices.h).
struct ConvexMesh : Body {
  MeshReport report;

  /// The body, as the hull that it is. Its vertices are `vertices_of(body)`.
  const Polytope& polytope() const;
};

/// Reads, welds, checks and measures. Throws InputError naming the first condition that fails, where, and by how much.
ConvexMesh load(const std::filesystem::path& path, const MeshOptions& options = {});

/// The same for a mesh that is already in memory.
ConvexMesh convex_mesh_from(PolygonSoup soup, const MeshOptions& options = {});

/// The convex hull of points in any order, those inside included. Throws InputError where a coordinate is not finite or
/// the points span no volume.
ConvexMesh hull_of(std::span<const Vec3d> points);

}  // namespace vex
