#include "meshes/formats/vtk_parts.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "meshes/formats/text_scanner.h"

namespace vex {
namespace {

constexpr std::int64_t kMostNumbers = std::int64_t{1} << 40;
using Visit = std::function<void(std::span<const std::uint32_t>)>;

struct VtkType {
  std::string_view name;
  ScalarType type;
};
constexpr VtkType kVtkTypes[] = {
    {"float", ScalarType::float32},       {"double", ScalarType::float64},
    {"int", ScalarType::int32},           {"char", ScalarType::int8},
    {"signed_char", ScalarType::int8},    {"unsigned_char", ScalarType::uint8},
    {"short", ScalarType::int16},         {"unsigned_short", ScalarType::uint16},
    {"unsigned_int", ScalarType::uint32}, {"vtkidtype", ScalarType::int32},
    {"vtktypeint64", ScalarType::int64},  {"vtktypeuint64", ScalarType::uint64},
    {"vtktypeint32", ScalarType::int32},  {"vtktypeuint32", ScalarType::uint32},
    {"vtktypeint16", ScalarType::int16},  {"vtktypeuint16", ScalarType::uint16},
    {"vtktypeint8", ScalarType::int8},    {"vtktypeuint8", ScalarType::uint8},
};

ScalarType begin_array(MixedScanner* scanner, const char* keyword, std::string_view lower) {
  const std::string_view word = scanner->next_word();
  if (!is_vtk_word(word, lower)) scanner->refuse(quoted(word) + " is out of place", keyword);
  const ScalarType type = read_vtk_type(scanner);
  if (!is_whole(type)) scanner->refuse("places that are no whole numbers", "an integer type");
  scanner->end_line("the end of the line behind the type");
  return type;
}

void read_offset_cells(MixedScanner* scanner, std::int64_t n_offsets, std::int64_t n_corners, std::int64_t last_point,
                       const Visit& visit) {
  const ScalarType offset_type = begin_array(scanner, "OFFSETS", "offsets");
  std::vector<std::int64_t> offsets;
  for (std::int64_t i = 0; i < n_offsets; ++i) {
    const Expected expected{"an offset, not less than the one before it, of cell", static_cast<std::uint64_t>(i)};
    offsets.push_back(i == 0 ? scanner->whole_number(offset_type, expected, 0, 0)
                             : scanner->whole_number(offset_type, expected, offsets.back(), n_corners));
  }
  if ((offsets.empty() ? 0 : offsets.back()) != n_corners) {
    scanner->refuse("the last offset is not the number of all points of cells", std::to_string(n_corners));
  }
  const ScalarType corner_type = begin_array(scanner, "CONNECTIVITY", "connectivity");
  std::vector<std::uint32_t> cell;
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
    cell.clear();
    for (std::int64_t k = offsets[i]; k < offsets[i + 1]; ++k) {
      const std::int64_t corner = scanner->whole_number(corner_type, {"a point of cell", i}, 0, last_point);
      cell.push_back(static_cast<std::uint32_t>(corner));
    }
    visit(cell);
  }
}

void read_counted_cells(MixedScanner* scanner, std::int64_t n_cells, std::int64_t n_numbers, std::int64_t last_point,
                        const Visit& visit) {
  std::vector<std::uint32_t> cell;
  for (std::int64_t i = 0; i < n_cells; ++i) {
    const auto number = static_cast<std::uint64_t>(i);
    const Expected expected{"the number of points, within the announced numbers, of cell", number};
    const std::int64_t n = scanner->whole_number(ScalarType::int32, expected, 0, n_numbers - 1);
    n_numbers -= n + 1;
    cell.clear();
    for (std::int64_t k = 0; k < n; ++k) {
      const std::int64_t corner = scanner->whole_number(ScalarType::int32, {"a point of cell", number}, 0, last_point);
      cell.push_back(static_cast<std::uint32_t>(corner));
    }
    visit(cell);
  }
  if (n_numbers != 0) {
    scanner->refuse("the cells have fewer numbers than announced", std::to_string(n_numbers) + " more");
  }
}

/// A string of a binary file stands behind its length, whose first two bits say how many bytes the length has.
void skip_binary_string(MixedScanner* scanner, const Expected& expected) {
  if (scanner->n_left() == 0) scanner->refuse("the file ends early", expected.text());
  const auto first = static_cast<std::uint8_t>(scanner->rest().front());
  const std::size_t n_bytes = std::size_t{8} >> (first >> 6U);
  std::uint64_t length = 0;
  for (const char byte : scanner->take(1, n_bytes, expected)) {
    length = length << 8U | static_cast<std::uint8_t>(byte);
  }
  scanner->take(length & ~(std::uint64_t{3} << (8 * n_bytes - 2)), 1, expected);
}

/// From its type on: `n` numbers or strings.
void skip_array(MixedScanner* scanner, std::uint64_t n, const Expected& expected) {
  const std::string_view type_word = scanner->next_word();
  const bool are_strings = is_vtk_word(type_word, "string") || is_vtk_word(type_word, "utf8_string");
  const bool are_bits = is_vtk_word(type_word, "bit");
  ScalarType type = ScalarType::uint8;
  if (!are_strings && !are_bits) {
    scanner->back_to(type_word);
    type = read_vtk_type(scanner);
  }
  scanner->end_line("the end of the line behind the type");
  if (!are_strings) {
    scanner->skip(type, are_bits && !scanner->is_text() ? (n + 7) / 8 : n, expected);
    return;
  }
  for (std::uint64_t i = 0; i < n; ++i) {
    if (scanner->is_text() && scanner->n_left() > 0) {
      scanner->rest_of_line();
    } else {
      skip_binary_string(scanner, expected);
    }
  }
}

}  // namespace

