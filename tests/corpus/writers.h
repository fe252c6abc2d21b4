// Writes solids as mesh files. Written for the corpus alone: it shares no line with the readers.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "file_text.h"
#include "solids.h"

namespace vex::tests {

using Number = std::function<std::string(double)>;
/// "%.6g" and the like, as numbers of a text file.
Number as_printed(const char* format);

// --- text

std::string point_lines(const Solid& solid, const char* prefix = "", const Number& number = shortest);
std::string obj_text(const Solid& solid, const Number& number = shortest);
std::string off_text(const Solid& solid, const Number& number = shortest);
std::string ply_text(const Solid& solid, const Number& number = shortest);
std::string stl_text(const Solid& solid, const Number& number = shortest);  // triangles
std::string csv_text(const Solid& solid, const char* separator = ",");      // points
std::string vtk_text(const Solid& solid, const Number& number = shortest);  // version 3.0
std::string vtk51_text(const Solid& solid);
std::string msh22_text(const Solid& solid, const Number& number = shortest);  // triangles
std::string msh41_text(const Solid& solid, const Number& number = shortest);  // triangles

// --- binary

/// A header of a .ply file: x, y, z of `type`, and lists of `lists` that name the corners.
std::string ply_header(const Solid& solid, const std::string& format, const std::string& type,
                       const std::string& lists = "uchar int");

/// Counts, corners and coordinates of these types.
template <class Coordinate, class Count, class Index>
std::string ply_data(const Solid& solid, Order order) {
  std::string bytes;
  for (const Vec3d& p : solid.points) {
    for (const double x : {p.x, p.y, p.z}) put(static_cast<Coordinate>(x), order, &bytes);
  }
  for (const Face& face : solid.faces) {
    put(static_cast<Count>(face.size()), order, &bytes);
    for (const std::uint32_t corner : face) put(static_cast<Index>(corner), order, &bytes);
  }
  return bytes;
}
std::string ply_binary(const Solid& solid, Order order);  // floats
std::string ply_doubles(const Solid& solid, Order order);
std::string stl_binary(const Solid& solid, const std::string& heading = "");  // triangles
std::string vtk_binary(const Solid& solid);                                   // floats, version 3.0
std::string vtk51_binary(const Solid& solid);                                 // doubles
std::string msh22_binary(const Solid& solid, Order order);                    // triangles
std::string msh41_binary(const Solid& solid, Order order);                    // triangles

// --- what assimp reads

struct GltfStyle {
  std::string uri = "";  // of the buffer; empty: none
  std::string nodes = R"([{"mesh": 0}])";
  bool short_indices = false;
};
std::string gltf_buffer(const Solid& solid, const GltfStyle& style = {});
std::string gltf_text(const Solid& solid, const GltfStyle& style);
std::string gltf_embedded(const Solid& solid, GltfStyle style = {});
std::string glb_of(std::string json, std::string buffer);
std::string glb(const Solid& solid);
std::string dae_text(const Solid& solid, const Number& number = shortest);
std::string threemf_model(const Solid& solid, const Number& number = shortest);
/// `extra`: more files of the archive.
std::string threemf_of(const std::string& model, bool deflated = false,
                       const std::vector<std::pair<std::string, std::string>>& extra = {});
std::string threemf(const Solid& solid);

/// Every way above, for what is to be shown of each. `name`: letters and digits.
struct Writer {
  std::string_view name;
  std::string_view extension;
  std::string (*bytes)(const Solid&);
};
const std::vector<Writer>& writers();

}  // namespace vex::tests
