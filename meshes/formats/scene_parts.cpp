#include "meshes/formats/scene_parts.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <system_error>

#include "engine/numeric/errors.h"
#include "meshes/formats/coordinate_text.h"
#include "meshes/formats/text_scanner.h"

namespace vex {

void refuse_scene(const AssimpInput& input, const std::string& problem, const std::string& where,
                  const std::string& advice) {
  throw InputError(problem + " (" + input.path.string() + ": " + where + ") - " + advice);
}

void set_unit(const std::optional<LengthUnit>& unit, AssimpInput* input) {
  if (!unit) return;
  input->unit = unit->name;
  input->unit_metres = unit->metres;
}

std::optional<XmlTag> first_tag(std::string_view text) {
  XmlTags tags(text);
  std::optional<XmlTag> tag = tags.next();
  while (tag && tag->is_closing) tag = tags.next();
  return tag;
}

std::string shown(std::string_view word) { return quoted(word); }

std::string shown_tag(const XmlTag& tag) {
  return shown("<" + std::string(tag.name) + std::string(tag.attributes) + ">");
}

std::string shown_name(std::string_view name) { return "<" + printable_word(name) + ">"; }

std::string_view from_word(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(kXmlBlanks), text.size()));
}

std::string_view first_word(std::string_view text) { return text.substr(0, text.find_first_of(kXmlBlanks)); }

bool is_decimal(std::string_view text) { return parse_decimal(text).has_value(); }

bool is_index(std::string_view text) {
  std::int32_t number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && stop == text.data() + text.size() && number >= 0;
}

}  // namespace vex
