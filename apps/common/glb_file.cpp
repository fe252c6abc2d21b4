#include "apps/common/glb_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "apps/common/run_program.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

// Little-endian, as glTF has numbers on every machine.
template <class Bits>
void append_bits(std::string& text, Bits bits) {
  for (std::size_t k = 0; k < sizeof bits; ++k) text += static_cast<char>(bits >> (8 * k) & 0xff);
}

void pad(std::string& text, char with) {
  while (text.size() % 4 != 0) text += with;
}

void append_chunk(std::string& text, const char* type, const std::string& content) {
  append_bits(text, static_cast<std::uint32_t>(content.size()));
  text.append(type, 4);
  text += content;
}

constexpr int kOfVertices = 34962, kOfIndices = 34963, kFloat = 5126, kShort = 5123, kInt = 5125;

}  // namespace

GlbFile::GlbFile() { document_["asset"] = {{"version", "2.0"}, {"generator", "vex_scene " + version()}}; }

std::size_t GlbFile::add(const char* key, Json entry) {
  document_[key].push_back(std::move(entry));
  return document_[key].size() - 1;
}

void GlbFile::require_room(std::size_t n_bytes) const {
  if (numbers_.size() + n_bytes <= kMostBytes) return;
  throw InputError("a scene too large for one .glb file (more than " + std::to_string(kMostBytes >> 20) +
                   " MiB, by the number of its shapes or of their vertices) - leave out --gltf, or show a part of it");
}

std::size_t GlbFile::add_view(std::size_t begin, int target) {
  Json view = {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", numbers_.size() - begin}};
  if (target != 0) view["target"] = target;
  pad(numbers_, '\0');
  return add("bufferViews", std::move(view));
}

std::size_t GlbFile::add_floats(std::span<const double> numbers, std::size_t n_columns, const char* type,
                                bool of_vertices) {
  require_room(4 * numbers.size());
  const std::size_t begin = numbers_.size();
  std::vector<double> least(n_columns, HUGE_VAL), most(n_columns, -HUGE_VAL);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const float rounded = static_cast<float>(numbers[k]) + 0.0F;  // no -0
    append_bits(numbers_, std::bit_cast<std::uint32_t>(rounded));
    least[k % n_columns] = std::min<double>(least[k % n_columns], rounded);
    most[k % n_columns] = std::max<double>(most[k % n_columns], rounded);
  }
  const std::size_t view = add_view(begin, of_vertices ? kOfVertices : 0);
  return add("accessors", {{"bufferView", view},
                           {"componentType", kFloat},
                           {"count", numbers.size() / n_columns},
                           {"type", type},
                           {"min", least},
                           {"max", most}});
}

std::size_t GlbFile::add_vectors(std::span<const Vec3d> vectors, bool of_vertices) {
  std::vector<double> numbers;
  numbers.reserve(3 * vectors.size());
  for (const Vec3d& v : vectors) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  return add_floats(numbers, 3, "VEC3", of_vertices);
}

std::size_t GlbFile::add_quaternions(std::span<const std::array<double, 4>> xyzw) {
  std::vector<double> numbers;
  numbers.reserve(4 * xyzw.size());
  for (const std::array<double, 4>& q : xyzw) numbers.insert(numbers.end(), q.begin(), q.end());
  return add_floats(numbers, 4, "VEC4", false);
}

std::size_t GlbFile::add_indices(std::span<const std::uint32_t> indices, std::size_t n_points) {
  const bool is_short = n_points < 0xffff;
  require_room((is_short ? 2 : 4) * indices.size());
  const std::size_t begin = numbers_.size();
  for (const std::uint32_t index : indices) {
    is_short ? append_bits(numbers_, static_cast<std::uint16_t>(index)) : append_bits(numbers_, index);
  }
  const std::size_t view = add_view(begin, kOfIndices);
  return add("accessors", {{"bufferView", view},
                           {"componentType", is_short ? kShort : kInt},
                           {"count", indices.size()},
                           {"type", "SCALAR"},
                           {"min", Json::array({std::ranges::min(indices)})},
                           {"max", Json::array({std::ranges::max(indices)})}});
}

std::string GlbFile::text() const {
  Json document = document_;
  if (!numbers_.empty()) document["buffers"].push_back({{"byteLength", numbers_.size()}});
  std::string json = document.dump();
  pad(json, ' ');
  constexpr std::size_t kHead = 12, kChunkHead = 8;
  const std::size_t size = kHead + kChunkHead + json.size() + (numbers_.empty() ? 0 : kChunkHead + numbers_.size());
  std::string text = "glTF";
  text.reserve(size);
  append_bits(text, std::uint32_t{2});
  append_bits(text, static_cast<std::uint32_t>(size));
  append_chunk(text, "JSON", json);
  if (!numbers_.empty()) append_chunk(text, std::string("BIN\0", 4).c_str(), numbers_);
  return text;
}

}  // namespace vex
