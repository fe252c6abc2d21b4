// Stereolithography: triangles, each with its own three points. A binary file is 80 bytes, the number of triangles, and
// 50 bytes for each: a normal, three vertices, two more bytes. Text is a solid or several, of facets of one loop each.
//
// Many binary files begin with "solid" too, so size decides first: no text of that size has the number that a binary
// file has at byte 80. Otherwise a file that begins with the word solid and has no zero byte near its beginning, as
// every binary file has in its number of triangles, is text.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "meshes/formats/mixed_scanner.h"
#include "meshes/formats/soup_faces.h"
#include "meshes/formats/strict_readers.h"
#include "meshes/formats/text_scanner.h"

namespace vex {
namespace {

constexpr std::size_t kHeader = 80;
constexpr std::size_t kBegin = kHeader + 4;
constexpr std::size_t kBytesOfTriangle = 50;
constexpr bool kSwapped = std::endian::native == std::endian::big;

/// `lower` is in lower case.
bool is_word(std::string_view word, std::string_view lower) {
  const auto is_same = [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  };
  return word == lower || std::ranges::equal(word, lower, is_same);
}

std::uint64_t announced_triangles(std::string_view bytes) {
  return static_cast<std::uint64_t>(load_whole(bytes.data() + kHeader, ScalarType::uint32, kSwapped));
}

std::string_view without_mark(std::string_view bytes) {
  return bytes.substr(bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0);
}

/// Near its beginning a binary file has one, in its number of triangles.
bool has_zero_byte(std::string_view bytes) { return bytes.substr(0, 1024).find('\0') != std::string_view::npos; }

bool is_text(std::string_view bytes) {
  if (bytes.size() >= kBegin && bytes.size() == kBegin + kBytesOfTriangle * announced_triangles(bytes)) return false;
  return is_word(MixedScanner(without_mark(bytes), {}).next_word(), "solid") && !has_zero_byte(bytes);
}

/// Fewer bytes than a triangle, or nothing but zeros, can stand behind the last one without hiding any.
void check_binary_size(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kBegin ||
      (!has_zero_byte(bytes) && announced_triangles(bytes) > bytes.size() / kBytesOfTriangle)) {
    throw InputError("this is no .stl file (" + name + ", " + std::to_string(bytes.size()) +
                     " bytes: expected the word solid, or a binary file) - check that its extension names its format");
  }
  const std::uint64_t n = announced_triangles(bytes);
  const std::uint64_t room = (bytes.size() - kBegin) / kBytesOfTriangle;
  const auto refuse = [&](const std::string& advice) {
    throw InputError("the number of triangles does not hold (" + name + ", byte 80: " + std::to_string(n) +
                     " triangles, expected no other number than the " + std::to_string(room) +
                     " that the file has bytes for) - " + advice);
  };
  if (n > room) refuse("the file is cut off or is no binary .stl file: write it again");
  const std::string_view behind = bytes.substr(kBegin + static_cast<std::size_t>(n) * kBytesOfTriangle);
  if (behind.size() >= kBytesOfTriangle && behind.find_first_not_of('\0') != std::string_view::npos) {
    refuse("mend the number, or write the file again");
  }
}

PolygonSoup read_binary(std::string_view bytes, const std::string& name) {
  check_binary_size(bytes, name);
  const auto n = static_cast<std::size_t>(announced_triangles(bytes));
  check_soup_size(3 * n, 3 * n, name);
  PolygonSoup soup;
  soup.points.resize(3 * n);
  soup.corners.resize(3 * n);
  soup.face_sizes.assign(n, 3);
  double largest = 0.0;
  for (std::size_t i = 0; i < 3 * n; ++i) {
    if (i % 4096 == 0) end_if_interrupted();
    const char* const at = bytes.data() + kBegin + i / 3 * kBytesOfTriangle + 12 * (1 + i % 3);
    const auto number = [&](std::size_t axis) { return load_number(at + 4 * axis, ScalarType::float32, kSwapped); };
    const Vec3d point{number(0), number(1), number(2)};
    const double magnitude = std::max({std::fabs(point.x), std::fabs(point.y), std::fabs(point.z)});
    if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
      throw InputError("a coordinate is not finite (" + name + ", byte " +
                       std::to_string(static_cast<std::size_t>(at - bytes.data())) + ": expected vertex " +
                       std::to_string(i % 3) + " of triangle " + std::to_string(i / 3) +
                       ", counted from 0) - mend the file");
    }
    largest = std::max(largest, magnitude);
    soup.points[i] = point;
    soup.corners[i] = static_cast<std::uint32_t>(i);
  }
  soup.n_parts = 1;
  soup.digits = float_digits(largest);
  return soup;
}

