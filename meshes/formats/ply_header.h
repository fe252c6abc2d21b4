// The header of a .ply file: which elements follow it, how many of each, and of what they are made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "meshes/formats/mixed_scanner.h"
#include "meshes/formats/scalar_type.h"

namespace vex {

struct PlyProperty {
  std::string_view name;  // a part of the file, as all names here
  ScalarType type = ScalarType::float32;
  std::optional<ScalarType> count_type;  // where it is a list
};

struct PlyElement {
  std::string_view name;
  std::uint64_t n = 0;
  std::vector<PlyProperty> properties;

  /// Null where there is none of this name.
  const PlyProperty* property(std::string_view property_name) const;
  bool has_list() const;
};

struct PlyHeader {
  Encoding encoding = Encoding::text;
  std::vector<PlyElement> elements;
  std::size_t n_bytes = 0;  // up to the first byte of the data

  /// Null where there is none of this name.
  const PlyElement* element(std::string_view element_name) const;
};

/// Throws InputError for what is no .ply header, for a name that stands twice in one place, and for elements without a
/// property. Lines end in LF with or without a CR before it; or all of them in CR, if the first does. Exactly one end
/// belongs to the line end_header, as the data may begin with a byte that looks like one.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

}  // namespace vex
