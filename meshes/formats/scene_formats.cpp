#include "meshes/formats/scene_formats.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "meshes/formats/coordinate_text.h"
#include "meshes/formats/gltf_json.h"
#include "meshes/formats/text_scanner.h"
#include "meshes/formats/xml_tags.h"
#include "meshes/formats/zip_archive.h"
#include "meshes/length_unit.h"

namespace vex {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

/// Without the blanks before it.
std::string_view from_word(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(kBlanks), text.size()));
}

std::string shown(std::string_view word) { return quoted(word); }  // of a std::string, std::quoted would be taken

[[noreturn]] void refuse(const AssimpInput& input, const std::string& problem, const std::string& where,
                         const std::string& advice) {
  throw InputError(problem + " (" + input.path.string() + ": " + where + ") - " + advice);
}

/// The first tag that is no closing one.
std::optional<XmlTag> first_tag(std::string_view text) {
  XmlTags tags(text);
  std::optional<XmlTag> tag = tags.next();
  while (tag && tag->is_closing) tag = tags.next();
  return tag;
}

void set_unit(const std::optional<LengthUnit>& unit, AssimpInput* input) {
  if (!unit) return;
  input->unit = unit->name;
  input->unit_metres = unit->metres;
}

// --- COLLADA

/// Takes the unit of <unit>, and shows assimp 1 in its place.
void take_collada_unit(const XmlTag& tag, AssimpInput* input) {
  const std::string_view metres_text = tag.attribute("meter").value_or("1");
  const std::optional<double> metres = parse_decimal(metres_text);
  const std::optional<LengthUnit> unit = stated_length_unit(tag.attribute("name").value_or(""), metres.value_or(0.0));
  if (!unit) {
    refuse(*input, "the unit of length is no positive number of metres", "<unit meter=" + shown(metres_text) + ">",
           "mend the file");
  }
  if (!input->unit.empty() && input->unit_metres != unit->metres) {
    refuse(*input, "the file states two units of length", input->unit + " and " + unit->name, "mend the file");
  }
  set_unit(unit, input);
  if (tag.attribute("meter")) {
    char* const value = input->bytes.data() + (metres_text.data() - input->bytes.view().data());
    std::fill_n(value, metres_text.size(), ' ');
    *value = '1';
  }
}

/// Which characters decimal numbers and the blanks between them consist of.
constexpr std::array<bool, 256> kOfNumbers = [] {
  std::array<bool, 256> table{};
  for (const char c : std::string_view("0123456789+-.eE \t\r\n")) table[static_cast<unsigned char>(c)] = true;
  return table;
}();

/// assimp reads 1,5 as 1.5 and 1.0D+01 as 1. What is not finite may stand among the texture's coordinates.
void check_numbers(const XmlTag& tag, std::string_view text, const AssimpInput& input) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (kOfNumbers[static_cast<unsigned char>(text[at])]) continue;
    const std::size_t before = text.find_last_of(kBlanks, at);
    const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    const std::string_view digits = word.substr(word.starts_with('-') || word.starts_with('+') ? 1 : 0);
    if (digits.find_first_of("nNiI") != 0) {
      refuse(input, shown(word) + " is no decimal number", "in <" + std::string(tag.name) + ">", "mend the file");
    }
    at = end;
  }
}

}  // namespace

void look_into_collada(AssimpInput* input) {
  constexpr std::array<std::string_view, 6> kHoldNumbers{"float_array", "matrix", "translate", "rotate", "scale", "p"};
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
    } else if (std::ranges::find(kHoldNumbers, tag->name) != kHoldNumbers.end()) {
      check_numbers(*tag, tags.text_behind(), *input);
    }
    if (tag->is_empty) continue;
    if (depth < 3) path.push_back(tag->name);
    ++depth;
  }
}

// --- 3MF

