// From a soup to a surface: coincident points become one vertex, and everything gets one order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "meshes/polygon_soup.h"
#include "meshes/surface.h"

namespace vex {

struct WeldedSurface {
  PolygonSurface surface;
  std::size_t n_welded_vertices = 0;  // points that are not dropped, less the vertices they became
  std::size_t n_collapsed_faces = 0;  // had fewer than three different consecutive corners left
  double distance = 0.0;              // points that were not farther apart were joined; 0 where equal ones alone were
  double largest_move = 0.0;          // of a point to the vertex that it became; not above a few times `distance`
};

/// What becomes of points that no face uses, or none that did not collapse.
enum class UnusedPoints { dropped, kept };

/// The largest coordinate that is taken, that of 32-bit floats, and the least one that is not 0: so much room do the
/// determinants' error bounds need (determinant.h).
inline constexpr double kLargestFileCoordinate = 0x1p128;
inline constexpr double kLeastFileCoordinate = 0x1p-149;

/// Joins the points whose coordinates are equal (-0 and +0 are), drops points that no face uses and faces that
/// collapse, and orders what is left (PolygonSurface): the same points give the same surface from any file format, bit
/// for bit. Throws InputError where a coordinate is not finite or too large or too small, or a face names a point that
/// is not there.
WeldedSurface weld(const PolygonSoup& soup, UnusedPoints unused = UnusedPoints::dropped);

/// The surface with each vertex v replaced by `joined_to[v]`, which is one that is joined to itself: corners that
/// repeat the one before are left out, faces that have fewer than three then are dropped, and all is put in order.
/// Returns the number of these faces. Vertices that were joined to another one are dropped; those that no face uses, if
/// so asked.
std::size_t join_vertices(std::span<const std::uint32_t> joined_to, UnusedPoints unused, PolygonSurface* surface);

}  // namespace vex
