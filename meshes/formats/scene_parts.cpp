#include "meshes/formats/scene_parts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <span>
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

std::string_view take_word(std::string_view& text) {
  const std::string_view rest = from_word(text), word = rest.substr(0, rest.find_first_of(kXmlBlanks));
  text = rest.substr(word.size());
  return word;
}

bool is_decimal(std::string_view text) { return parse_decimal(text).has_value(); }

bool is_index(std::string_view text) {
  std::int32_t number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && stop == text.data() + text.size() && number >= 0;
}

void check_unit_length(const AssimpInput& input, std::span<const double> direction, const std::string& where) {
  constexpr double kTolerance = 4e-6;
  double square = 0.0;
  for (const double x : direction) square += x * x;
  if (std::fabs(square - 1.0) <= kTolerance) return;
  refuse_scene(input, "a rotation whose axis or quaternion is not of length 1", where,
               "write it with seven digits or more, or export it as .stl, .ply or .obj");
}

void check_axes(const AssimpInput& input, std::string_view numbers, const std::string& where) {
  std::array<double, 4> turn{};
  std::size_t n = 0;
  for (std::string_view word; !(word = take_word(numbers)).empty();) {
    if (word.ends_with(',')) word.remove_suffix(1);
    turn[n++ % 4] = parse_decimal(word).value_or(0.0);
    if (n % 4 == 0 && turn[3] != 0.0) check_unit_length(input, std::span(turn).first(3), where);
  }
}

}  // namespace vex