namespace {

constexpr std::uint64_t kMostTimes = 64;  // XML of meshes packs into a tenth; a list may promise anything

/// Which of the archive's files is the model: the one that the archive's relations name.
const ZipEntry* model_of(std::string_view archive, const std::vector<ZipEntry>& entries) {
  const auto named = [&entries](std::string_view name) {
    const auto found = std::ranges::find(entries, name, &ZipEntry::name);
    return found == entries.end() ? nullptr : &*found;
  };
  const ZipEntry* const relations = named("_rels/.rels");
  constexpr std::size_t kMost = std::size_t{1} << 20U;
  const std::optional<std::string> text = relations ? zip_contents(archive, *relations, kMost) : std::nullopt;
  if (!text) return nullptr;
  XmlTags tags(*text);
  while (const std::optional<XmlTag> tag = tags.next()) {
    if (tag->attribute("Type") == "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel") {
      std::string_view target = tag->attribute("Target").value_or("");
      target.remove_prefix(std::min(target.find_first_not_of('/'), target.size()));
      return named(target);
    }
  }
  return nullptr;
}

/// All of a part that holds a model, unpacked.
std::string model_text(const ZipEntry& part, const AssimpInput& input) {
  constexpr std::uint64_t kMiB = std::uint64_t{1} << 20U;
  const std::uint64_t most = std::min(kMostTimes * input.bytes.size() + kMiB, most_file_bytes());
  std::optional<std::string> text = zip_contents(input.bytes.view(), part, static_cast<std::size_t>(most) + 1);
  if (!text || text->size() > most) {
    refuse(input, "the model is damaged, or unpacks to more than a model does", shown(part.name),
           "fetch or export it again");
  }
  return *std::move(text);
}

bool is_decimal(std::string_view text) { return parse_decimal(text).has_value(); }

bool is_index(std::string_view text) {
  std::int32_t number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && stop == text.data() + text.size() && number >= 0;
}

bool is_transform(std::string_view text) {
  std::size_t n_numbers = 0;
  for (text = from_word(text); !text.empty(); text = from_word(text)) {
    const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
    if (!is_decimal(word)) return false;
    ++n_numbers;
    text.remove_prefix(word.size());
  }
  return n_numbers == 12;
}

struct NumberKind {
  const char* name;
  bool (*holds)(std::string_view text);
};
constexpr NumberKind kDecimal{"a decimal number", is_decimal};
constexpr NumberKind kIndex{"a whole number from 0 to 2147483647", is_index};
constexpr NumberKind kTransform{"twelve decimal numbers", is_transform};

/// assimp takes 0,5 and 1x as far as they are numbers, what is none or missing for 0, and an item that names no object
/// for nothing.
void check_model(const ZipEntry& part, std::string_view text, bool is_only_part, const AssimpInput& input) {
  const auto check = [&](const XmlTag& tag, const char* attribute, const NumberKind& kind) {
    const std::optional<std::string_view> value = tag.attribute(attribute);
    if (value && kind.holds(*value)) return;
    refuse(input, value ? shown(*value) + " is not " + kind.name : std::string("a number is missing"),
           std::string(attribute) + " of " + shown("<" + std::string(tag.name) + std::string(tag.attributes) + ">") +
               " in " + shown(part.name) + ": expected " + kind.name,
           "mend the file");
  };
  XmlTags tags(text);
  while (const std::optional<XmlTag> tag = tags.next()) {
    if (tag->is_closing) continue;
    if (tag->name == "vertex") {
      for (const char* attribute : {"x", "y", "z"}) check(*tag, attribute, kDecimal);
    } else if (tag->name == "triangle") {
      for (const char* attribute : {"v1", "v2", "v3"}) check(*tag, attribute, kIndex);
    } else if (tag->name == "object") {
      check(*tag, "id", kIndex);
    } else if (tag->name == "component" || tag->name == "item") {
      if (!is_only_part && tag->attributes.find(":path") != std::string_view::npos) {
        refuse(input, "the model's parts lie in several files of the archive",
               "<" + std::string(tag->name) + "> of " + part.name, "export it as .stl, .ply or .obj");
      }
      check(*tag, "objectid", kIndex);
      if (tag->attribute("transform")) check(*tag, "transform", kTransform);
    }
  }
}

/// Required extensions go by prefixes, which the model's tag explains.
void check_extensions(const XmlTag& model, const AssimpInput& input) {
  std::string_view rest = model.attribute("requiredextensions").value_or("");
  while (!rest.empty()) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
    const std::string_view prefix = rest.substr(0, std::min(rest.find_first_of(kBlanks), rest.size()));
    rest.remove_prefix(prefix.size());
    if (prefix.empty()) continue;
    const std::string_view space = model.attribute("xmlns:" + std::string(prefix)).value_or(prefix);
    // Of "production" a part elsewhere matters, and is looked for on its own.
    if (space.find("/material/") == std::string_view::npos && space.find("/production/") == std::string_view::npos) {
      refuse(input, "the model requires an extension of 3MF that is not read", shown(space),
             "export it as .stl, .ply or .obj");
    }
  }
}

}  // namespace

