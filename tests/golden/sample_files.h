// Meshes as text, good and bad, for the tests that run programs.
#pragma once

#include <string>

namespace vex::golden {

/// An OBJ file: a cube of edge 1 from the origin, with six quads turned outwards.
std::string cube_obj();
/// A sphere of radius 1 in rings of triangles, convex to the rounding of its coordinates.
std::string sphere_obj(int n_rings, int n_sectors);
/// A path of this project's sample bodies.
std::string sample(const std::string& name);

}  // namespace vex::golden
