// The referee for V, S and M: the same polyhedron in rational and 50-digit arithmetic, by other formulas.
#pragma once

#include "meshes/polygon_soup.h"
#include "meshes/triangles.h"
#include "shapes/measures.h"

namespace vex::tests {

/// Of a closed convex surface of triangles, counter-clockwise from outside; corners may be points of their own.
/// V: rational, by the divergence theorem about the origin. S: Gram determinants. M: from the interior dihedral angles
/// between the directions within the two faces that are perpendicular to the edge.
Measures exact_measures(const PolygonSoup& triangles);
Measures exact_measures(const Triangles& triangles);

}  // namespace vex::tests
