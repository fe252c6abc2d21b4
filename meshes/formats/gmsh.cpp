// Gmsh's .msh files, versions 2, 4.0 and 4.1, in text or binary: sections from $Name to $EndName. Nodes have numbers in
// no order; of the elements, triangles and quads are the surface.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "meshes/formats/gmsh_parts.h"
#include "meshes/formats/mixed_scanner.h"
#include "meshes/formats/soup_faces.h"
#include "meshes/formats/strict_readers.h"
#include "meshes/formats/text_scanner.h"

namespace vex {
namespace {

constexpr std::int64_t kMostEntries = std::int64_t{1} << 40;
constexpr std::int64_t kMostTag = std::numeric_limits<std::int64_t>::max() - 1;
constexpr auto kInt = ScalarType::int32;
constexpr auto kDouble = ScalarType::float64;

class GmshReader {
 public:
  GmshReader(std::string_view bytes, const std::string& name)
      : scanner_(bytes, name), room_(bytes.size(), name, 16, 8) {}

  PolygonSoup read() {
    version_ = read_gmsh_format(&scanner_);
    bool has_elements = false;
    for (std::string_view word = scanner_.next_word(); !word.empty(); word = scanner_.next_word()) {
      if (!word.starts_with('$') || word.starts_with("$End")) {
        scanner_.refuse(quoted(word) + " stands outside of sections", "a section that begins with $");
      }
      const bool are_parametric = word == "$ParametricNodes" && version_ == GmshVersion::v2;
      if (word == "$Nodes" || are_parametric) {
        if (!soup_.points.empty()) scanner_.refuse("a second section of nodes", "one section");
        scanner_.end_line("the end of the line behind the section's name");
        if (version_ == GmshVersion::v2) {
          read_nodes_2(are_parametric);
        } else {
          read_nodes_4();
        }
        end_gmsh_section(&scanner_, are_parametric ? "$EndParametricNodes" : "$EndNodes");
      } else if (word == "$Elements") {
        if (std::exchange(has_elements, true)) scanner_.refuse("a second section $Elements", "one section");
        scanner_.end_line("the end of the line behind $Elements");
        if (version_ == GmshVersion::v2) {
          read_elements_2();
        } else {
          read_elements_4();
        }
        end_gmsh_section(&scanner_, "$EndElements");
      } else {
        skip_gmsh_section(&scanner_, word);
      }
    }
    if (soup_.points.empty()) scanner_.refuse("the file has no nodes", "a section $Nodes");
    finish_faces();
    soup_.n_parts = 1;
    soup_.digits = scanner_.digits();
    return std::move(soup_);
  }

 private:
  /// Before each number: in text, a line that lacks one must not take the next line's.
  void stay_in_line(const Expected& expected) {
    if (!scanner_.is_text() || !std::exchange(is_in_line_, true)) return;
    const std::string_view rest = scanner_.rest();
    std::size_t at = 0;
    while (at < rest.size() && TextScanner::is_blank(rest[at])) ++at;
    if (at < rest.size() && (rest[at] == '\n' || rest[at] == '\r')) {
      scanner_.refuse("the line ends early", expected.text());
    }
  }
  void end_line(const Expected& expected) {
    if (scanner_.is_text()) scanner_.end_line(expected);
    is_in_line_ = false;
  }

  std::int64_t whole(ScalarType type, const Expected& expected, std::int64_t least, std::int64_t most) {
    stay_in_line(expected);
    return scanner_.whole_number(type, expected, least, most);
  }
  std::uint64_t whole(ScalarType type, const Expected& expected, std::int64_t most) {
    return static_cast<std::uint64_t>(whole(type, expected, 0, most));
  }
  std::int64_t tag(ScalarType type, const Expected& expected) { return whole(type, expected, 1, kMostTag); }

  double coordinate(const Expected& expected) {
    stay_in_line(expected);
    return scanner_.coordinate(kDouble, expected);
  }

  void skip(ScalarType type, std::uint64_t n, const Expected& expected) {
    if (!scanner_.is_text()) return scanner_.skip(type, n, expected);
    for (std::uint64_t i = 0; i < n; ++i) {
      stay_in_line(expected);
      scanner_.skip(type, 1, expected);
    }
  }

  void read_point() {
    const Expected expected{"a coordinate of node", soup_.points.size()};
    const double x = coordinate(expected);
    const double y = coordinate(expected);
    const double z = coordinate(expected);
    room_.require(soup_.points.size() + 1, corner_tags_.size());
    soup_.points.push_back({x, y, z});
  }

