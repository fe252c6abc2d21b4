// A mesh's body times a number.
#pragma once

#include "meshes/mesh_body.h"
#include "shapes/measures.h"

namespace vex {

/// The vertices times `scale`, each product rounded; where these are not convex by the same triangles, their hull's,
/// and those of them that are its corners. Throws InputError where the scale is not positive and finite, or what it
/// makes is too large or too small or too thin.
MeshBody scaled_body(MeshBody body, double scale);

/// Throws InputError where a measure of a scaled body is beyond doubles.
void check_scaled_measures(const Measures& measures, double scale);

}  // namespace vex
