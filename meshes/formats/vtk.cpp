// Legacy .vtk files: four lines, the last of which is DATASET POLYDATA, then keywords and what belongs to each, numbers
// being text or, in a file that says BINARY, big-endian. Of an unstructured grid the surface is read where it holds
// nothing but surface cells.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "meshes/formats/mixed_scanner.h"
#include "meshes/formats/soup_faces.h"
#include "meshes/formats/strict_readers.h"
#include "meshes/formats/text_scanner.h"
#include "meshes/formats/vtk_parts.h"

namespace vex {
namespace {

constexpr const char* kConvertData =
    "extract the surface (in ParaView: Filters, Extract Surface) and write it as .ply, .stl or legacy .vtk PolyData";

class VtkReader {
 public:
  VtkReader(std::string_view bytes, const std::string& name) : scanner_(bytes, name), room_(bytes.size(), name) {}

  PolygonSoup read() {
    read_header();
    while (read_section()) {
    }
    if (!has_points_) scanner_.refuse("the file has no points", "POINTS");
    if (is_grid_) add_grid_cells();
    soup_.n_parts = 1;
    soup_.digits = scanner_.digits();
    return std::move(soup_);
  }

 private:
  void read_header() {
    const std::string_view rest = scanner_.rest();
    if (rest.starts_with("<?xml") || rest.starts_with("<VTKFile")) {
      scanner_.refuse("this is an XML file of VTK, not a legacy one", "# vtk DataFile Version",
                      "write it as legacy .vtk, .ply or .stl");
    }
    const std::string_view first = scanner_.rest_of_line();
    constexpr std::string_view kMagic = "# vtk datafile version ";
    if (!is_vtk_word(first.substr(0, kMagic.size()), kMagic)) {
      scanner_.refuse("it does not begin like a legacy .vtk file", "# vtk DataFile Version",
                      "check that its extension names its format");
    }
    scanner_.rest_of_line();  // the title
    const std::string_view encoding = scanner_.next_word();
    const bool is_binary = is_vtk_word(encoding, "binary");
    if (!is_binary && !is_vtk_word(encoding, "ascii")) {
      scanner_.refuse(quoted(encoding) + " is out of place", "ASCII or BINARY in the third line");
    }
    const std::string_view word = scanner_.next_word();
    if (!is_vtk_word(word, "dataset")) scanner_.refuse(quoted(word) + " is out of place", "DATASET");
    const std::string_view kind = scanner_.next_word();
    is_grid_ = is_vtk_word(kind, "unstructured_grid");
    if (!is_grid_ && !is_vtk_word(kind, "polydata")) {
      scanner_.refuse("the data set " + quoted(kind) + " holds no surface", "POLYDATA", kConvertData);
    }
    scanner_.end_line("the end of the line behind the kind of data set");
    if (is_binary) scanner_.set_encoding(Encoding::big_endian);
  }

  /// False at the end of the geometry.
  bool read_section() {
    const std::string_view word = scanner_.next_word();
    if (word.empty()) return false;
    const auto is = [&](std::string_view lower) { return is_vtk_word(word, lower); };
    if (is("point_data") || is("cell_data")) {
      if (const std::string_view geometry = geometry_in_vtk_attributes(scanner_.rest()); !geometry.empty()) {
        scanner_.refuse(quoted(geometry) + " stands behind " + quoted(word), "all geometry before its attributes");
      }
      return false;
    }
    if (is("points")) {
      read_points();
    } else if (is("field")) {
      skip_vtk_field(&scanner_);
    } else if (is("metadata")) {
      skip_vtk_metadata(&scanner_);
    } else if (is_grid_ ? !read_grid_section(word) : !read_surface_section(word)) {
      scanner_.refuse(quoted(word) + " is no keyword that is known here", "POINTS, POLYGONS or POINT_DATA, say");
    }
    return true;
  }

  void read_points() {
    if (has_points_) scanner_.refuse("POINTS stands there twice", "POINTS once");
    has_points_ = true;
    const auto n = static_cast<std::uint64_t>(scanner_.whole_word("the number of points", 0, std::int64_t{1} << 40));
    const ScalarType type = read_vtk_type(&scanner_);
    scanner_.end_line("the end of the line behind the type");
    check_soup_size(n, 0, scanner_.name());
    for (std::uint64_t i = 0; i < n; ++i) {
      const Expected expected{"a coordinate of point", i};
      const double x = scanner_.coordinate(type, expected);
      const double y = scanner_.coordinate(type, expected);
      const double z = scanner_.coordinate(type, expected);
      room_.require(i + 1, soup_.corners.size() + grid_corners_.size());
      soup_.points.push_back({x, y, z});
    }
  }

