// File -> checked convex body.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "meshes/polygon_soup.h"
#include "shapes/measures.h"
#include "shapes/polytope.h"

namespace vex {

struct MeshOptions {
  double convex_tolerance = 1e-6;  // a fraction of the size: how deep a reflex edge or a vertex below the hull may be
  bool isolated_reader = true;     // read the file in a process of its own, so that a broken one cannot crash this one
};

/// What was found and done on the way. Lengths are in the file's units.
struct MeshReport {
  std::size_t n_vertices = 0;         // after welding
  std::size_t n_faces = 0;            // polygons of the file, without those that collapsed
  std::size_t n_triangles = 0;        // of the surface that was measured
  std::size_t n_parts = 0;            // meshes of the file
  std::size_t n_welded_vertices = 0;  // vertices of the file that another one's place already had
  double reflex_depth = 0.0;          // fraction of the size; 0 where the mesh is convex as it is
  double size = 0.0;                  // the diagonal of the bounding box
  bool hull_used = false;          // the measures are the hull's, because the mesh is convex only within the tolerance
  double hull_added_volume = 0.0;  // the hull's volume less the mesh's
  std::vector<std::string> notes;  // for the user to read
};

/// A body that is the convex hull of the mesh's vertices, exactly: floats promoted to double, in lexicographic order,
/// so that the same floats give the same body from any file. V, S and M are within 1e-12 of the exact polyhedron's.
struct ConvexMesh {
  Polytope body;
  Measures measures;
  MeshReport report;
};

/// Reads, welds, checks and measures. Throws InputError naming the first condition that fails, where, and by how much.
ConvexMesh load_convex_mesh(const std::filesystem::path& path, const MeshOptions& options = {});

/// The same for a mesh that is already in memory.
ConvexMesh convex_mesh_from(const PolygonSoup& soup, const MeshOptions& options = {});

}  // namespace vex
