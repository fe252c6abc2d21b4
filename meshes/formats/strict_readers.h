// Readers of our own: what the file says, exactly, or a refusal that names the line.
//
// Geometry only, in double: coordinates are the decimals of the text, correctly rounded, or the file's own 32-bit or
// 64-bit numbers. A token that is no number, a count that does not hold, an index out of range, and data that end
// early are refused with the file, the line (or the byte) and what was expected. No memory is taken for a count before
// the data that it announces have been seen, so it stays within a small multiple of the file's size.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "meshes/polygon_soup.h"

namespace vex {

/// `bytes`: the whole file. `name`: what messages call it. Throw InputError.
PolygonSoup read_obj(std::string_view bytes, const std::string& name);     // Wavefront: v, f; with l and p as lines and points
PolygonSoup read_off(std::string_view bytes, const std::string& name);     // Geomview: OFF, and its variants [C][N][ST]OFF, text
PolygonSoup read_ply(std::string_view bytes, const std::string& name);     // Stanford: text, binary of either byte order
PolygonSoup read_stl(std::string_view bytes, const std::string& name);     // text and binary
PolygonSoup read_points(std::string_view bytes, const std::string& name);  // .xyz .txt .csv: x, y, z first in each line
PolygonSoup read_vtk(std::string_view bytes, const std::string& name);     // legacy PolyData, text and binary
PolygonSoup read_gmsh(std::string_view bytes, const std::string& name);    // .msh 2.x and 4.1, surfaces, text and binary

struct StrictFormat {
  std::string_view extension;  // ".obj", in lower case
  PolygonSoup (*read)(std::string_view bytes, const std::string& name);
};
std::span<const StrictFormat> strict_formats();

/// The format of an extension in any case; null where there is none of ours.
const StrictFormat* strict_format(std::string_view extension);

}  // namespace vex
