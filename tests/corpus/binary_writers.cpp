#include <algorithm>

#include "meshes/data/archives.h"
#include "writers.h"

namespace vex::tests {
namespace {

template <class T>
void put_point(const Vec3d& p, Order order, std::string* bytes) {
  for (const double x : {p.x, p.y, p.z}) put(static_cast<T>(x), order, bytes);
}

}  // namespace

std::string ply_binary(const Solid& solid, Order order) {
  return ply_header(solid, order == Order::little ? "binary_little_endian" : "binary_big_endian", "float") +
         ply_data<float, std::uint8_t, std::int32_t>(solid, order);
}
std::string ply_doubles(const Solid& solid, Order order) {
  return ply_header(solid, order == Order::little ? "binary_little_endian" : "binary_big_endian", "double") +
         ply_data<double, std::uint8_t, std::int32_t>(solid, order);
}

std::string stl_binary(const Solid& solid, const std::string& heading) {
  std::string bytes = heading;
  bytes.resize(80, ' ');
  const Solid body = triangulated(solid);
  put(static_cast<std::uint32_t>(body.faces.size()), Order::little, &bytes);
  for (const Face& face : body.faces) {
    put_point<float>({}, Order::little, &bytes);
    for (const std::uint32_t corner : face) put_point<float>(body.points[corner], Order::little, &bytes);
    put(std::uint16_t{0}, Order::little, &bytes);
  }
  return bytes;
}

std::string vtk_binary(const Solid& solid) {
  std::string bytes = "# vtk DataFile Version 3.0\na body\nBINARY\nDATASET POLYDATA\nPOINTS " +
                      std::to_string(solid.points.size()) + " float\n";
  for (const Vec3d& p : solid.points) put_point<float>(p, Order::big, &bytes);
  std::string faces;
  for (const Face& face : solid.faces) {
    put(static_cast<std::int32_t>(face.size()), Order::big, &faces);
    for (const std::uint32_t corner : face) put(static_cast<std::int32_t>(corner), Order::big, &faces);
  }
  return bytes + "\nPOLYGONS " + std::to_string(solid.faces.size()) + " " + std::to_string(faces.size() / 4) + "\n" +
         faces + "\n";
}

std::string vtk51_binary(const Solid& solid) {
  std::string bytes = "# vtk DataFile Version 5.1\na body\nBINARY\nDATASET POLYDATA\nPOINTS " +
                      std::to_string(solid.points.size()) + " double\n";
  for (const Vec3d& p : solid.points) put_point<double>(p, Order::big, &bytes);
  std::string offsets;
  std::string corners;
  std::int64_t end = 0;
  put(end, Order::big, &offsets);
  for (const Face& face : solid.faces) {
    put(end += static_cast<std::int64_t>(face.size()), Order::big, &offsets);
    for (const std::uint32_t corner : face) put(std::int64_t{corner}, Order::big, &corners);
  }
  return bytes + "\nPOLYGONS " + std::to_string(solid.faces.size() + 1) + " " + std::to_string(end) +
         "\nOFFSETS vtktypeint64\n" + offsets + "\nCONNECTIVITY vtktypeint64\n" + corners + "\n";
}

std::string msh22_binary(const Solid& solid, Order order) {
  const Solid body = triangulated(solid);
  std::string bytes = "$MeshFormat\n2.2 1 8\n";
  put(std::int32_t{1}, order, &bytes);
  bytes += "\n$EndMeshFormat\n$Nodes\n" + std::to_string(body.points.size()) + "\n";
  std::int32_t tag = 0;
  for (const Vec3d& p : body.points) {
    put(++tag, order, &bytes);
    put_point<double>(p, order, &bytes);
  }
  bytes += "\n$EndNodes\n$Elements\n" + std::to_string(body.faces.size()) + "\n";
  for (const std::int32_t value : {2, static_cast<int>(body.faces.size()), 2}) put(value, order, &bytes);
  tag = 0;
  for (const Face& face : body.faces) {
    for (const std::int32_t value : {++tag, 0, 1}) put(value, order, &bytes);
    for (const std::uint32_t corner : face) put(static_cast<std::int32_t>(corner + 1), order, &bytes);
  }
  return bytes + "\n$EndElements\n";
}

std::string msh41_binary(const Solid& solid, Order order) {
  const Solid body = triangulated(solid);
  const std::uint64_t n_points = body.points.size();
  const std::uint64_t n_faces = body.faces.size();
  std::string bytes = "$MeshFormat\n4.1 1 8\n";
  put(std::int32_t{1}, order, &bytes);
  bytes += "\n$EndMeshFormat\n$Nodes\n";
  for (const std::uint64_t value : {std::uint64_t{1}, n_points, std::uint64_t{1}, n_points}) put(value, order, &bytes);
  for (const std::int32_t value : {2, 1, 0}) put(value, order, &bytes);
  put(n_points, order, &bytes);
  for (std::uint64_t i = 1; i <= n_points; ++i) put(i, order, &bytes);
  for (const Vec3d& p : body.points) put_point<double>(p, order, &bytes);
  bytes += "\n$EndNodes\n$Elements\n";
  for (const std::uint64_t value : {std::uint64_t{1}, n_faces, std::uint64_t{1}, n_faces}) put(value, order, &bytes);
  for (const std::int32_t value : {2, 1, 2}) put(value, order, &bytes);
  put(n_faces, order, &bytes);
  std::uint64_t tag = 0;
  for (const Face& face : body.faces) {
    put(++tag, order, &bytes);
    for (const std::uint32_t corner : face) put(std::uint64_t{corner} + 1, order, &bytes);
  }
  return bytes + "\n$EndElements\n";
}

std::string gltf_buffer(const Solid& solid, const GltfStyle& style) {
  std::string bytes;
  for (const Vec3d& p : solid.points) put_point<float>(p, Order::little, &bytes);
  for (const Face& face : triangulated(solid).faces) {
    for (const std::uint32_t corner : face) {
      if (style.short_indices) {
        put(static_cast<std::uint16_t>(corner), Order::little, &bytes);
      } else {
        put(corner, Order::little, &bytes);
      }
    }
  }
  return bytes;
}

std::string gltf_text(const Solid& solid, const GltfStyle& style) {
  const std::size_t n_corners = 3 * triangulated(solid).faces.size();
  const std::size_t n_index_bytes = n_corners * (style.short_indices ? 2 : 4);
  const std::string point_bytes = std::to_string(12 * solid.points.size());
  Vec3d low = solid.points.front();
  Vec3d high = low;
  for (const Vec3d& p : solid.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const auto list = [](const Vec3d& p) { return shortest(p.x) + ", " + shortest(p.y) + ", " + shortest(p.z); };
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],)"
         "\n\"nodes\": " +
         style.nodes + ",\n" + R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],)" +
         "\n\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": " +
         std::to_string(solid.points.size()) + ", \"type\": \"VEC3\", \"min\": [" + list(low) + "], \"max\": [" +
         list(high) + "]},\n{\"bufferView\": 1, \"componentType\": " + (style.short_indices ? "5123" : "5125") +
         ", \"count\": " + std::to_string(n_corners) +
         ", \"type\": \"SCALAR\"}],\n\"bufferViews\": [{\"buffer\": 0, \"byteOffset\": 0, \"byteLength\": " +
         point_bytes + "}, {\"buffer\": 0, \"byteOffset\": " + point_bytes +
         ", \"byteLength\": " + std::to_string(n_index_bytes) +
         "}],\n\"buffers\": [{\"byteLength\": " + std::to_string(12 * solid.points.size() + n_index_bytes) +
         (style.uri.empty() ? "" : ", \"uri\": \"" + style.uri + "\"") + "}]}\n";
}

