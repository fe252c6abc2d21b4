// What the looks into scene formats share: refusals, and the numbers that stand in XML.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "meshes/assimp_input.h"
#include "meshes/formats/xml_tags.h"
#include "meshes/length_unit.h"

namespace vex {

/// Throws InputError: "problem (path: where) - advice".
[[noreturn]] void refuse_scene(const AssimpInput& input, const std::string& problem, const std::string& where,
                               const std::string& advice);

/// Sets the unit, where there is one.
void set_unit(const std::optional<LengthUnit>& unit, AssimpInput* input);

/// The first tag of a text that is no closing one.
std::optional<XmlTag> first_tag(std::string_view text);
/// As messages quote it. (Of a std::string, quoted() would be taken for std::quoted.)
std::string shown(std::string_view word);
std::string shown_tag(const XmlTag& tag);
/// A tag's name as `<name>`, printable and shortened as quoted words are.
std::string shown_name(std::string_view name);

/// What blanks of XML are.
inline constexpr std::string_view kXmlBlanks = " \t\r\n";
/// Without the blanks before it.
std::string_view from_word(std::string_view text);
/// The next word, which `text` has no more then; empty where there is none.
std::string_view take_word(std::string_view& text);

/// Whether all of a text is a number that assimp reads as what it is.
bool is_decimal(std::string_view text);
bool is_index(std::string_view text);

struct NumberKind {
  const char* name;
  bool (*holds)(std::string_view text);
};
inline constexpr NumberKind kDecimal{"a decimal number", is_decimal};
inline constexpr NumberKind kIndex{"a whole number from 0 to 2147483647", is_index};

/// Refuses a rotation's axis, or a quaternion, whose length is not 1 to within rounding to seven digits: assimp makes
/// of it a matrix that stretches as well.
void check_unit_length(const AssimpInput& input, std::span<const double> direction, const std::string& where);
/// The same of axes and angles, four numbers each, in a text of decimal numbers; by an angle of 0 nothing is turned.
void check_axes(const AssimpInput& input, std::string_view numbers, const std::string& where);

}  // namespace vex