void look_into_3mf(AssimpInput* input) {
  const std::string_view archive = input->bytes.view();
  const std::optional<std::vector<ZipEntry>> entries = zip_entries(archive);
  const ZipEntry* const model = entries ? model_of(archive, *entries) : nullptr;
  const std::string text = model ? model_text(*model, *input) : "";
  const std::optional<XmlTag> tag = first_tag(text);
  if (!tag || tag->name != "model") {
    refuse(*input, "the file is no 3MF archive, or is damaged",
           !entries ? "no list of a zip archive" : "no model in it", "fetch or export it again");
  }
  check_extensions(*tag, *input);
  const std::string_view unit = tag->attribute("unit").value_or("millimeter");
  set_unit(parse_length_unit(unit), input);
  if (input->unit.empty()) refuse(*input, "the model's unit of length is unknown", shown(unit), "mend the file");

  const std::uint64_t most = kMostTimes * archive.size();
  std::size_t n_models = 0;
  for (const ZipEntry& entry : *entries) {
    const std::string extension = lower_extension(entry.name);
    if (extension == ".model") {
      ++n_models;
      input->n_geometry_bytes = std::min(most, input->n_geometry_bytes + std::min(most, entry.size));
    } else if (extension == ".png" || extension == ".jpg") {
      input->bytes.data()[entry.name_at + entry.name.size() - 1] = '_';
    }
  }
  check_model(*model, text, n_models <= 1, *input);
  for (const ZipEntry& entry : *entries) {
    if (&entry == model || lower_extension(entry.name) != ".model") continue;
    check_model(entry, model_text(entry, *input), false, *input);
  }
}

// --- glTF and AMF

void look_into_gltf(AssimpInput* input) {
  const bool is_binary = input->extension == ".glb";
  const std::string_view bytes = input->bytes.view();
  const std::optional<std::string_view> document = is_binary ? glb_document(bytes) : std::optional(bytes);
  const std::optional<GltfSummary> summary = document ? gltf_summary(*document) : std::nullopt;
  if (!summary) {
    refuse(*input, is_binary ? "the file is no binary glTF 2, or is damaged" : "the file is no JSON, or is damaged",
           "its beginning is " + shown(bytes.substr(0, 12)), "fetch or export it again");
  }
  if (!summary->version.starts_with('2')) {
    refuse(*input, "the file is glTF of a version that is not read", "version " + shown(summary->version) + ", not 2",
           "convert it to glTF 2, .obj, .ply or .stl");
  }
  constexpr std::array<std::string_view, 5> kHarmless{"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_",
                                                      "KHR_xmp"};
  for (const std::string& extension : summary->required_extensions) {
    const bool is_harmless =
        std::ranges::any_of(kHarmless, [&extension](std::string_view prefix) { return extension.starts_with(prefix); });
    if (!is_harmless && extension != "KHR_draco_mesh_compression" && extension != "MSFT_texture_dds") {
      refuse(*input, "the file requires an extension of glTF that is not read", shown(extension),
             "export it without, or as .obj, .ply or .stl");
    }
  }
  for (const std::string& uri : summary->buffer_uris) {
    const std::optional<std::filesystem::path> buffer = gltf_buffer_beside(input->path, uri);
    if (!buffer || is_binary) {
      refuse(*input, "a buffer of the mesh cannot be read",
             shown(uri) + ", which must be a .bin file in the folder of the .gltf file or below",
             "put it there, or export a .glb");
    }
    input->n_geometry_bytes += checked_file_size(*buffer);
    input->buffers.push_back(*buffer);
  }
  set_unit(LengthUnit{"m", 1.0}, input);
}

void look_into_amf(AssimpInput* input) {
  const std::optional<XmlTag> tag = first_tag(input->bytes.view());
  if (tag && tag->name == "amf") set_unit(parse_length_unit(tag->attribute("unit").value_or("millimeter")), input);
}

}  // namespace vex