std::string gltf_embedded(const Solid& solid, GltfStyle style) {
  style.uri = "data:application/octet-stream;base64," + base64(gltf_buffer(solid, style));
  return gltf_text(solid, style);
}

std::string glb_of(std::string json, std::string buffer) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  const auto put_size = [&](std::size_t size) { put(static_cast<std::uint32_t>(size), Order::little, &bytes); };
  put_size(2);
  put_size(12 + 8 + json.size() + 8 + buffer.size());
  put_size(json.size());
  bytes += "JSON" + json;
  put_size(buffer.size());
  bytes += "BIN";
  return bytes + '\0' + buffer;
}

std::string glb(const Solid& solid) { return glb_of(gltf_text(solid, {}), gltf_buffer(solid)); }

const std::vector<Writer>& writers() {
  static const std::vector<Writer> kWriters{
      {"obj", ".obj", [](const Solid& s) { return obj_text(s); }},
      {"off", ".off", [](const Solid& s) { return off_text(s); }},
      {"ply_text", ".ply", [](const Solid& s) { return ply_text(s); }},
      {"ply_little", ".ply", [](const Solid& s) { return ply_binary(s, Order::little); }},
      {"ply_big", ".ply", [](const Solid& s) { return ply_binary(s, Order::big); }},
      {"stl_text", ".stl", [](const Solid& s) { return stl_text(s); }},
      {"stl_binary", ".stl", [](const Solid& s) { return stl_binary(s); }},
      {"vtk_text", ".vtk", [](const Solid& s) { return vtk_text(s); }},
      {"vtk_binary", ".vtk", vtk_binary},
      {"vtk51_text", ".vtk", vtk51_text},
      {"vtk51_binary", ".vtk", vtk51_binary},
      {"msh22_text", ".msh", [](const Solid& s) { return msh22_text(s); }},
      {"msh22_little", ".msh", [](const Solid& s) { return msh22_binary(s, Order::little); }},
      {"msh22_big", ".msh", [](const Solid& s) { return msh22_binary(s, Order::big); }},
      {"msh41_text", ".msh", [](const Solid& s) { return msh41_text(s); }},
      {"msh41_little", ".msh", [](const Solid& s) { return msh41_binary(s, Order::little); }},
      {"msh41_big", ".msh", [](const Solid& s) { return msh41_binary(s, Order::big); }},
      {"gltf", ".gltf", [](const Solid& s) { return gltf_embedded(s); }},
      {"glb", ".glb", glb},
      {"dae", ".dae", [](const Solid& s) { return dae_text(s); }},
      {"threemf", ".3mf", threemf},
  };
  return kWriters;
}

}  // namespace vex::tests
