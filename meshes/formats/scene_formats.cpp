#include "meshes/formats/scene_formats.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "meshes/formats/coordinate_text.h"
#include "meshes/formats/gltf_json.h"
#include "meshes/formats/scene_parts.h"
#include "meshes/formats/xml_tags.h"
#include "meshes/length_unit.h"
#include "meshes/machine_memory.h"

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

/// assimp adds up fifteen decimals and leaves out the rest: of small numbers that is not rounding.
bool has_lost_decimals(std::string_view word) {
  constexpr std::size_t kRead = 15;
  const std::size_t point = word.find('.'), end = std::min(word.find_first_of("eE"), word.size());
  if (point == std::string_view::npos || end - point - 1 <= kRead) return false;
  const std::string read = std::string(word.substr(0, point + 1 + kRead)) + std::string(word.substr(end));
  return static_cast<float>(parse_decimal(read).value_or(0.0)) != static_cast<float>(parse_decimal(word).value_or(0.0));
}

/// What is not finite may stand among the texture's coordinates; among others it is refused later.
bool is_collada_number(std::string_view word) {
  if (is_decimal(word)) return !has_long_run(word) && !has_lost_decimals(word);
  const std::string_view digits = word.substr(word.starts_with('-') || word.starts_with('+') ? 1 : 0);
  return digits.find_first_of("nNiI") == 0;
}

/// assimp reads 1,5 as 1.5, 1.0D+01 as 1, 5-3 as two numbers, and the index -1 as 0.
std::size_t check_numbers(const XmlTag& tag, std::string_view text, const AssimpInput& input) {
  std::size_t n_words = 0;
  const bool are_indices = tag.name == "p" || tag.name == "vcount";
  for (std::string_view word; !(word = take_word(text)).empty();) {
    if (are_indices ? !is_index(word) : !is_collada_number(word)) {
      const std::string problem = are_indices        ? " is not " + std::string(kIndex.name)
                                  : is_decimal(word) ? " has more digits than assimp reads"
                                                     : " is no decimal number";
      refuse_scene(input, shown(word) + problem, "in " + shown_name(tag.name), "mend the file");
    }
    ++n_words;
  }
  return n_words;
}

/// assimp takes memory by one count, and fills it by another: what a count promises must be there.
class ColladaCounts {
 public:
  explicit ColladaCounts(const AssimpInput& input) : input_(input) {}

  void note_array(const XmlTag& tag, std::size_t n_words) {
    if (whole(tag, "count", n_words + 1) != n_words) {
      refuse_scene(input_, "a count does not hold", std::to_string(n_words) + " numbers in " + shown_tag(tag),
                   "mend the file");
    }
    sizes_[std::string(tag.attribute("id").value_or(""))] = n_words;
  }
  void note_accessor(const XmlTag& tag) {
    const std::size_t count = whole(tag, "count", 0), stride = whole(tag, "stride", 1),
                      offset = whole(tag, "offset", 0);
    std::string_view source = tag.attribute("source").value_or("");
    if (source.starts_with('#')) source.remove_prefix(1);
    accessors_.push_back({std::string(source), shown_tag(tag), count, stride, offset});
  }
  void check() const {
    for (const Accessor& accessor : accessors_) {
      const auto size = sizes_.find(accessor.source);
      if (size == sizes_.end()) continue;  // of names
      const bool is_there = accessor.offset <= size->second && accessor.stride > 0 &&
                            accessor.count <= (size->second - accessor.offset) / accessor.stride;
      if (!is_there) {
        refuse_scene(input_, "a count does not hold", std::to_string(size->second) + " numbers for " + accessor.shown,
                     "mend the file");
      }
    }
  }

 private:
  struct Accessor {
    std::string source, shown;
    std::size_t count, stride, offset;
  };

  std::size_t whole(const XmlTag& tag, std::string_view name, std::size_t otherwise) const {
    const std::optional<std::string_view> text = tag.attribute(name);
    if (!text) return otherwise;
    if (!is_index(*text)) {
      refuse_scene(input_, shown(*text) + " is not " + std::string(kIndex.name), "in " + shown_tag(tag),
                   "mend the file");
    }
    return static_cast<std::size_t>(parse_decimal(*text).value_or(0.0));
  }

  const AssimpInput& input_;
  std::map<std::string, std::size_t> sizes_;
  std::vector<Accessor> accessors_;
};

/// assimp leaves out an instance of what is not in the file, or is a node within another one; of two geometries of one
/// id one; and takes a node of that name, or the last of that id, for the one that is meant.
class ColladaReferences {
 public:
  explicit ColladaReferences(const AssimpInput& input) : input_(input) {}

  /// `is_of_library`: itself, not within another node.
  void note(const XmlTag& tag, bool is_of_library) {
    const std::string_view id = tag.attribute("id").value_or("");
    if (tag.name == "instance_geometry") geometry_uses_.push_back(tag);
    if (tag.name == "instance_node") node_uses_.push_back(tag);
    if (tag.name == "geometry" && !id.empty() && !geometries_.insert(id).second) {
      refuse_scene(input_, "two geometries have the same id", shown_tag(tag), kMendOrConvert);
    }
    if (tag.name != "node") return;
    const bool is_known = is_of_library && library_.insert(id).second;
    if (!is_known) others_.insert(id);
    const std::string_view name = tag.attribute("name").value_or("");
    if (name != id) others_.insert(name);
  }
  void check() const {
    for (const XmlTag& use : geometry_uses_) require(geometries_.contains(named_by(use)), use);
    for (const XmlTag& use : node_uses_) {
      require(library_.contains(named_by(use)) && !others_.contains(named_by(use)), use);
    }
  }

 private:
  using Names = std::set<std::string_view>;
  static constexpr const char* kMendOrConvert = "mend the file, or export it as .obj, .ply or .stl";

