// The faces of a mesh as triangles, whatever they enclose: what a compound of triangles is made from. A mesh here need
// be neither closed nor convex.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "engine/numeric/vec3.h"
#include "meshes/polygon_soup.h"
#include "meshes/reader.h"

namespace vex {

/// Each face cut into triangles that fan out from its first corner; coordinates as they stand, in the order of the
/// file. A polygon that is not plane becomes what its fan is. Throws InputError where there is no face, where a
/// coordinate is not finite, and for a face that is no convex polygon (a corner turned inwards by more than 1e-6 rad,
/// seen along its normal; or sides that cross), which its fan would not be.
std::vector<std::array<Vec3d, 3>> triangles_of(const PolygonSoup& soup);

/// Of a file that `read_polygon_soup` reads.
std::vector<std::array<Vec3d, 3>> read_triangles(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace vex