class TextReader {
 public:
  TextReader(std::string_view bytes, const std::string& name) : scanner_(bytes, name), room_(bytes.size(), name) {}

  PolygonSoup read() {
    const std::size_t n_guess = scanner_.n_left() / 250;
    soup_.points.reserve(3 * n_guess);
    soup_.corners.reserve(3 * n_guess);
    soup_.face_sizes.reserve(n_guess);
    for (std::string_view word = scanner_.next_word(); !word.empty(); word = scanner_.next_word()) {
      if (!is_word(word, "solid")) scanner_.refuse(quoted(word) + " stands behind a solid", "solid, or the file's end");
      read_solid();
      ++soup_.n_parts;
    }
    soup_.digits = scanner_.digits();
    return std::move(soup_);
  }

 private:
  /// Where in a line, which holds a solid's name, its first facet begins; a file may have no lines.
  static std::optional<std::string_view> facet_in(std::string_view line) {
    MixedScanner words(line, {});
    std::string_view last;
    for (std::string_view word = words.next_word(); !word.empty(); last = word, word = words.next_word()) {
      if (is_word(last, "facet") && is_word(word, "normal")) return last;
    }
    return std::nullopt;
  }

  void read_solid() {
    if (const auto facet = facet_in(scanner_.rest_of_line())) scanner_.back_to(*facet);
    while (true) {
      const std::string_view word = scanner_.next_word();
      if (is_word(word, "endsolid")) break;
      if (!is_word(word, "facet")) refuse_word(word, "facet or endsolid");
      read_facet();
    }
    if (facet_in(scanner_.rest_of_line())) {
      scanner_.refuse("facets stand behind endsolid in one line", "a name at most", "begin each solid in a new line");
    }
  }

  void read_facet() {
    expect("normal");
    for (int i = 0; i < 3; ++i) read_normal();
    expect("outer");
    expect("loop");
    const std::size_t first = soup_.points.size();
    std::string_view word = scanner_.next_word();
    for (; is_word(word, "vertex"); word = scanner_.next_word()) {
      const Expected expected{"a coordinate of point", soup_.points.size()};
      const double x = scanner_.coordinate(ScalarType::float64, expected);
      const double y = scanner_.coordinate(ScalarType::float64, expected);
      const double z = scanner_.coordinate(ScalarType::float64, expected);
      room_.require(soup_.points.size() + 1, soup_.corners.size() + 1);
      soup_.corners.push_back(static_cast<std::uint32_t>(soup_.points.size()));
      soup_.points.push_back({x, y, z});
    }
    const std::size_t n = soup_.points.size() - first;
    if (!is_word(word, "endloop")) refuse_word(word, n < 3 ? "vertex" : "vertex or endloop");
    if (n < 3) scanner_.refuse("a loop of " + std::to_string(n) + " vertices", "three or more");
    soup_.face_sizes.push_back(static_cast<std::uint32_t>(n));
    expect("endfacet");
  }

  /// Normals are not used, and writers print "nan" where a triangle has none: what looks like a number is let pass.
  void read_normal() {
    const std::string_view word = scanner_.next_word();
    std::string_view bare = word;
    if (bare.starts_with('-') || bare.starts_with('+')) bare.remove_prefix(1);
    const auto is_of_number = [](char c) {
      return (c >= '0' && c <= '9') || c == '.' || c == 'e' || c == 'E' || c == '-' || c == '+';
    };
    if (!bare.empty() && std::ranges::all_of(bare, is_of_number)) return;
    const bool is_none = is_word(bare.substr(0, 3), "nan") || is_word(bare.substr(0, 3), "inf");
    if (!is_none && !bare.starts_with("1.#")) refuse_word(word, "a number of the normal");
  }

  void expect(std::string_view keyword) {
    const std::string_view word = scanner_.next_word();
    if (!is_word(word, keyword)) refuse_word(word, std::string(keyword));
  }

  [[noreturn]] void refuse_word(std::string_view word, const std::string& expected) const {
    if (word.empty()) scanner_.refuse("the file ends early", expected, "write the file again, all of it");
    scanner_.refuse(quoted(word) + " is out of place", expected);
  }

  MixedScanner scanner_;
  SoupRoom room_;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_stl(std::string_view bytes, const std::string& name) {
  return is_text(bytes) ? TextReader(without_mark(bytes), name).read() : read_binary(bytes, name);
}

}  // namespace vex
