// From a soup to a surface: coincident points become one vertex, and everything gets one order.
#pragma once

#include <cstddef>

#include "meshes/polygon_soup.h"
#include "meshes/surface.h"

namespace vex {

struct WeldedSurface {
  PolygonSurface surface;
  std::size_t n_welded_vertices = 0;  // points that are not dropped, less the vertices they became
  std::size_t n_collapsed_faces = 0;  // had fewer than three different consecutive corners left
};

/// What becomes of points that no face uses, or none that did not collapse.
enum class UnusedPoints { dropped, kept };

/// Joins the points whose coordinates are equal (-0 and +0 are), drops points that no face uses and faces that
/// collapse, and orders what is left (PolygonSurface): the same floats give the same surface from any file format, bit
/// for bit. Throws InputError where a coordinate is not finite or a face names a point that is not there.
WeldedSurface weld(const PolygonSoup& soup, UnusedPoints unused = UnusedPoints::dropped);

}  // namespace vex
