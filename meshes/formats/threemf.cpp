#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "meshes/formats/scene_formats.h"
#include "meshes/formats/scene_parts.h"
#include "meshes/formats/xml_tags.h"
#include "meshes/formats/zip_archive.h"
#include "meshes/length_unit.h"
#include "meshes/machine_memory.h"

namespace vex {
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
  const std::uint64_t most = std::min(kMostTimes * input.bytes.size() + kMiB, most_file_bytes());
  std::optional<std::string> text = zip_contents(input.bytes.view(), part, static_cast<std::size_t>(most) + 1);
  if (!text || text->size() > most) {
    refuse_scene(input, "the model is damaged, or unpacks to more than a model does", shown(part.name),
                 "fetch or export it again");
  }
  return *std::move(text);
}

bool is_transform(std::string_view text) {
  std::size_t n_numbers = 0;
  for (std::string_view word; !(word = take_word(text)).empty(); ++n_numbers) {
    if (!is_decimal(word)) return false;
  }
  return n_numbers == 12;
}

constexpr NumberKind kTransform{"twelve decimal numbers", is_transform};

/// The objects of a part, and what its items and components say of them.
class ObjectIds {
 public:
  ObjectIds(const ZipEntry& part, const AssimpInput& input) : part_(part), input_(input) {}

  /// Of the resources that assimp keeps, it keeps the first of each number.
  void add(const XmlTag& tag, std::string_view id) {
    const std::int32_t number = number_of(id);
    if (!taken_.insert(number).second) refuse("two resources have the same number", tag, "mend the file");
    if (tag.name == "object") objects_.insert(number);
  }
  /// The object may yet come.
  void note_use(const XmlTag& tag, std::string_view id) { uses_.emplace_back(number_of(id), tag); }
  void check_uses() const {
    for (const auto& [number, tag] : uses_) {
      if (!objects_.contains(number)) {
        refuse("no object has the number that the model asks for", tag, "mend the file, or export it again");
      }
    }
  }

 private:
  /// 01 is 1.
  static std::int32_t number_of(std::string_view id) {
    std::int32_t number = -1;
    std::from_chars(id.data(), id.data() + id.size(), number);
    return number;
  }
  [[noreturn]] void refuse(const std::string& problem, const XmlTag& tag, const std::string& advice) const {
    refuse_scene(input_, problem, shown_tag(tag) + " in " + shown(part_.name), advice);
  }

  const ZipEntry& part_;
  const AssimpInput& input_;
  std::set<std::int32_t> taken_, objects_;
  std::vector<std::pair<std::int32_t, XmlTag>> uses_;
};

/// assimp takes 0,5 and 1x as far as they are numbers, what is none or missing for 0, an item or component that names
/// no object for nothing, and passes over a second list of objects or of items.
void check_model(const ZipEntry& part, std::string_view text, bool is_only_part, const AssimpInput& input) {
  const auto check = [&](const XmlTag& tag, const char* attribute, const NumberKind& kind) {
    const std::optional<std::string_view> value = tag.attribute(attribute);
    if (value && kind.holds(*value)) return *value;
    refuse_scene(
        input, value ? shown(*value) + " is not " + kind.name : std::string("a number is missing"),
        std::string(attribute) + " of " + shown_tag(tag) + " in " + shown(part.name) + ": expected " + kind.name,
        "mend the file");
  };
  ObjectIds ids(part, input);
  std::size_t n_resources = 0, n_builds = 0;
  XmlTags tags(text);
  while (const std::optional<XmlTag> tag = tags.next()) {
    if (tag->is_closing) continue;
    if (tag->name == "vertex") {
      for (const char* attribute : {"x", "y", "z"}) check(*tag, attribute, kDecimal);
    } else if (tag->name == "triangle") {
      for (const char* attribute : {"v1", "v2", "v3"}) check(*tag, attribute, kIndex);
    } else if (tag->name == "object" || tag->name == "basematerials" || tag->name == "m:texture2dgroup") {
      ids.add(*tag, check(*tag, "id", kIndex));
    } else if (tag->name == "component" || tag->name == "item") {
      if (!is_only_part && tag->attributes.find(":path") != std::string_view::npos) {
        refuse_scene(input, "the model's parts lie in several files of the archive",
                     shown_name(tag->name) + " of " + shown(part.name), "export it as .stl, .ply or .obj");
      }
      ids.note_use(*tag, check(*tag, "objectid", kIndex));
      if (tag->attribute("transform")) check(*tag, "transform", kTransform);
    } else if ((tag->name == "resources" && ++n_resources > 1) || (tag->name == "build" && ++n_builds > 1)) {
      refuse_scene(input, "the model has two of what it may have one of",
                   shown_name(tag->name) + " in " + shown(part.name), "mend the file");
    }
  }
  ids.check_uses();
}

/// Required extensions go by prefixes, which the model's tag explains.
void check_extensions(const XmlTag& model, const AssimpInput& input) {
  std::string_view rest = model.attribute("requiredextensions").value_or("");
  while (!rest.empty()) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kXmlBlanks), rest.size()));
    const std::string_view prefix = rest.substr(0, std::min(rest.find_first_of(kXmlBlanks), rest.size()));
    rest.remove_prefix(prefix.size());
    if (prefix.empty()) continue;
    const std::string_view space = model.attribute("xmlns:" + std::string(prefix)).value_or(prefix);
    // Of "production" a part elsewhere matters, and is looked for on its own.
    if (space.find("/material/") == std::string_view::npos && space.find("/production/") == std::string_view::npos) {
      refuse_scene(input, "the model requires an extension of 3MF that is not read", shown(space),
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
    refuse_scene(*input, "the file is no 3MF archive, or is damaged",
                 !entries ? "no list of a zip archive" : "no model in it", "fetch or export it again");
  }
  check_extensions(*tag, *input);
  const std::string_view unit = tag->attribute("unit").value_or("millimeter");
  set_unit(parse_length_unit(unit), input);
  if (input->unit.empty()) refuse_scene(*input, "the model's unit of length is unknown", shown(unit), "mend the file");

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

}  // namespace vex
