#include "meshes/formats/scene_formats.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "meshes/formats/coordinate_text.h"
#include "meshes/formats/gltf_json.h"
#include "meshes/formats/scene_parts.h"
#include "meshes/formats/xml_tags.h"
#include "meshes/length_unit.h"

namespace vex {
namespace {

// --- COLLADA

/// Takes the unit of <unit>, and shows assimp 1 in its place.
void take_collada_unit(const XmlTag& tag, AssimpInput* input) {
  const std::string_view metres_text = tag.attribute("meter").value_or("1");
  const std::optional<double> metres = parse_decimal(metres_text);
  const std::optional<LengthUnit> unit = stated_length_unit(tag.attribute("name").value_or(""), metres.value_or(0.0));
  if (!unit) {
    refuse_scene(*input, "the unit of length is no positive number of metres",
                 "<unit meter=" + shown(metres_text) + ">", "mend the file");
  }
  if (!input->unit.empty() && input->unit_metres != unit->metres) {
    refuse_scene(*input, "the file states two units of length", input->unit + " and " + unit->name, "mend the file");
  }
  set_unit(unit, input);
  if (tag.attribute("meter")) {
    char* const value = input->bytes.data() + (metres_text.data() - input->bytes.view().data());
    std::fill_n(value, metres_text.size(), ' ');
    *value = '1';
  }
}

/// assimp adds up digits in 64 bits: what does not fit, twenty of them or more, is 0 to it, or what is left of it.
bool has_long_run(std::string_view word) {
  constexpr std::size_t kTooMany = 19;
  std::size_t n_digits = 0;
  bool is_behind_point = false;  // where assimp stops at fifteen
  for (const char c : word) {
    n_digits = c >= '0' && c <= '9' ? n_digits + 1 : 0;
    if (c == '.') is_behind_point = true;
    if (c == 'e' || c == 'E') is_behind_point = false;
    if (n_digits >= kTooMany && !is_behind_point) return true;
  }
  return false;
}

/// What is not finite may stand among the texture's coordinates; among others it is refused later.
bool is_collada_number(std::string_view word) {
  if (is_decimal(word)) return !has_long_run(word);
  const std::string_view digits = word.substr(word.starts_with('-') || word.starts_with('+') ? 1 : 0);
  return digits.find_first_of("nNiI") == 0;
}

/// assimp reads 1,5 as 1.5, 1.0D+01 as 1, 5-3 as two numbers, and the index -1 as 0.
void check_numbers(const XmlTag& tag, std::string_view text, const AssimpInput& input) {
  const bool are_indices = tag.name == "p" || tag.name == "vcount";
  for (text = from_word(text); !text.empty(); text = from_word(text)) {
    const std::string_view word = first_word(text);
    if (are_indices ? !is_index(word) : !is_collada_number(word)) {
      const std::string problem = are_indices        ? " is not " + std::string(kIndex.name)
                                  : is_decimal(word) ? " has more digits than assimp reads"
                                                     : " is no decimal number";
      refuse_scene(input, shown(word) + problem, "in <" + std::string(tag.name) + ">", "mend the file");
    }
    text.remove_prefix(word.size());
  }
}

}  // namespace

void look_into_collada(AssimpInput* input) {
  const std::optional<XmlTag> root = first_tag(input->bytes.view());
  if (!root || root->name != "COLLADA") {
    refuse_scene(*input, "the file is no COLLADA scene in UTF-8, or is damaged", "it does not begin with <COLLADA>",
                 "fetch or export it again");
  }
  constexpr std::array<std::string_view, 8> kHoldNumbers{"float_array", "matrix", "translate", "rotate",
                                                         "scale",       "lookat", "p",         "vcount"};
  XmlTags tags(input->bytes.view());
  std::vector<std::string_view> path;  // the outer three levels; those below are only counted
  std::size_t depth = 0;
  while (const std::optional<XmlTag> tag = tags.next()) {
    if (tag->is_closing) {
      if (depth > 0 && --depth < path.size()) path.resize(depth);
      continue;
    }
    if (depth == 2 && path[0] == "COLLADA" && path[1] == "asset" && tag->name == "unit") {
      take_collada_unit(*tag, input);
    } else if (tag->name == "skew") {
      refuse_scene(*input, "a node is skewed, which is not read", "<skew>", "export it as .stl, .ply or .obj");
    } else if (std::ranges::find(kHoldNumbers, tag->name) != kHoldNumbers.end()) {
      check_numbers(*tag, tags.text_behind(), *input);
    }
    if (tag->is_empty) continue;
    if (depth < 3) path.push_back(tag->name);
    ++depth;
  }
}

// --- glTF

void look_into_gltf(AssimpInput* input) {
  const bool is_binary = input->extension == ".glb";
  const std::string_view bytes = input->bytes.view();
  const std::optional<std::string_view> document = is_binary ? glb_document(bytes) : std::optional(bytes);
  const std::optional<GltfSummary> summary = document ? gltf_summary(*document) : std::nullopt;
  if (!summary) {
    refuse_scene(*input,
                 is_binary ? "the file is no binary glTF 2, or is damaged" : "the file is no JSON, or is damaged",
                 "its beginning is " + shown(bytes.substr(0, 12)), "fetch or export it again");
  }
  if (!summary->version.starts_with('2')) {
    refuse_scene(*input, "the file is glTF of a version that is not read",
                 "version " + shown(summary->version) + ", not 2", "convert it to glTF 2, .obj, .ply or .stl");
  }
  constexpr std::array<std::string_view, 5> kHarmless{"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_",
                                                      "KHR_xmp"};
  for (const std::string& extension : summary->required_extensions) {
    const bool is_harmless =
        std::ranges::any_of(kHarmless, [&extension](std::string_view prefix) { return extension.starts_with(prefix); });
    if (!is_harmless && extension != "KHR_draco_mesh_compression" && extension != "MSFT_texture_dds") {
      refuse_scene(*input, "the file requires an extension of glTF that is not read", shown(extension),
                   "export it without, or as .obj, .ply or .stl");
    }
  }
  for (const std::string& uri : summary->buffer_uris) {
    const std::optional<std::filesystem::path> buffer = gltf_buffer_beside(input->path, uri);
    if (!buffer || is_binary) {
      refuse_scene(*input, "a buffer of the mesh cannot be read",
                   shown(uri) + ", which must be a .bin file in the folder of the .gltf file or below",
                   "put it there, or export a .glb");
    }
    input->n_geometry_bytes += checked_file_size(*buffer);
    input->buffers.push_back(*buffer);
  }
  set_unit(LengthUnit{"m", 1.0}, input);
}

}  // namespace vex
