#include "mesh_files.h"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "soups.h"

namespace vex::tests {
namespace {

template <class... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 400> line{};
  std::snprintf(line.data(), line.size(), format, values...);
  return line.data();
}

template <class T>
void put(T value, std::string* bytes) {
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), &value, sizeof(T));
  bytes->append(raw.data(), raw.size());
}

void put_point(const SoupPoint& p, std::string* bytes) {
  put(p.x, bytes);
  put(p.y, bytes);
  put(p.z, bytes);
}

/// The points as lines "PREFIX x y z", with the digits that tell floats apart.
std::string point_lines(const PolygonSoup& soup, const char* prefix) {
  std::string lines;
  for (const SoupPoint& p : soup.points) {
    lines += text("%s%.9g %.9g %.9g\n", prefix, double{p.x}, double{p.y}, double{p.z});
  }
  return lines;
}

/// The faces as lines "PREFIX [size] a b c".
std::string face_lines(const PolygonSoup& soup, const char* prefix, bool with_size, unsigned first_index) {
  std::string lines;
  std::size_t next = 0;
  for (const std::uint32_t size : soup.face_sizes) {
    lines += with_size ? text("%s%u", prefix, size) : text("%s", prefix);
    for (const std::size_t end = next + size; next < end; ++next) {
      lines += text(" %u", soup.corners[next] + first_index);
    }
    lines += "\n";
  }
  return lines;
}

std::string ply_header(const PolygonSoup& soup, const char* format) {
  return text("ply\nformat %s 1.0\nelement vertex %zu\nproperty float x\nproperty float y\nproperty float z\n"
              "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
              format, soup.points.size(), soup.face_sizes.size());
}

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[i + k])) : 0U;
    };
    const unsigned group = byte(0) << 16U | byte(1) << 8U | byte(2);
    result += kDigits[group >> 18U & 63U];
    result += kDigits[group >> 12U & 63U];
    result += i + 1 < bytes.size() ? kDigits[group >> 6U & 63U] : '=';
    result += i + 2 < bytes.size() ? kDigits[group & 63U] : '=';
  }
  return result;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "vex-meshes-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw std::runtime_error("cannot make a temporary folder");
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::file(const std::string& name, const std::string& bytes) const {
  const std::filesystem::path path = path_ / name;
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

std::string obj_text(const PolygonSoup& soup) { return point_lines(soup, "v ") + face_lines(soup, "f", false, 1); }

std::string off_text(const PolygonSoup& soup) {
  return text("OFF\n%zu %zu 0\n", soup.points.size(), soup.face_sizes.size()) + point_lines(soup, "") +
         face_lines(soup, "", true, 0);
}

std::string ply_text(const PolygonSoup& soup) {
  return ply_header(soup, "ascii") + point_lines(soup, "") + face_lines(soup, "", true, 0);
}

std::string ply_binary(const PolygonSoup& soup) {
  std::string bytes = ply_header(soup, "binary_little_endian");
  for (const SoupPoint& p : soup.points) {
    put_point(p, &bytes);
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
    const SoupPoint& p = flat.points[i];
    lines += i % 3 == 0 ? "facet normal 0 0 0\nouter loop\n" : "";
    lines += text("vertex %.9g %.9g %.9g\n", double{p.x}, double{p.y}, double{p.z});
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
  for (const SoupPoint& p : soup.points) {
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
  SoupPoint low = soup.points.front();
  SoupPoint high = low;
  for (const SoupPoint& p : soup.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  std::string json = "{\"asset\": {\"version\": \"2.0\"}, \"scene\": 0, \"scenes\": [{\"nodes\": [0]}],\n\"nodes\": " +
                     nodes +
                     ",\n\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1}]}],\n";
  json += text(
      "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": %zu, \"type\": \"VEC3\", "
      "\"min\": [%.9g, %.9g, %.9g], \"max\": [%.9g, %.9g, %.9g]},\n",
      soup.points.size(), double{low.x}, double{low.y}, double{low.z}, double{high.x}, double{high.y}, double{high.z});
  json += text("{\"bufferView\": 1, \"componentType\": 5125, \"count\": %zu, \"type\": \"SCALAR\"}],\n", n_corners);
  json += text("\"bufferViews\": [{\"buffer\": 0, \"byteOffset\": 0, \"byteLength\": %zu}, ", n_point_bytes);
  json += text("{\"buffer\": 0, \"byteOffset\": %zu, \"byteLength\": %zu}],\n", n_point_bytes, 4 * n_corners);
  json += text("\"buffers\": [{\"byteLength\": %zu", n_point_bytes + 4 * n_corners);
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
    sizes += text("%u ", size);
  }
  std::string corners;
  for (const std::uint32_t corner : soup.corners) {
    corners += text("%u ", corner);
  }
  return text("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<COLLADA "
              "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
              "<asset><up_axis>Z_UP</up_axis></asset>\n<library_geometries><geometry id=\"g\"><mesh>\n"
              "<source id=\"p\"><float_array id=\"a\" count=\"%zu\">\n",
              3 * soup.points.size()) +
         point_lines(soup, "") +
         text("</float_array><technique_common><accessor source=\"#a\" count=\"%zu\" stride=\"3\">"
              "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/>"
              "</accessor></technique_common></source>\n",
              soup.points.size()) +
         text("<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>\n<polylist count=\"%zu\">"
              "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>\n<vcount>",
              soup.face_sizes.size()) +
         sizes + "</vcount><p>" + corners +
         "</p></polylist></mesh></geometry></library_geometries>\n<library_visual_scenes><visual_scene id=\"s\">"
         "<node id=\"n\"><instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>\n"
         "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>\n";
}

std::string threemf_model_text(const PolygonSoup& soup) {
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n<resources><object id=\"1\" "
      "type=\"model\"><mesh><vertices>\n";
  for (const SoupPoint& p : soup.points) {
    xml += text("<vertex x=\"%.9g\" y=\"%.9g\" z=\"%.9g\"/>\n", double{p.x}, double{p.y}, double{p.z});
  }
  xml += "</vertices><triangles>\n";
  const PolygonSoup triangles = triangulated(soup);
  for (std::size_t i = 0; i < triangles.corners.size(); i += 3) {
    xml += text("<triangle v1=\"%u\" v2=\"%u\" v3=\"%u\"/>\n", triangles.corners[i], triangles.corners[i + 1],
                triangles.corners[i + 2]);
  }
  return xml + "</triangles></mesh></object></resources><build><item objectid=\"1\"/></build></model>\n";
}

std::string mesh_bytes(const PolygonSoup& soup, const std::string& extension) {
  if (extension == ".obj") {
    return obj_text(soup);
  }
  if (extension == ".off") {
    return off_text(soup);
  }
  if (extension == ".ply") {
    return ply_binary(soup);
  }
  if (extension == ".stl") {
    return stl_binary(soup);
  }
  if (extension == ".gltf") {
    return gltf_embedded(soup);
  }
  if (extension == ".glb") {
    return glb(soup);
  }
  if (extension == ".dae") {
    return dae_text(soup);
  }
  throw std::logic_error("no writer for " + extension);
}

}  // namespace vex::tests
