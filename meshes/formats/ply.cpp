// Stanford's polygon files. A header lists elements and the properties of each; of vertex, x, y and z are read, of face
// the list vertex_indices (or vertex_index), of tristrips the same list as strips that -1 parts; everything else is
// stepped over.
//
// In text every element begins in a line of its own, as the format demands, and may go on in the next ones. A number
// too many or too few in a line cannot pass for that: an element that took the numbers of a following line leaves the
// file one line short of its counts.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"
#include "meshes/formats/mixed_scanner.h"
#include "meshes/formats/ply_header.h"
#include "meshes/formats/soup_faces.h"
#include "meshes/formats/strict_readers.h"
#include "meshes/formats/text_scanner.h"

namespace vex {
namespace {

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name)
      : header_(read_ply_header(bytes, name)),
        scanner_(bytes, name, header_.encoding, header_.n_bytes),
        room_(bytes.size(), name) {}

  PolygonSoup read() {
    const PlyElement* const vertex = header_.element("vertex");
    if (vertex == nullptr) refuse_header("the file has no element vertex", "an element vertex with x, y and z");
    n_vertices_ = vertex->n;
    check_soup_size(n_vertices_, 0, scanner_.name());
    for (const PlyElement& element : header_.elements) {
      if (&element == vertex) {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element, false);
      } else if (element.name == "tristrips") {
        read_faces(element, true);
      } else {
        skip_elements(element);
      }
    }
    check_end();
    soup_.digits = scanner_.digits();
    soup_.n_parts = 1;
    return std::move(soup_);
  }

 private:
  void end_element(const Expected& expected) {
    if (scanner_.is_text()) scanner_.end_line(expected);
  }

  /// The room to take at once for `n` elements: no more than the bytes that are left can hold.
  std::size_t room(std::uint64_t n, std::size_t n_bytes_each) const {
    return static_cast<std::size_t>(std::min<std::uint64_t>(n, scanner_.n_left() / n_bytes_each));
  }

  void skip_property(const PlyProperty& property, const Expected& expected) {
    if (property.count_type) {
      const std::int64_t n = scanner_.whole_number(*property.count_type, expected, 0, kMostInList);
      scanner_.skip(property.type, static_cast<std::uint64_t>(n), expected);
    } else {
      scanner_.skip(property.type, 1, expected);
    }
  }

  void skip_elements(const PlyElement& element) {
    constexpr const char* kExpected = "the element before the vertices or faces, or behind them,";
    if (!scanner_.is_text() && !element.has_list()) {
      std::size_t size = 0;
      for (const PlyProperty& property : element.properties) size += size_of(property.type);
      scanner_.take(element.n, size, kExpected);
      return;
    }
    for (std::uint64_t i = 0; i < element.n; ++i) {
      for (const PlyProperty& property : element.properties) skip_property(property, {kExpected, i});
      end_element({"the end of the line behind element", i});
    }
  }

  void read_vertices(const PlyElement& element) {
    const PlyProperty* const axes[] = {element.property("x"), element.property("y"), element.property("z")};
    for (const PlyProperty* axis : axes) {
      if (axis == nullptr || axis->count_type) {
        refuse_header("the vertices have no x, y and z, each a number", "these properties");
      }
    }
    soup_.points.reserve(room(element.n, scanner_.is_text() ? 6 : 3));
    for (std::uint64_t i = 0; i < element.n; ++i) {
      Vec3d point;
      for (const PlyProperty& property : element.properties) {
        if (&property == axes[0]) {
          point.x = scanner_.coordinate(property.type, {"x of vertex", i});
        } else if (&property == axes[1]) {
          point.y = scanner_.coordinate(property.type, {"y of vertex", i});
        } else if (&property == axes[2]) {
          point.z = scanner_.coordinate(property.type, {"z of vertex", i});
        } else {
          skip_property(property, {"a property of vertex", i});
        }
      }
      end_element({"the end of the line behind vertex", i});
      room_.require(i + 1, soup_.corners.size());
      soup_.points.push_back(point);
    }
  }

  /// The list that names the corners of faces; null where there are no faces.
  const PlyProperty* corner_list(const PlyElement& element) const {
    if (element.n == 0) return nullptr;
    const PlyProperty* const indices = element.property("vertex_indices");
    const PlyProperty* const index = element.property("vertex_index");
    const PlyProperty* const list = indices != nullptr ? indices : index;
    if (list == nullptr || (indices != nullptr && index != nullptr) || !list->count_type || !is_whole(list->type)) {
      refuse_header("the element " + quoted(element.name) + " has no list of corners, or two",
                    "one property list vertex_indices, or vertex_index, of whole numbers");
    }
    return list;
  }

  void read_faces(const PlyElement& element, bool are_strips) {
    const PlyProperty* const list = corner_list(element);
    if (!are_strips) soup_.face_sizes.reserve(room(element.n, scanner_.is_text() ? 8 : 4));
    for (std::uint64_t i = 0; i < element.n; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (&property != list) {
          skip_property(property, {"a property of face", i});
        } else if (are_strips) {
          read_strips(property, i);
        } else {
          read_face(property, i);
        }
      }
      end_element({"the end of the line behind face", i});
    }
  }

  void read_face(const PlyProperty& list, std::uint64_t i) {
    const auto last_vertex = static_cast<std::int64_t>(n_vertices_) - 1;
    const std::int64_t n =
        scanner_.whole_number(*list.count_type, {"the number of corners of face", i}, 0, kMostInList);
    const std::size_t begin = soup_.corners.size();
    for (std::int64_t k = 0; k < n; ++k) {
      const std::int64_t corner = scanner_.whole_number(list.type, {"a vertex of face", i}, 0, last_vertex);
      room_.require(soup_.points.size(), soup_.corners.size() + 1);
      soup_.corners.push_back(static_cast<std::uint32_t>(corner));
    }
    if (n < 3) {
      soup_.corners.resize(begin);
      ++soup_.n_ignored_faces;
    } else {
      soup_.face_sizes.push_back(static_cast<std::uint32_t>(n));
    }
  }

  void read_strips(const PlyProperty& list, std::uint64_t i) {
    const auto last_vertex = static_cast<std::int64_t>(n_vertices_) - 1;
    const std::int64_t n = scanner_.whole_number(*list.count_type, {"the length of strip", i}, 0, kMostInList);
    std::vector<std::uint32_t> strip;
    for (std::int64_t k = 0; k < n; ++k) {
      const std::int64_t corner = scanner_.whole_number(list.type, {"a vertex, or -1, of strip", i}, -1, last_vertex);
      room_.require(soup_.points.size(), soup_.corners.size() + strip.size());
      if (corner >= 0) strip.push_back(static_cast<std::uint32_t>(corner));
      if (corner < 0 || k + 1 == n) {
        room_.require(soup_.points.size(), soup_.corners.size() + 3 * strip.size());
        if (!strip.empty()) add_triangle_strip(strip, &soup_);
        strip.clear();
      }
    }
  }

  /// Behind the data stands nothing; one end of a line is let pass, and blanks in a text.
  void check_end() {
    const std::size_t n_left = scanner_.n_left();
    if (scanner_.is_text()) {
      const std::string_view word = scanner_.next_word();
      if (!word.empty()) scanner_.refuse(quoted(word) + " stands behind the last element", kAtEnd, kCountAdvice);
    } else if (n_left > 0 && scanner_.rest() != "\n" && scanner_.rest() != "\r\n") {
      scanner_.take(0, 0, kAtEnd);
      scanner_.refuse(std::to_string(n_left) + " bytes stand behind the last element", kAtEnd, kCountAdvice);
    }
  }

  [[noreturn]] void refuse_header(const std::string& problem, const std::string& expected) const {
    throw InputError(problem + " (" + scanner_.name() + ", header: expected " + expected +
                     ") - write the mesh again, as points and faces");
  }

  static constexpr std::int64_t kMostInList = std::numeric_limits<std::int32_t>::max();
  static constexpr const char* kAtEnd = "the end of the file, by the numbers of elements in the header";
  static constexpr const char* kCountAdvice = "mend the numbers in the header, or write the file again";

  PlyHeader header_;
  MixedScanner scanner_;
  SoupRoom room_;
  std::uint64_t n_vertices_ = 0;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_ply(std::string_view bytes, const std::string& name) { return PlyReader(bytes, name).read(); }

}  // namespace vex
