#include "meshes/data/mesh_writers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "meshes/data/archives.h"
#include "meshes/nearest_float.h"

namespace vex {
namespace {

bool is_float(double x) {
  return !(std::fabs(x) <= double{std::numeric_limits<float>::max()}) || nearest_float(x) == x;
}

bool all_floats(const PolygonSoup& soup) {
  return std::ranges::all_of(soup.points,
                             [](const Vec3d& p) { return is_float(p.x) && is_float(p.y) && is_float(p.z); });
}

std::string piece(const std::string& part) { return part; }
std::string piece(std::uint64_t number) { return std::to_string(number); }
std::string piece(std::uint32_t number) { return std::to_string(number); }
std::string piece(double number) {
  std::array<char, 40> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}
std::string piece(const Vec3d& p) { return piece(p.x) + " " + piece(p.y) + " " + piece(p.z); }

/// Strings, whole numbers, coordinates and points, one after another.
template <class... Parts>
std::string text(const Parts&... parts) {
  std::string all;
  (all.append(piece(parts)), ...);
  return all;
}

template <class T>
void put(T value, std::string* bytes) {
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), &value, sizeof(T));
  bytes->append(raw.data(), raw.size());
}

void put_point(const Vec3d& p, std::string* bytes) {
  put(static_cast<float>(p.x), bytes);
  put(static_cast<float>(p.y), bytes);
  put(static_cast<float>(p.z), bytes);
}

/// The points as lines "PREFIX x y z", with as few digits as read back the same doubles: every format says the same.
std::string point_lines(const PolygonSoup& soup, const char* prefix) {
  std::string lines;
  for (const Vec3d& p : soup.points) {
    lines += text(prefix, p, "\n");
  }
  return lines;
}

/// The faces as lines "PREFIX [size] a b c".
std::string face_lines(const PolygonSoup& soup, const char* prefix, bool with_size, unsigned first_index) {
  std::string lines;
  std::size_t next = 0;
  for (const std::uint32_t size : soup.face_sizes) {
    lines += with_size ? text(prefix, size) : prefix;
    for (const std::size_t end = next + size; next < end; ++next) {
      lines += text(" ", soup.corners[next] + first_index);
    }
    lines += "\n";
  }
  return lines;
}

std::string ply_header(const PolygonSoup& soup, const char* format) {
  const std::string type = all_floats(soup) ? "float" : "double";
  return text("ply\nformat ", format, " 1.0\nelement vertex ", soup.points.size(),
              text("\nproperty ", type, " x\nproperty ", type, " y\nproperty ", type, " z\nelement face "),
              soup.face_sizes.size(), "\nproperty list uchar int vertex_indices\nend_header\n");
}

std::string threemf_model(const PolygonSoup& soup) {
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n<resources><object id=\"1\" "
      "type=\"model\"><mesh><vertices>\n";
  for (const Vec3d& p : soup.points) {
    xml += text("<vertex x=\"", p.x, "\" y=\"", p.y, "\" z=\"", p.z, "\"/>\n");
  }
  xml += "</vertices><triangles>\n";
  const PolygonSoup triangles = triangulated(soup);
  for (std::size_t i = 0; i < triangles.corners.size(); i += 3) {
    xml += text("<triangle v1=\"", triangles.corners[i], "\" v2=\"", triangles.corners[i + 1], "\" v3=\"",
                triangles.corners[i + 2], "\"/>\n");
  }
  return xml + "</triangles></mesh></object></resources><build><item objectid=\"1\"/></build></model>\n";
}

}  // namespace

PolygonSoup triangulated(const PolygonSoup& soup) {
  PolygonSoup result;
  result.points = soup.points;
  result.n_parts = soup.n_parts;
  std::size_t begin = 0;
  for (const std::uint32_t size : soup.face_sizes) {
    for (std::size_t i = 1; i + 1 < size; ++i) {
      result.add_face({soup.corners[begin], soup.corners[begin + i], soup.corners[begin + i + 1]});
    }
    begin += size;
  }
  return result;
}