  template <class Visit>
  void read_cells(const Visit& visit) {
    if (!has_points_) scanner_.refuse("cells stand before the points", "POINTS first");
    read_vtk_cells(&scanner_, soup_.points.size(), [&](std::span<const std::uint32_t> cell) {
      room_.require(soup_.points.size(), soup_.corners.size() + grid_corners_.size() + 3 * cell.size());
      visit(cell);
    });
  }

  bool read_surface_section(std::string_view word) {
    if (is_vtk_word(word, "polygons")) {
      read_cells([&](std::span<const std::uint32_t> cell) { add_polygon(cell, &soup_); });
    } else if (is_vtk_word(word, "triangle_strips")) {
      read_cells([&](std::span<const std::uint32_t> cell) { add_triangle_strip(cell, &soup_); });
    } else if (is_vtk_word(word, "vertices") || is_vtk_word(word, "lines")) {
      read_cells([&](std::span<const std::uint32_t>) { ++soup_.n_ignored_faces; });
    } else {
      return false;
    }
    return true;
  }

  bool read_grid_section(std::string_view word) {
    if (is_vtk_word(word, "cells")) {
      if (!grid_sizes_.empty()) scanner_.refuse("CELLS stands there twice", "CELLS once");
      read_cells([&](std::span<const std::uint32_t> cell) {
        grid_corners_.insert(grid_corners_.end(), cell.begin(), cell.end());
        grid_sizes_.push_back(static_cast<std::uint32_t>(cell.size()));
      });
    } else if (is_vtk_word(word, "cell_types")) {
      if (!grid_types_.empty()) scanner_.refuse("CELL_TYPES stands there twice", "CELL_TYPES once");
      const auto n = scanner_.whole_word("the number of cells", 0, std::int64_t{1} << 40);
      scanner_.end_line("the end of the line behind the number of cells");
      for (std::int64_t i = 0; i < n; ++i) {
        const Expected expected{"the type of cell", static_cast<std::uint64_t>(i)};
        grid_types_.push_back(static_cast<std::uint8_t>(scanner_.whole_number(ScalarType::int32, expected, 0, 255)));
      }
    } else {
      return false;
    }
    return true;
  }

  void add_grid_cells() {
    if (grid_types_.size() != grid_sizes_.size()) {
      scanner_.refuse(
          std::to_string(grid_sizes_.size()) + " cells have " + std::to_string(grid_types_.size()) + " types",
          "as many CELL_TYPES as CELLS");
    }
    std::size_t begin = 0;
    for (std::size_t i = 0; i < grid_sizes_.size(); ++i) {
      room_.require(soup_.points.size(), soup_.corners.size() + grid_corners_.size() + 3 * std::size_t{grid_sizes_[i]});
      add_grid_cell(grid_types_[i], std::span(grid_corners_).subspan(begin, grid_sizes_[i]), i);
      begin += grid_sizes_[i];
    }
  }

  void add_grid_cell(int type, std::span<const std::uint32_t> cell, std::size_t i) {
    enum { kVertex = 1, kPolyVertex, kLine, kPolyLine, kTriangle, kStrip, kPolygon, kPixel, kQuad };
    const bool is_wrong_size =
        (type == kTriangle && cell.size() != 3) || ((type == kPixel || type == kQuad) && cell.size() != 4);
    if (type < kVertex || type > kQuad || is_wrong_size) {
      scanner_.refuse("cell " + std::to_string(i) + ", counted from 0, of type " + std::to_string(type) + " and " +
                          std::to_string(cell.size()) + " points is no cell of a surface",
                      "triangles, quads and polygons", kConvertData);
    }
    if (type <= kPolyLine) {
      ++soup_.n_ignored_faces;
    } else if (type == kStrip) {
      add_triangle_strip(cell, &soup_);
    } else if (type == kPixel) {  // its corners stand row by row
      soup_.add_face({cell[0], cell[1], cell[3], cell[2]});
    } else {
      add_polygon(cell, &soup_);
    }
  }

  MixedScanner scanner_;
  SoupRoom room_;
  PolygonSoup soup_;
  bool has_points_ = false;
  bool is_grid_ = false;
  std::vector<std::uint32_t> grid_corners_;
  std::vector<std::uint32_t> grid_sizes_;
  std::vector<std::uint8_t> grid_types_;
};

}  // namespace

PolygonSoup read_vtk(std::string_view bytes, const std::string& name) { return VtkReader(bytes, name).read(); }

}  // namespace vex