  void read_nodes_2(bool are_parametric) {
    const std::int64_t n = scanner_.whole_word("the number of nodes", 0, kMostEntries);
    scanner_.end_line("the end of the line behind the number of nodes");
    check_soup_size(static_cast<std::uint64_t>(n), 0, scanner_.name());
    for (std::int64_t i = 0; i < n; ++i) {
      nodes_.add(tag(kInt, {"the number of node", static_cast<std::uint64_t>(i)}));
      read_point();
      if (are_parametric) {
        const Expected expected{"what node lies on, and where:", static_cast<std::uint64_t>(i)};
        const std::uint64_t n_dimensions = whole(kInt, expected, 3);
        skip(kInt, 1, expected);
        skip(kDouble, n_dimensions < 3 ? n_dimensions : 0, expected);
      }
      end_line({"the end of the line of node", static_cast<std::uint64_t>(i)});
    }
  }

  /// 4.1 writes sizes and numbers of nodes and elements in eight bytes, 4.0 numbers in four.
  ScalarType tag_type() const { return version_ == GmshVersion::v41 ? ScalarType::uint64 : kInt; }

  void read_nodes_4() {
    constexpr auto kSize = ScalarType::uint64;
    const std::uint64_t n_blocks = whole(kSize, "the number of blocks of nodes", kMostEntries);
    const std::uint64_t n_nodes = whole(kSize, "the number of nodes", kMostEntries);
    check_soup_size(n_nodes, 0, scanner_.name());
    if (version_ == GmshVersion::v41) skip(kSize, 2, "the least and the greatest number of a node");
    end_line("the end of the line of the number of nodes");
    for (std::uint64_t block = 0; block < n_blocks; ++block) {
      const Expected expected{"block of nodes", block};
      const bool is_41 = version_ == GmshVersion::v41;
      if (!is_41) skip(kInt, 1, expected);
      const auto n_dimensions = whole(kInt, expected, 3);
      if (is_41) skip(kInt, 1, expected);
      const bool is_parametric = whole(kInt, expected, 1) == 1;
      const std::uint64_t n = whole(kSize, expected, static_cast<std::int64_t>(n_nodes - soup_.points.size()));
      const std::uint64_t n_parameters = is_parametric && (is_41 || n_dimensions < 3) ? n_dimensions : 0;
      end_line({"the end of the first line of block of nodes", block});
      for (std::uint64_t i = 0; is_41 && i < n; ++i) {
        nodes_.add(tag(tag_type(), {"the number of a node, block", block}));
        is_in_line_ = false;  // Gmsh writes one a line, and reads them in any lines
      }
      if (is_41 && n > 0) end_line({"the end of the line of the numbers of nodes, block", block});
      for (std::uint64_t i = 0; i < n; ++i) {
        if (!is_41) nodes_.add(tag(tag_type(), {"the number of a node, block", block}));
        read_point();
        skip(kDouble, n_parameters, "the parameters of a node");
        end_line({"the end of the line of node", soup_.points.size() - 1});
      }
    }
    if (soup_.points.size() != n_nodes) {
      scanner_.refuse("the blocks have " + std::to_string(soup_.points.size()) + " nodes", std::to_string(n_nodes));
    }
  }

  void read_elements_2() {
    const std::uint64_t n = static_cast<std::uint64_t>(scanner_.whole_word("the number of elements", 0, kMostEntries));
    scanner_.end_line("the end of the line behind the number of elements");
    for (std::uint64_t i = 0; i < n;) {
      const bool is_text = scanner_.is_text();
      if (is_text) tag(kInt, {"the number of element", i});
      const GmshElement element = read_type(i);
      const auto n_left = static_cast<std::int64_t>(n - i);
      const auto n_of_kind = is_text ? 1 : whole(kInt, {"how many elements are of the kind of", i}, 1, n_left);
      const std::uint64_t n_tags = whole(kInt, {"the number of tags of element", i}, kMostEntries);
      for (const std::uint64_t end = i + static_cast<std::uint64_t>(n_of_kind); i < end; ++i) {
        if (!is_text) tag(kInt, {"the number of element", i});
        read_element_2(element, n_tags, i);
        end_line({"the end of the line of element", i});
      }
    }
  }

  /// An element that belongs to several physical groups stands there once for each, one behind the other: the first
  /// of the tags is the group, the second the part of the geometry that the element lies on.
  void read_element_2(const GmshElement& element, std::uint64_t n_tags, std::uint64_t i) {
    std::int64_t group_and_part[2] = {0, 0};
    for (std::uint64_t k = 0; k < n_tags; ++k) {
      const std::int64_t value = whole(kInt, {"a tag of element", i}, -kMostEntries, kMostEntries);
      if (k < 2) group_and_part[k] = value;
    }
    const std::size_t n_faces = soup_.face_sizes.size();
    read_element(element, i);
    if (soup_.face_sizes.size() == n_faces) return;
    const std::span<const std::int64_t> corners(corner_tags_);
    const auto n_nodes = static_cast<std::size_t>(element.n_nodes);
    if (n_tags >= 2 && n_faces > 0 && soup_.face_sizes[n_faces - 1] == n_nodes && group_and_part[0] != last_group_ &&
        group_and_part[1] == last_part_ &&
        std::ranges::equal(corners.last(n_nodes), corners.last(2 * n_nodes).first(n_nodes))) {
      soup_.face_sizes.pop_back();
      corner_tags_.resize(corner_tags_.size() - n_nodes);
    }
    last_group_ = group_and_part[0];
    last_part_ = group_and_part[1];
  }

