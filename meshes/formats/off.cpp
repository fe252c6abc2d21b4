// Geomview's .off, text, three dimensions: OFF with any of the prefixes C, N, ST, or no such word at all.
//
// Where the first vertex fills its line, every vertex must fill one; otherwise numbers follow one another over lines as
// they like. A face begins on a line of its own, and a colour may end its last line; one that goes on over several
// lines has none, so that a line that lost an index does not take what it lacks from the next one.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "meshes/formats/soup_faces.h"
#include "meshes/formats/strict_readers.h"
#include "meshes/formats/text_scanner.h"

namespace vex {
namespace {

constexpr std::int64_t kMostOfOff = std::int64_t{1} << 30U;  // points, and corners

/// What stands behind x, y, z of each vertex.
struct Prefix {
  bool has_colours = false;
  bool has_normals = false;
  bool has_texture = false;

  std::size_t n_more(std::size_t n_of_colour) const {
    return (has_colours ? n_of_colour : 0) + (has_normals ? 3U : 0U) + (has_texture ? 2U : 0U);
  }
  bool allows(std::size_t n_numbers) const { return n_numbers == 3 + n_more(3) || n_numbers == 3 + n_more(4); }
};

/// Of the letters before OFF, each once, in any order; nothing where there are others.
std::optional<Prefix> prefix_of(std::string_view letters) {
  Prefix prefix;
  const auto take = [&letters](std::string_view letter, bool* has) {
    if (*has || !letters.starts_with(letter)) return false;
    letters.remove_prefix(letter.size());
    return *has = true;
  };
  while (take("C", &prefix.has_colours) || take("N", &prefix.has_normals) || take("ST", &prefix.has_texture)) {
  }
  return letters.empty() ? std::optional(prefix) : std::nullopt;
}

class OffReader {
 public:
  OffReader(std::string_view bytes, const std::string& name) : scanner_(bytes, name), room_(bytes.size(), name) {}

  PolygonSoup soup() {
    read_header();
    read_counts();
    read_points();
    for (std::int64_t i = 0; i < n_faces_; ++i) read_face(i);
    if (scanner_.next_line_of_content()) {
      scanner_.refuse(
          "there is more than " + std::to_string(n_points_) + " vertices and " + std::to_string(n_faces_) + " faces",
          "the end of the file", "mend the counts at its beginning");
    }
    soup_.n_parts = 1;
    soup_.digits = digits_.digits();
    return std::move(soup_);
  }

 private:
  /// Up to the counts.
  void read_header() {
    if (!scanner_.next_line_of_content()) scanner_.refuse("the file holds nothing", "OFF");
    const std::string_view line = scanner_.line();
    std::string_view word = scanner_.next_word();
    if (word.find_first_not_of("0123456789") == std::string_view::npos) {  // the word is optional
      scanner_.put_line(line);
      return;
    }
    const std::size_t off = std::min(word.find("OFF"), word.find("off"));
    const std::optional<Prefix> prefix = prefix_of(word.substr(0, off));
    // Some writers leave no blank between the word and the counts.
    const std::string_view behind = off == std::string_view::npos ? word : word.substr(off + 3);
    if (!prefix || behind.find_first_not_of("0123456789") != std::string_view::npos) {
      const bool is_other = off != std::string_view::npos && behind.empty();
      scanner_.refuse(quoted(word) + (is_other ? " is not of three dimensions" : " begins no .off file"),
                      "OFF, or COFF, NOFF, STOFF", is_other ? "write it as OFF" : "check the file's format");
    }
    prefix_ = *prefix;
    const std::string_view rest =
        behind.empty() ? scanner_.rest_of_line() : TextScanner::trimmed(line.substr(line.find(word) + off + 3));
    if (rest.starts_with("BINARY")) {
      scanner_.refuse("the file is binary", "text", "convert it to .off as text, or to .ply");
    }
    if (!rest.empty()) {
      scanner_.put_line(rest);
    } else if (!scanner_.next_line_of_content()) {
      scanner_.refuse("the file ends early", "the numbers of vertices and faces");
    }
  }

  void read_counts() {
    n_points_ = scanner_.whole_number("the number of vertices", 0, kMostOfOff);
    n_faces_ = scanner_.whole_number("the number of faces", 0, kMostOfOff);
    if (scanner_.has_word()) scanner_.whole_number("the number of edges", -kMostOfOff, 4 * kMostOfOff);
    if (scanner_.has_word()) {
      scanner_.refuse("there are more than three counts", "the numbers of vertices, faces and edges");
    }
    if (n_points_ == 0) scanner_.refuse("the file holds no vertex", "one at least");
    // A vertex is three digits, and what parts them; a face is as much.
    const std::size_t n_left = scanner_.rest_of_text().size() / 6 + 1;
    soup_.points.reserve(std::min(n_left, static_cast<std::size_t>(n_points_)));
    soup_.face_sizes.reserve(std::min(n_left, static_cast<std::size_t>(n_faces_)));
    soup_.corners.reserve(std::min(n_left, static_cast<std::size_t>(n_faces_)) * 3);
  }

