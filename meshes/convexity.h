// Is a closed triangulated surface convex, and if not, where and by how much?
//
// By edges and globally: a surface whose edges all bend outward can still wind several times about its middle (the
// great dodecahedron and the great icosahedron do). Mehlhorn, Naher, Seel, Seidel, Schilz, Schirra, Uhrig, "Checking
// geometric programs or verification of geometric structures", Comput. Geom. 12 (1999): a closed surface without a
// reflex edge bounds a convex body if all its triangles see one point from inside and some ray from there meets it
// once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "meshes/polyhedron_measures.h"
#include "meshes/triangles.h"

namespace vex {

/// A surface seen edge by edge and triangle by triangle. Signs are decided beyond what rounding can hide.
struct ConvexityCensus {
  std::size_t n_reflex_edges = 0;
  double reflex_depth = 0.0;            // a length: the deepest reflex edge below the hull of its two triangles
  std::uint32_t deepest_half_edge = 0;  // where that is
  std::size_t n_blind_triangles = 0;    // do not surely see the centroid from inside; without area, or turned away
  std::uint32_t first_blind_triangle = 0;
  double area_turned_away = 0.0;  // of the triangles that surely see the centroid from outside
  long winding_number = 0;        // how many times the surface winds about the centroid

  /// Then every triangle sees the centroid and no edge is reflex: the surface is a covering of the sphere of
  /// directions, as often as it winds, and convex if that is once.
  bool locally_convex() const { return n_reflex_edges == 0 && n_blind_triangles == 0; }
};

ConvexityCensus convexity_census(const Triangles& triangles, const LocalPoint& centroid);

/// "the edge from (...) to (...)".
std::string edge_text(const Triangles& triangles, std::uint32_t half_edge);

}  // namespace vex
