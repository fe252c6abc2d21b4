#include "meshes/formats/strict_readers.h"

#include <algorithm>

namespace vex {

std::span<const StrictFormat> strict_formats() {
  static constexpr StrictFormat kFormats[] = {
      {".obj", read_obj},    {".off", read_off},    {".ply", read_ply}, {".stl", read_stl},  {".xyz", read_points},
      {".csv", read_points}, {".txt", read_points}, {".vtk", read_vtk}, {".msh", read_gmsh},
  };
  return kFormats;
}

const StrictFormat* strict_format(std::string_view extension) {
  const auto is_same = [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  };
  for (const StrictFormat& format : strict_formats()) {
    if (std::ranges::equal(extension, format.extension, is_same)) return &format;
  }
  return nullptr;
}

}  // namespace vex