  void read_elements_4() {
    constexpr auto kSize = ScalarType::uint64;
    const std::uint64_t n_blocks = whole(kSize, "the number of blocks of elements", kMostEntries);
    const std::uint64_t n_elements = whole(kSize, "the number of elements", kMostEntries);
    if (version_ == GmshVersion::v41) skip(kSize, 2, "the least and the greatest number of an element");
    end_line("the end of the line of the number of elements");
    std::uint64_t n_read = 0;
    for (std::uint64_t block = 0; block < n_blocks; ++block) {
      const Expected expected{"block of elements", block};
      skip(kInt, 2, expected);  // the geometry that it belongs to
      const GmshElement element = read_type(n_read);
      const std::uint64_t n = whole(kSize, expected, static_cast<std::int64_t>(n_elements - n_read));
      end_line({"the end of the first line of block of elements", block});
      for (std::uint64_t i = 0; i < n; ++i, ++n_read) {
        tag(tag_type(), {"the number of element", n_read});
        read_element(element, n_read);
        end_line({"the end of the line of element", n_read});
      }
    }
    if (n_read != n_elements) {
      scanner_.refuse("the blocks have " + std::to_string(n_read) + " elements", std::to_string(n_elements));
    }
  }

  GmshElement read_type(std::uint64_t i) {
    const std::int64_t type = whole(kInt, {"the type of element", i}, 1, 1000);
    const GmshElement element = gmsh_element(type);
    if (element.n_nodes == 0) {
      scanner_.refuse(std::to_string(type) + " is no type of elements that is known", "triangles and quads (2 and 3)",
                      "write the surface alone");
    }
    if (element.n_dimensions == 2 && !element.is_flat) {
      scanner_.refuse("curved surface elements (type " + std::to_string(type) + ")", "triangles and quads (2 and 3)",
                      "write the mesh with elements of first order (Mesh.ElementOrder = 1)");
    }
    return element;
  }

  void read_element(const GmshElement& element, std::uint64_t i) {
    if (element.n_dimensions != 2) {
      (element.n_dimensions == 3 ? n_volumes_ : soup_.n_ignored_faces) += 1;
      skip(tag_type(), static_cast<std::uint64_t>(element.n_nodes), {"the nodes of element", i});
      return;
    }
    room_.require(soup_.points.size(), corner_tags_.size() + static_cast<std::size_t>(element.n_nodes));
    for (int k = 0; k < element.n_nodes; ++k) corner_tags_.push_back(tag(tag_type(), {"a node of element", i}));
    soup_.face_sizes.push_back(static_cast<std::uint32_t>(element.n_nodes));
  }

  void finish_faces() {
    if (n_volumes_ > 0 && soup_.face_sizes.empty()) {
      scanner_.refuse("the file holds volume elements and no surface", "triangles or quads (types 2 and 3)",
                      "write the surface too: save all elements (Mesh.SaveAll = 1), or the surface's physical group");
    }
    if (const auto twice = nodes_.put_in_order()) refuse_node(*twice, "two nodes have one number", "each number once");
    soup_.corners.reserve(corner_tags_.size());
    for (const std::int64_t number : corner_tags_) {
      const auto index = nodes_.find(number);
      if (!index) refuse_node(number, "an element names a node that is not there", "one of the section $Nodes");
      soup_.corners.push_back(*index);
    }
  }

  [[noreturn]] void refuse_node(std::int64_t number, const std::string& problem, const std::string& expected) const {
    throw InputError(problem + " (" + scanner_.name() + ", node " + std::to_string(number) + ": expected " + expected +
                     ") - mend the file");
  }

  MixedScanner scanner_;
  SoupRoom room_;  // beside a node its number, and beside a corner the number of its node
  GmshVersion version_ = GmshVersion::v41;
  PolygonSoup soup_;
  GmshNodes nodes_;
  std::vector<std::int64_t> corner_tags_;  // of the faces, one after another
  std::size_t n_volumes_ = 0;
  std::int64_t last_group_ = 0;  // of the last face, in version 2
  std::int64_t last_part_ = 0;
  bool is_in_line_ = false;  // of text: a number of the line has been read
};

}  // namespace

PolygonSoup read_gmsh(std::string_view bytes, const std::string& name) { return GmshReader(bytes, name).read(); }

}  // namespace vex