  void read_points() {
    std::size_t n_on_line = 0;  // numbers of each vertex, each on a line of its own; 0 where they are not so
    for (std::int64_t i = 0; i < n_points_; ++i) {
      if (i == 0 || n_on_line > 0) next_line("vertex", i, n_points_);
      if (i == 0) n_on_line = numbers_of_a_vertex_line();
      Vec3d point;
      for (double* coordinate : {&point.x, &point.y, &point.z}) {
        if (n_on_line == 0) find_word(i);
        *coordinate = scanner_.coordinate("x y z of a vertex", digits_);
      }
      const std::size_t n_more = n_on_line > 0 ? n_on_line - 3 : prefix_.n_more(4);
      for (std::size_t k = 0; k < n_more; ++k) {
        if (n_on_line == 0) find_word(i);
        scanner_.number("the normal, colour or texture coordinate that the first line promises");
      }
      if (n_on_line > 0 && scanner_.has_word()) refuse_rest("the end of the vertex");
      room_.require(soup_.points.size() + 1, 0);
      soup_.points.push_back(point);
    }
    if (scanner_.has_word()) refuse_rest("the end of the vertices");
  }

  /// Of the line at hand, where they are those of one vertex; 0 otherwise.
  std::size_t numbers_of_a_vertex_line() {
    const std::string_view line = scanner_.line();
    std::size_t n_words = 0;
    while (!scanner_.next_word().empty()) ++n_words;
    if (prefix_.allows(n_words)) {
      scanner_.put_line(line);
      return n_words;
    }
    const std::size_t n_of_one = 3 + prefix_.n_more(4);
    if (n_words > n_of_one && n_words % n_of_one != 0) {
      scanner_.refuse("a line of " + std::to_string(n_words) + " numbers",
                      "vertices of " + std::to_string(n_of_one) + " numbers, as the file's first word says");
    }
    scanner_.put_line(line);
    return 0;
  }

  void read_face(std::int64_t i) {
    next_line("face", i, n_faces_);
    const std::int64_t n_corners = scanner_.whole_number("the face's number of corners", 1, kMostOfOff);
    const std::size_t begin = soup_.corners.size();
    bool is_spread = false;
    for (std::int64_t k = 0; k < n_corners; ++k) {
      if (!scanner_.has_word()) {
        next_line("face", i, n_faces_);
        is_spread = true;
      }
      room_.require(soup_.points.size(), soup_.corners.size() + 1);
      soup_.corners.push_back(static_cast<std::uint32_t>(scanner_.whole_number("a vertex index", 0, n_points_ - 1)));
    }
    read_colour(is_spread);
    if (n_corners < 3) {
      soup_.corners.resize(begin);
      ++soup_.n_ignored_faces;
    } else {
      soup_.face_sizes.push_back(static_cast<std::uint32_t>(n_corners));
    }
  }

  void read_colour(bool is_spread) {
    if (!scanner_.has_word()) return;
    if (is_spread) refuse_rest("the end of a face that goes on over several lines");
    constexpr const char* kExpected = "a colour of 1, 3 or 4 numbers behind the face, or none";
    std::size_t n_numbers = 0;
    for (; scanner_.has_word(); ++n_numbers) scanner_.number(kExpected);
    if (n_numbers == 2 || n_numbers > 4) {
      scanner_.refuse("a colour of " + std::to_string(n_numbers) + " numbers", kExpected);
    }
  }

  void next_line(const char* element, std::int64_t i, std::int64_t n) {
    if (!scanner_.next_line_of_content()) {
      scanner_.refuse("the file ends early", element + (" " + std::to_string(i + 1)) + " of " + std::to_string(n));
    }
  }
  void find_word(std::int64_t i) {
    if (!scanner_.has_word()) next_line("vertex", i, n_points_);
  }
  [[noreturn]] void refuse_rest(const char* expected) {
    scanner_.refuse(quoted(scanner_.next_word()) + " is too much", expected);
  }

  TextScanner scanner_;
  SoupRoom room_;
  PolygonSoup soup_;
  WrittenDigits digits_;
  Prefix prefix_;
  std::int64_t n_points_ = 0;
  std::int64_t n_faces_ = 0;
};

}  // namespace

PolygonSoup read_off(std::string_view bytes, const std::string& name) { return OffReader(bytes, name).soup(); }

}  // namespace vex
