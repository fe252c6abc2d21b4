// Meshes as text, good and bad, for the tests that run programs.
#pragma once

#include <string>

namespace vex::golden {

/// An OBJ file: a cube of edge 1 from the origin, with six quads turned outwards.
std::string cube_obj();
/// A sphere of radius 1 in rings of triangles, convex to the rounding of its coordinates.
std::string sphere_obj(int n_rings, int n_sectors);
/// A glTF document of a tetrahedron with a corner at the origin and legs of 1, whose numbers are in a file of this name
/// beside it; and what that file holds.
std::string tetrahedron_gltf(const std::string& buffer);
std::string tetrahedron_buffer();
/// COLLADA documents of the same in a unit of this name and size in metres.
std::string tetrahedron_dae(const std::string& unit, const std::string& metres);
/// A text STL file of the same.
std::string tetrahedron_stl();
/// A path of this project's sample bodies.
std::string sample(const std::string& name);

}  // namespace vex::golden
