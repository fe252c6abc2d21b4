#include "reader_fuzz.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "engine/numeric/errors.h"
#include "meshes/assimp_input.h"
#include "meshes/data/archives.h"
#include "meshes/formats/scene_formats.h"
#include "meshes/formats/strict_readers.h"
#include "meshes/gunzip.h"

namespace vex::tests {
namespace {

void check_soup(const PolygonSoup& soup, std::size_t n_bytes) {
  std::uint64_t n_corners = 0;
  for (const std::uint32_t size : soup.face_sizes) {
    demand(size >= 3, "a face has three corners at least");
    n_corners += size;
  }
  demand(n_corners == soup.corners.size(), "the faces' sizes sum up to the corners");
  for (const std::uint32_t corner : soup.corners) demand(corner < soup.points.size(), "corners are points");
  double largest = 0.0;
  for (const Vec3d& p : soup.points) {
    demand(is_finite(p), "coordinates are finite");
    largest = std::fmax(largest, std::fmax(std::fabs(p.x), std::fmax(std::fabs(p.y), std::fabs(p.z))));
  }
  demand(!soup.points.empty() || soup.corners.empty(), "there are points");
  const std::size_t held = 24 * soup.points.size() + 4 * soup.corners.size() + 4 * soup.face_sizes.size();
  demand(held <= 64 * n_bytes + 4096, "the soup is at most a multiple of the file");
  const std::size_t taken = 24 * soup.points.capacity() + 4 * soup.corners.capacity() + 4 * soup.face_sizes.capacity();
  demand(taken <= 128 * n_bytes + 4096, "so is the memory taken");
  demand(std::isfinite(soup.digits.last_place) && soup.digits.last_place >= 0.0, "the last place is a length");
  demand(soup.digits.kind != CoordinateDigits::Kind::decimals || soup.digits.n_digits >= 1, "decimals have digits");
  demand(soup.points.empty() || soup.digits.last_place > 0.0, "points have a last place");
}

void check_message(const std::string& message, const std::string& name) {
  demand(message.find(name) != std::string::npos, "the message names the file");
  const std::size_t advice = message.find(" - ");
  demand(advice != std::string::npos && advice == message.rfind(" - "), "the message ends in one advice");
  demand(message.size() < 600, "the message is short");
  for (const char c : message) demand(c >= ' ' && c <= '~', "the message can be printed");
}

/// As assimp is shown it: whatever is done to the bytes, they stay those of a file of their length, roughly.
void look_into(void (*look)(AssimpInput*), std::string_view data, const std::string& name, const char* extension) {
  AssimpInput input{name, extension, {}, data.size(), {}, 0.0, {}};
  input.bytes.resize(data.size());
  std::memcpy(input.bytes.data(), data.data(), data.size());
  look(&input);
  demand(input.bytes.size() <= 2 * data.size() + 4096, "what assimp is shown is about as long as the file");
  demand(std::isfinite(input.unit_metres) && input.unit_metres >= 0.0, "the unit is a length");
}

/// A .3mf archive with this model, not packed and with the right check sums: mutations of packed bytes hardly ever
/// have.
std::string archive_of_model(std::string_view model) {
  const std::string relations =
      "<Relationships><Relationship Target=\"/3D/a.model\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
  return zipped({{"_rels/.rels", relations}, {"3D/a.model", std::string(model)}});
}

const std::string kName = "fuzz.bin";

void read_strictly(const std::string& extension, std::string_view data) {
  check_soup(strict_format(extension)->read(data, kName), data.size());
}

}  // namespace

void demand(bool holds, const char* what) {
  if (!holds) throw std::logic_error(std::string("broken: ") + what);
}

std::vector<FuzzFormat> fuzz_formats() {
  std::vector<FuzzFormat> formats;
  for (const StrictFormat& format : strict_formats()) {
    const std::string extension(format.extension);
    formats.push_back({extension.substr(1), [extension](std::string_view data) { read_strictly(extension, data); }});
  }
  formats.push_back({"gz", [](std::string_view data) {
                       demand(gunzip(data, kName).size() <= kMostInflation * data.size() + (std::size_t{1} << 20),
                              "nothing is unpacked to more than its share");
                     }});
  formats.push_back({"dae", [](std::string_view data) { look_into(look_into_collada, data, kName, ".dae"); }});
  formats.push_back({"gltf", [](std::string_view data) { look_into(look_into_gltf, data, kName, ".gltf"); }});
  formats.push_back({"glb", [](std::string_view data) { look_into(look_into_gltf, data, kName, ".glb"); }});
  formats.push_back({"amf", [](std::string_view data) { look_into(look_into_amf, data, kName, ".amf"); }});
  formats.push_back({"x3d", [](std::string_view data) { look_into(look_into_x3d, data, kName, ".x3d"); }});
  formats.push_back({"nff", [](std::string_view data) { look_into(look_into_nff, data, kName, ".nff"); }});
  formats.push_back({"ifc", [](std::string_view data) { look_into(look_into_ifc, data, kName, ".ifc"); }});
  formats.push_back({"3mf", [](std::string_view data) { look_into(look_into_3mf, data, kName, ".3mf"); }});
  formats.push_back(
      {"model", [](std::string_view data) { look_into(look_into_3mf, archive_of_model(data), kName, ".3mf"); }});
  return formats;
}

void read_as(const FuzzFormat& format, std::string_view data) {
  // A copy of its own, so that the address sanitizer sees a byte read beyond the end.
  const std::unique_ptr<char[]> bytes(new char[data.size()]);
  if (!data.empty()) std::memcpy(bytes.get(), data.data(), data.size());
  try {
    format.read({bytes.get(), data.size()});
  } catch (const InputError& error) {
    check_message(error.what(), kName);
  }
}

}  // namespace vex::tests