PolygonSoup with_own_corners(const PolygonSoup& soup) {
  PolygonSoup result;
  result.n_parts = soup.n_parts;
  result.face_sizes = soup.face_sizes;
  for (const std::uint32_t corner : soup.corners) {
    result.corners.push_back(static_cast<std::uint32_t>(result.points.size()));
    result.points.push_back(soup.points[corner]);
  }
  return result;
}

std::string obj_text(const PolygonSoup& soup) { return point_lines(soup, "v ") + face_lines(soup, "f", false, 1); }

std::string off_text(const PolygonSoup& soup) {
  return text("OFF\n", soup.points.size(), " ", soup.face_sizes.size(), " 0\n") + point_lines(soup, "") +
         face_lines(soup, "", true, 0);
}

std::string ply_text(const PolygonSoup& soup) {
  return ply_header(soup, "ascii") + point_lines(soup, "") + face_lines(soup, "", true, 0);
}

std::string ply_binary(const PolygonSoup& soup) {
  std::string bytes = ply_header(soup, "binary_little_endian");
  const bool as_floats = all_floats(soup);
  for (const Vec3d& p : soup.points) {
    if (as_floats) {
      put_point(p, &bytes);
      continue;
    }
    put(p.x, &bytes);
    put(p.y, &bytes);
    put(p.z, &bytes);
  }
  std::size_t next = 0;
  for (const std::uint32_t size : soup.face_sizes) {
    put(static_cast<unsigned char>(size), &bytes);
    for (const std::size_t end = next + size; next < end; ++next) {
      put(soup.corners[next], &bytes);
    }
  }
  return bytes;
}

std::string stl_text(const PolygonSoup& soup) {
  const PolygonSoup flat = with_own_corners(triangulated(soup));
  std::string lines = "solid body\n";
  for (std::size_t i = 0; i < flat.points.size(); ++i) {
    const Vec3d& p = flat.points[i];
    lines += i % 3 == 0 ? "facet normal 0 0 0\nouter loop\n" : "";
    lines += text("vertex ", p, "\n");
    lines += i % 3 == 2 ? "endloop\nendfacet\n" : "";
  }
  return lines + "endsolid body\n";
}

std::string stl_binary(const PolygonSoup& soup) {
  const PolygonSoup flat = with_own_corners(triangulated(soup));
  std::string bytes(80, ' ');
  put(static_cast<std::uint32_t>(flat.face_sizes.size()), &bytes);
  for (std::size_t i = 0; i < flat.points.size(); ++i) {
    if (i % 3 == 0) {
      put_point({}, &bytes);
    }
    put_point(flat.points[i], &bytes);
    if (i % 3 == 2) {
      put(std::uint16_t{0}, &bytes);
    }
  }
  return bytes;
}

std::string gltf_buffer(const PolygonSoup& soup) {
  std::string bytes;
  for (const Vec3d& p : soup.points) {
    put_point(p, &bytes);
  }
  for (const std::uint32_t corner : triangulated(soup).corners) {
    put(corner, &bytes);
  }
  return bytes;
}

