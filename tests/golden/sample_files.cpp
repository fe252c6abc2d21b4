#include "tests/golden/sample_files.h"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace vex::golden {

std::string cube_obj() {
  return "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
         "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

std::string sphere_obj(int n_rings, int n_sectors) {
  std::string text = "v 0 0 1\n";
  const auto add_vertex = [&text](double x, double y, double z) {
    char line[128];
    std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", x, y, z);
    text += line;
  };
  const auto add_face = [&text](int a, int b, int c) {
    text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  };
  for (int ring = 1; ring < n_rings; ++ring) {
    const double polar = std::numbers::pi * ring / n_rings;
    for (int sector = 0; sector < n_sectors; ++sector) {
      const double azimuth = 2.0 * std::numbers::pi * (sector + 0.5 * (ring % 2)) / n_sectors;
      add_vertex(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
    }
  }
  text += "v 0 0 -1\n";
  const int last = 2 + (n_rings - 1) * n_sectors;
  const auto at = [n_sectors](int ring, int sector) { return 2 + (ring - 1) * n_sectors + sector % n_sectors; };
  for (int s = 0; s < n_sectors; ++s) {
    add_face(1, at(1, s), at(1, s + 1));
    add_face(at(n_rings - 1, s), last, at(n_rings - 1, s + 1));
    for (int r = 1; r < n_rings - 1; ++r) {
      // The lower ring is half a sector behind or ahead.
      const int shift = r % 2;
      add_face(at(r, s), at(r + 1, s + shift), at(r, s + 1));
      add_face(at(r + 1, s), at(r + 1, s + 1), at(r, s + 1 - shift));
    }
  }
  return text;
}

std::string sample(const std::string& name) { return std::string(VEX_SOURCE_DIR) + "/meshes/data/" + name; }

}  // namespace vex::golden