bool is_vtk_word(std::string_view word, std::string_view lower) {
  const auto is_same = [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  };
  return std::ranges::equal(word, lower, is_same);
}

ScalarType read_vtk_type(MixedScanner* scanner) {
  const std::string_view word = scanner->next_word();
  for (const VtkType& known : kVtkTypes) {
    if (is_vtk_word(word, known.name)) return known.type;
  }
  if (scanner->is_text() && is_vtk_word(word, "long")) return ScalarType::int64;
  if (scanner->is_text() && is_vtk_word(word, "unsigned_long")) return ScalarType::uint64;
  scanner->refuse(quoted(word) + " is no type of numbers that is read", "float, double, int or vtktypeint64",
                  "write the mesh as .ply or .stl");
}

void read_vtk_cells(MixedScanner* scanner, std::size_t n_points, const Visit& visit) {
  const std::int64_t first = scanner->whole_word("the number of cells", 0, kMostNumbers);
  const std::int64_t second = scanner->whole_word("the number of all numbers of the cells", 0, kMostNumbers);
  scanner->end_line("the end of the line behind the numbers of cells");
  const std::int64_t last_point = static_cast<std::int64_t>(n_points) - 1;
  // As a number, OFFS would be a cell of 10^9 points.
  if (scanner->rest().starts_with("OFFSETS ")) {
    read_offset_cells(scanner, first, second, last_point, visit);
  } else {
    read_counted_cells(scanner, first, second, last_point, visit);
  }
}

void skip_vtk_field(MixedScanner* scanner) {
  scanner->next_word();  // its name
  const std::int64_t n_arrays = scanner->whole_word("the number of arrays of the field", 0, kMostNumbers);
  for (std::int64_t i = 0; i < n_arrays; ++i) {
    const Expected expected{"array of a field", static_cast<std::uint64_t>(i)};
    std::string_view array_name = scanner->next_word();
    if (is_vtk_word(array_name, "metadata")) {  // of the array before
      skip_vtk_metadata(scanner);
      array_name = scanner->next_word();
    }
    if (array_name.empty()) scanner->refuse("the file ends early", expected.text());
    const std::int64_t n_components = scanner->whole_word("the number of components", 0, std::int64_t{1} << 20);
    const std::int64_t n_tuples = scanner->whole_word("the number of tuples", 0, kMostNumbers);
    skip_array(scanner, static_cast<std::uint64_t>(n_components * n_tuples), expected);
  }
}

void skip_vtk_metadata(MixedScanner* scanner) {
  scanner->rest_of_line();
  const std::string_view block = scanner->rest();
  while (scanner->n_left() > 0 && !scanner->rest_of_line().empty()) {
  }
  const std::string_view geometry = geometry_in_vtk_attributes(block.substr(0, block.size() - scanner->n_left()));
  if (!geometry.empty()) scanner->refuse(quoted(geometry) + " stands within METADATA", "an empty line at its end");
}

std::string_view geometry_in_vtk_attributes(std::string_view rest) {
  constexpr std::string_view kKeywords[] = {"points",          "vertices", "lines",      "polygons",
                                            "triangle_strips", "cells",    "cell_types", "dataset"};
  const auto is_number = [](std::string_view word) {
    return !word.empty() && word.find_first_not_of("0123456789") == word.npos;
  };
  for (std::size_t at = 0; at < rest.size();) {
    const std::size_t end = std::min(rest.find_first_of("\r\n", at), rest.size());
    MixedScanner line(rest.substr(at, end - at), {});
    at = end + 1;
    const std::string_view keyword = line.next_word();
    const bool is_keyword = std::ranges::any_of(kKeywords, [&](auto known) { return is_vtk_word(keyword, known); });
    if (!is_keyword) continue;
    const std::string_view second = line.next_word();
    const std::string_view third = line.next_word();
    // POINTS 8 float, POLYGONS 12 48, CELL_TYPES 12, DATASET POLYDATA; arrays have a name in front, or four words.
    const bool is_geometry = is_vtk_word(keyword, "dataset") || is_vtk_word(keyword, "cell_types") ||
                             (is_number(second) && (is_number(third) || is_vtk_word(keyword, "points")));
    if (is_geometry && line.next_word().empty()) return keyword;
  }
  return {};
}

}  // namespace vex