std::string gltf_text(const PolygonSoup& soup, const std::string& buffer_uri, const std::string& nodes) {
  const std::size_t n_corners = triangulated(soup).corners.size();
  const std::size_t n_point_bytes = 12 * soup.points.size();
  Vec3d low = soup.points.front();
  Vec3d high = low;
  for (const Vec3d& p : soup.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  std::string json =
      "{\"asset\": {\"version\": \"2.0\"}, \"scene\": 0, \"scenes\": [{\"nodes\": [0]}],\n\"nodes\": " + nodes +
      ",\n\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1}]}],\n";
  const auto list = [&](const Vec3d& p) {
    return text(nearest_float(p.x), ", ", nearest_float(p.y), ", ", nearest_float(p.z));
  };
  json += text("\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": ", soup.points.size(),
               ", \"type\": \"VEC3\", \"min\": [", list(low), "], \"max\": [", list(high), "]},\n");
  json += text("{\"bufferView\": 1, \"componentType\": 5125, \"count\": ", n_corners, ", \"type\": \"SCALAR\"}],\n");
  json += text("\"bufferViews\": [{\"buffer\": 0, \"byteOffset\": 0, \"byteLength\": ", n_point_bytes, "}, ");
  json += text("{\"buffer\": 0, \"byteOffset\": ", n_point_bytes, ", \"byteLength\": ", 4 * n_corners, "}],\n");
  json += text("\"buffers\": [{\"byteLength\": ", n_point_bytes + 4 * n_corners);
  return json + (buffer_uri.empty() ? "" : ", \"uri\": \"" + buffer_uri + "\"") + "}]}\n";
}

std::string gltf_embedded(const PolygonSoup& soup) {
  return gltf_text(soup, "data:application/octet-stream;base64," + base64(gltf_buffer(soup)));
}

std::string glb(const PolygonSoup& soup) {
  std::string json = gltf_text(soup, "");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string buffer = gltf_buffer(soup);  // a multiple of four
  std::string bytes;
  put(std::uint32_t{0x46546C67}, &bytes);
  put(std::uint32_t{2}, &bytes);
  put(static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + buffer.size()), &bytes);
  put(static_cast<std::uint32_t>(json.size()), &bytes);
  put(std::uint32_t{0x4E4F534A}, &bytes);
  bytes += json;
  put(static_cast<std::uint32_t>(buffer.size()), &bytes);
  put(std::uint32_t{0x004E4942}, &bytes);
  return bytes + buffer;
}

std::string dae_text(const PolygonSoup& soup) {
  std::string sizes;
  for (const std::uint32_t size : soup.face_sizes) {
    sizes += text(size, " ");
  }
  std::string corners;
  for (const std::uint32_t corner : soup.corners) {
    corners += text(corner, " ");
  }
  return text(
             "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<COLLADA "
             "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
             "<asset><up_axis>Z_UP</up_axis></asset>\n<library_geometries><geometry id=\"g\"><mesh>\n"
             "<source id=\"p\"><float_array id=\"a\" count=\"",
             3 * soup.points.size(), "\">\n") +
         point_lines(soup, "") +
         text("</float_array><technique_common><accessor source=\"#a\" count=\"", soup.points.size(),
              "\" stride=\"3\">"
              "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/>"
              "</accessor></technique_common></source>\n") +
         text("<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>\n<polylist count=\"",
              soup.face_sizes.size(), "\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>\n<vcount>") +
         sizes + "</vcount><p>" + corners +
         "</p></polylist></mesh></geometry></library_geometries>\n<library_visual_scenes><visual_scene id=\"s\">"
         "<node id=\"n\"><instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>\n"
         "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>\n";
}

std::string threemf(const PolygonSoup& soup) {
  const std::string ns = "http://schemas.openxmlformats.org/package/2006/";
  return zipped({{"[Content_Types].xml", "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Types xmlns=\"" + ns +
                                             "content-types\"><Default Extension=\"rels\" ContentType=\"application/"
                                             "vnd.openxmlformats-package.relationships+xml\"/><Default "
                                             "Extension=\"model\" ContentType=\"application/"
                                             "vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n"},
                 {"_rels/.rels", "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships xmlns=\"" + ns +
                                     "relationships\"><Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
                                     "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>"
                                     "</Relationships>\n"},
                 {"3D/3dmodel.model", threemf_model(soup)}});
}

std::string mesh_bytes(const PolygonSoup& soup, const std::string& extension) {
  using Writer = std::string (*)(const PolygonSoup&);
  static const std::map<std::string, Writer> kWriters{
      {".obj", obj_text},       {".off", off_text}, {".ply", ply_binary}, {".stl", stl_binary},
      {".gltf", gltf_embedded}, {".glb", glb},      {".dae", dae_text},   {".3mf", threemf}};
  std::string lower = extension;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return kWriters.at(lower)(soup);
}

}  // namespace vex
