#include "tests/golden/sample_files.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <initializer_list>
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

std::string tetrahedron_gltf(const std::string& buffer) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":4}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},)"
         R"({"bufferView":1,"componentType":5125,"count":12,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":48}],)"
         R"("buffers":[{"uri":")" +
         buffer + R"(","byteLength":96}]})";
}

std::string tetrahedron_buffer() {
  const auto bytes_of = [](const auto& numbers) {
    return std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof numbers[0]);
  };
  const std::array<float, 12> points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::array<std::uint32_t, 12> faces = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  return bytes_of(points) + bytes_of(faces);
}

std::string tetrahedron_dae(const std::string& unit, const std::string& metres) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2020-01-01T00:00:00</created><modified>2020-01-01T00:00:00</modified><unit name=")" +
         unit + R"(" meter=")" + metres + R"("/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="n" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array>
<technique_common><accessor source="#n" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="b"><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";
}

std::string tetrahedron_stl() {
  const std::array<const char*, 4> points = {"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
  std::string text = "solid tetrahedron\n";
  for (const std::array<std::size_t, 3>& face :
       std::initializer_list<std::array<std::size_t, 3>>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::size_t corner : face) text += std::string("vertex ") + points[corner] + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid tetrahedron\n";
}

std::string sample(const std::string& name) { return std::string(VEX_SOURCE_DIR) + "/meshes/data/" + name; }

}  // namespace vex::golden
