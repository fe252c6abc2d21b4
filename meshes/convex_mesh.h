// File -> checked convex body; or, where the hull is asked for, the convex hull of whatever points the file holds.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "meshes/polygon_soup.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"
#include "shapes/polytope.h"

namespace vex {

struct MeshOptions {
  double convex_tolerance = 1e-6;  // a fraction of the size: how deep a reflex edge or a vertex below the hull may be
  bool isolated_reader = true;     // read the file in a process of its own, so that a broken one cannot crash this one

  /// Take the convex hull of all points that the reader delivers, those that no face uses included, and ask nothing of
  /// the surface: it may be open, turned about, in several parts, without volume, or not there at all. What is asked:
  /// finite coordinates, and points that do not all lie in one plane.
  bool hull = false;

  /// Where given: called once, after all checks, with the measures of the body as the file has it. What it returns,
  /// positive and finite, multiplies every coordinate of every vertex, about the origin, each product rounded to
  /// nearest: a vertex moves by at most u = 2^-53 of each coordinate from where exact arithmetic has it, and the
  /// rounded vertices are the body. Everything that is a length, an area or a volume is measured anew on them. A power
  /// of two changes no bit but exponents.
  std::function<double(const Measures&)> scale = {};
};

/// What was found and done on the way. Lengths are in the file's units, times the scale where there is one.
struct MeshReport {
  std::size_t n_vertices = 0;         // of the body
  std::size_t n_points = 0;           // different points that the vertices were found among; more only for a hull
  std::size_t n_faces = 0;            // polygons of the file, without those that collapsed
  std::size_t n_triangles = 0;        // of the surface that was measured
  std::size_t n_parts = 0;            // meshes of the file
  std::size_t n_welded_vertices = 0;  // vertices of the file that another one's place already had
  double size = 0.0;                  // the diagonal of the bounding box
  bool hull_used = false;  // the measures are the hull's: it was asked for, or the mesh is convex only to tolerance

  /// A fraction of the size; 0 where the mesh is convex as it is. Not measured, and nothing, for a hull that was asked
  /// for and added volume.
  std::optional<double> reflex_depth = 0.0;

  /// The hull's volume less the mesh's, which for several closed surfaces is the sum of theirs, as if none overlapped;
  /// 0 where the mesh is convex as it is. Nothing, and a note says why, where the file's faces enclose no defined
  /// volume: where an edge is not shared by exactly two of them that run oppositely along it, where some parts are
  /// inside out and others are not, or where together they enclose more than the hull.
  std::optional<double> hull_added_volume = 0.0;

  std::vector<std::string> notes;  // for the user to read
};

/// A body that is the convex hull of the mesh's vertices, exactly: floats promoted to double (and scaled, if so asked),
/// in lexicographic order, so that the same floats give the same body from any file. V, S and M are within 1e-12 of the
/// exact polyhedron's. A hull that was asked for has its own vertices only: points inside, or on a facet or an edge,
/// are left out where exact signs prove that they are there.
struct ConvexMesh {
  Polytope body;
  Measures measures;
  MeshReport report;

  /// The measures on normals of the surface that was measured, made from it each time they are asked for.
  NormalMeasures normals{};
};

/// Reads, welds, checks and measures. Throws InputError naming the first condition that fails, where, and by how much.
ConvexMesh load_convex_mesh(const std::filesystem::path& path, const MeshOptions& options = {});

/// The same for a mesh that is already in memory.
ConvexMesh convex_mesh_from(const PolygonSoup& soup, const MeshOptions& options = {});

}  // namespace vex