  /// Empty where it is not in this file.
  static std::string_view named_by(const XmlTag& use) {
    const std::string_view url = use.attribute("url").value_or("");
    return url.starts_with('#') ? url.substr(1) : std::string_view();
  }
  void require(bool is_found, const XmlTag& use) const {
    if (is_found && !named_by(use).empty()) return;
    refuse_scene(input_, "what a node shows is not in the file, or not in its libraries once", shown_tag(use),
                 kMendOrConvert);
  }

  const AssimpInput& input_;
  Names geometries_, library_, others_;  // others_: ids and names of nodes that a use must not be taken for
  std::vector<XmlTag> geometry_uses_, node_uses_;
};

/// assimp passes over numbers behind those that a transform has.
void check_transform_size(const XmlTag& tag, std::size_t n_numbers, const AssimpInput& input) {
  struct Size {
    std::string_view name;
    std::size_t n;
  };
  constexpr std::array<Size, 5> kSizes{{{"matrix", 16}, {"translate", 3}, {"rotate", 4}, {"scale", 3}, {"lookat", 9}}};
  const auto* const size = std::ranges::find(kSizes, tag.name, &Size::name);
  if (size == kSizes.end() || size->n == n_numbers) return;
  refuse_scene(input, "a transform has " + std::to_string(n_numbers) + " numbers",
               shown_name(tag.name) + ": expected " + std::to_string(size->n), "mend the file");
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
  ColladaCounts counts(*input);
  ColladaReferences references(*input);
  XmlTags tags(input->bytes.view());
  std::vector<std::string_view> path;  // the outer three levels; those below are only counted
  std::size_t depth = 0;
  while (const std::optional<XmlTag> tag = tags.next()) {
    if (tag->is_closing) {
      if (depth > 0 && --depth < path.size()) path.resize(depth);
      continue;
    }
    references.note(*tag, depth == 2 && path[1] == "library_nodes");
    if (depth == 2 && path[0] == "COLLADA" && path[1] == "asset" && tag->name == "unit") {
      take_collada_unit(*tag, input);
    } else if (tag->name == "skew") {
      refuse_scene(*input, "a node is skewed, which is not read", "<skew>", "export it as .stl, .ply or .obj");
    } else if (tag->name == "instance_controller") {
      refuse_scene(*input, "the points are moved by a skin or by morphing, which is not read", "<instance_controller>",
                   "apply it and export the mesh as it stands, or as .obj, .ply or .stl");
    } else if (tag->name == "accessor") {
      counts.note_accessor(*tag);
    } else if (std::ranges::find(kHoldNumbers, tag->name) != kHoldNumbers.end()) {
      const std::size_t n_words = check_numbers(*tag, tags.text_behind(), *input);
      if (tag->name == "float_array") counts.note_array(*tag, n_words);
      if (path.size() > 1 && (path[1] == "library_visual_scenes" || path[1] == "library_nodes")) {
        check_transform_size(*tag, n_words, *input);
        if (tag->name == "rotate") check_axes(*input, tags.text_behind(), shown_name(tag->name));
      }
    }
    if (tag->is_empty) continue;
    if (depth < 3) path.push_back(tag->name);
    ++depth;
  }
  counts.check();
  references.check();
}

// --- glTF

namespace {

[[noreturn]] void refuse_buffer(const AssimpInput& input, const std::string& uri) {
  refuse_scene(
      input, "a buffer of the mesh cannot be read",
      shown(uri) + ", which must be a .bin file in the folder of the .gltf file or below, by no link out of it",
      "put it there, or export a .glb");
}

/// Reads each file once, so that a document which names it a thousand times takes no more memory, and no more time.
void take_buffers(const std::vector<std::string>& uris, AssimpInput* input) {
  GltfBuffers& buffers = input->buffers;
  std::map<std::pair<::dev_t, ::ino_t>, std::size_t> of_file;
  for (const std::string& uri : uris) {
    if (buffers.by_uri.contains(uri)) continue;
    const std::optional<BufferFile> buffer = gltf_buffer_beside(input->path, uri);
    const std::optional<FileStamp> stamp = buffer ? file_stamp(buffer->file) : std::nullopt;
    if (!stamp) refuse_buffer(*input, uri);
    const auto [held, is_new] = of_file.try_emplace({stamp->device, stamp->number}, buffers.files.size());
    if (is_new) {
      const std::uint64_t so_far = input->n_geometry_bytes, size = static_cast<std::uint64_t>(stamp->size);
      if (size <= most_file_bytes() && so_far + size > most_file_bytes()) {  // too large alone: reading it says so
        refuse_scene(*input, "the mesh is too large for this machine",
                     std::to_string(so_far / kMiB) + " MiB and then " + shown(uri), "simplify it");
      }
      buffers.files.push_back(read_file_bytes(buffer->file, buffer->path));
      input->n_geometry_bytes += buffers.files.back().size();
    }
    buffers.by_uri.emplace(uri, held->second);
  }
}

}  // namespace

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
  if (summary->misread_accessor) {
    refuse_scene(
        *input,
        "a mesh's positions are no 32-bit floats in threes, its indices no unsigned numbers, or not within the buffer",
        *summary->misread_accessor, "export it with plain positions, or as .obj, .ply or .stl");
  }
  if (!summary->unread.empty()) {
    refuse_scene(*input, "the points are moved or repeated in a way that is not read", summary->unread,
                 "apply it and export the mesh as it stands, or as .obj, .ply or .stl");
  }
  if (is_binary && !summary->buffer_uris.empty()) refuse_buffer(*input, summary->buffer_uris.front());
  take_buffers(summary->buffer_uris, input);
  set_unit(LengthUnit{"m", 1.0}, input);
}

}  // namespace vex
