// Wavefront .obj: v and f; l and p count as lines and points.
//
// - A face may name vertices that stand behind it in the file, by their absolute index; what no vertex answers at the
//   end is refused. A relative index (-1: the last vertex so far) can only name what stands before.
// - Indices of texture coordinates and of normals are whole numbers, and no more is asked of them.
// - A line may end in a backslash and go on in the next one. Readers disagree on a backslash behind a comment, and on
//   one between two halves of a word: what these mean is refused where it matters.
// - Keywords without geometry are skipped; curves and surfaces, and words that are no keywords, are refused: a vertex
//   lost behind a damaged keyword would shift the indices of all others.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "meshes/formats/soup_faces.h"
#include "meshes/formats/strict_readers.h"
#include "meshes/formats/text_scanner.h"

namespace vex {
namespace {

using std::string_view_literals::operator""sv;

constexpr std::array kElements{"v"sv, "f"sv, "fo"sv, "l"sv, "p"sv};
constexpr std::array kSkipped{"vt"sv,       "vn"sv,       "vp"sv,         "vc"sv,       "g"sv,
                              "s"sv,        "mg"sv,       "mtllib"sv,     "usemtl"sv,   "maplib"sv,
                              "usemap"sv,   "lod"sv,      "bevel"sv,      "ctech"sv,    "stech"sv,
                              "c_interp"sv, "d_interp"sv, "shadow_obj"sv, "trace_obj"sv};
constexpr std::array kCurved{"cstype"sv, "deg"sv,  "bmat"sv, "step"sv, "curv"sv, "curv2"sv, "surf"sv,
                             "parm"sv,   "trim"sv, "hole"sv, "scrv"sv, "sp"sv,   "con"sv,   "bsp"sv,
                             "bzp"sv,    "cdc"sv,  "cdp"sv,  "res"sv,  "end"sv};

template <class Words>
bool is_among(std::string_view word, const Words& words) {
  return std::ranges::find(words, word) != words.end();
}

std::string_view keyword_of(std::string_view line) {
  const auto begin = std::ranges::find_if_not(line, TextScanner::is_blank);
  const auto end = std::find_if(begin, line.end(), TextScanner::is_blank);
  return {begin, end};
}

/// Takes a whole number from the front of `text` and holds it within +-2^40; false where there is none.
bool take_whole_number(std::string_view* text, std::int64_t* value) {
  constexpr std::int64_t kLargest = std::int64_t{1} << 40U;
  std::size_t at = text->starts_with('-') || text->starts_with('+') ? 1 : 0;
  const bool is_negative = at == 1 && text->front() == '-';
  const std::size_t begin = at;
  std::int64_t sum = 0;
  for (; at < text->size() && (*text)[at] >= '0' && (*text)[at] <= '9'; ++at) {
    sum = std::min(kLargest, 10 * sum + ((*text)[at] - '0'));
  }
  if (at == begin) return false;
  text->remove_prefix(at);
  *value = is_negative ? -sum : sum;
  return true;
}

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name) : scanner_(bytes, name), room_(bytes.size(), name) {}

  PolygonSoup soup() {
    while (scanner_.next_line()) read_line();
    if (soup_.points.empty()) scanner_.refuse("the file holds no vertex", "lines 'v x y z'", "check that it is .obj");
    if (largest_corner_ >= soup_.points.size() && largest_corner_line_ > 0) {
      refuse_text(scanner_.name(), largest_corner_line_,
                  "vertex " + std::to_string(std::size_t{largest_corner_} + 1) + " is not in the file",
                  "an index from 1 to " + std::to_string(soup_.points.size()));
    }
    end_part();
    soup_.n_parts = std::max<std::size_t>(soup_.n_parts, 1);
    soup_.digits = digits_.digits();
    return std::move(soup_);
  }

 private:
  static bool ends_in_backslash(std::string_view line) {
    while (!line.empty() && TextScanner::is_blank(line.back())) line.remove_suffix(1);
    return line.ends_with('\\');
  }

  void read_line() {
    const std::string_view line = scanner_.line();
    const std::size_t mark = line.find('#');
    const std::string_view code = line.substr(0, mark);
    const bool comment_was_open = std::exchange(comment_is_open_, false);
    if (mark != std::string_view::npos) {
      comment_is_open_ = ends_in_backslash(line);
      scanner_.put_line(code);
    } else if (ends_in_backslash(code)) {
      join_lines();
    }
    const std::string_view keyword = scanner_.next_word();
    if (keyword.empty()) return;
    if (comment_was_open && is_among(keyword, kElements)) {
      scanner_.refuse("the comment before ends in a backslash, so that this line is a part of it, or not",
                      "no backslash there");
    }
    if (keyword == "v") {
      read_vertex();
    } else if (keyword == "f" || keyword == "fo") {
      read_face();
    } else if (keyword == "l" || keyword == "p") {
      read_corners();
      soup_.corners.resize(soup_.corners.size() - n_corners_);
      ++soup_.n_ignored_faces;
    } else if (keyword == "o") {
      end_part();
    } else if (is_among(keyword, kCurved)) {
      scanner_.refuse(quoted(keyword) + " makes curves or surfaces that are no polygons", "v and f",
                      "export the body as polygons");
    } else if (keyword == "call" || keyword == "csh") {
      scanner_.refuse(quoted(keyword) + " runs another file", "v and f", "put what it makes into this file");
    } else if (!is_among(keyword, kSkipped)) {
      scanner_.refuse(quoted(keyword) + " is no keyword", "v, f or another keyword of .obj",
                      "mend the line, or take it out");
    }
  }

  /// Puts the line and those that it goes on in, as one, at hand.
  void join_lines() {
    std::string_view line = scanner_.line();
    const bool is_element = is_among(keyword_of(line), kElements);
    joined_.clear();
    for (bool goes_on = true; goes_on;) {
      joined_ += line.substr(0, line.rfind('\\'));
      if (!scanner_.next_line()) scanner_.refuse("the file ends behind a backslash", "the rest of the line");
      line = scanner_.line();
      const std::size_t mark = line.find('#');
      goes_on = mark == std::string_view::npos && ends_in_backslash(line);
      comment_is_open_ = mark != std::string_view::npos && ends_in_backslash(line);
      line = line.substr(0, mark);
      if (!is_element && is_among(keyword_of(line), kElements)) {
        scanner_.refuse("the line before ends in a backslash, so that this line is a part of it, or not",
                        "no backslash there");
      }
      const bool has_blank = joined_.empty() || line.empty() || TextScanner::is_blank(joined_.back()) ||
                             TextScanner::is_blank(line.front());
      if (is_element && !has_blank) {
        scanner_.refuse("the line before ends in a backslash within a word, or behind one", "a blank there");
      }
      joined_ += ' ';
    }
    joined_ += line;
    scanner_.put_line(joined_);
  }

  void read_vertex() {
    room_.require(soup_.points.size() + 1, soup_.corners.size());
    constexpr const char* kExpected = "v x y z";
    Vec3d& point = soup_.points.emplace_back();
    point.x = scanner_.coordinate(kExpected, digits_);
    point.y = scanner_.coordinate(kExpected, digits_);
    point.z = scanner_.coordinate(kExpected, digits_);
    if (!scanner_.has_word()) return;
    constexpr const char* kMore = "v x y z, a weight of 1, a colour or nothing behind";
    const double fourth = scanner_.number(kMore);
    std::size_t n_numbers = 4;
    for (; scanner_.has_word(); ++n_numbers) scanner_.number(kMore);
    if (n_numbers == 5 || n_numbers > 7)
      scanner_.refuse("a vertex of " + std::to_string(n_numbers) + " numbers", kMore);
    if (n_numbers == 4 && fourth != 1.0) {
      scanner_.refuse("the vertex has a weight other than 1, which readers apply, or not", kMore,
                      "divide x, y, z by the weight, or take it out");
    }
  }

  void read_face() {
    read_corners();
    if (n_corners_ < 3) {
      soup_.corners.resize(soup_.corners.size() - n_corners_);
      ++soup_.n_ignored_faces;
      return;
    }
    soup_.face_sizes.push_back(static_cast<std::uint32_t>(n_corners_));
    part_has_faces_ = true;
  }

  /// Adds what the line names, one corner at least.
  void read_corners() {
    n_corners_ = 0;
    for (std::string_view word = scanner_.next_word(); !word.empty(); word = scanner_.next_word()) {
      room_.require(soup_.points.size(), soup_.corners.size() + 1);
      soup_.corners.push_back(corner(word));
      ++n_corners_;
    }
    if (n_corners_ == 0) scanner_.refuse("no vertex is named", "vertex indices");
  }

  std::uint32_t corner(std::string_view word) {
    std::string_view rest = word;
    std::int64_t index = 0;
    std::int64_t other = 0;
    bool is_corner = take_whole_number(&rest, &index);
    for (int k = 0; is_corner && k < 2 && rest.starts_with('/'); ++k) {
      rest.remove_prefix(1);
      is_corner = rest.empty() || rest.starts_with('/') || take_whole_number(&rest, &other);
    }
    if (!is_corner || !rest.empty()) {
      scanner_.refuse(quoted(word) + " is no corner", "whole numbers: v, v/vt, v//vn or v/vt/vn");
    }
    const auto n_points = static_cast<std::int64_t>(soup_.points.size());
    const std::int64_t from_zero = index < 0 ? n_points + index : index - 1;
    if (from_zero < 0 || from_zero >= static_cast<std::int64_t>(kMostSoupPoints)) {
      scanner_.refuse(quoted(word) + " names no vertex",
                      "an index from 1, or from -1 down to -" + std::to_string(n_points) + " here");
    }
    const auto result = static_cast<std::uint32_t>(from_zero);
    if (largest_corner_line_ == 0 || result > largest_corner_) {
      largest_corner_ = result;
      largest_corner_line_ = scanner_.line_number();
    }
    return result;
  }

  void end_part() {
    if (std::exchange(part_has_faces_, false)) ++soup_.n_parts;
  }

  TextScanner scanner_;
  SoupRoom room_;
  PolygonSoup soup_;
  WrittenDigits digits_;
  std::string joined_;            // the line at hand, where it is of several
  bool comment_is_open_ = false;  // the line before ended in a comment and a backslash
  bool part_has_faces_ = false;   // since the last 'o'
  std::size_t n_corners_ = 0;     // of the last element
  std::uint32_t largest_corner_ = 0;
  std::size_t largest_corner_line_ = 0;  // 0: there is none yet
};

}  // namespace

PolygonSoup read_obj(std::string_view bytes, const std::string& name) { return ObjReader(bytes, name).soup(); }

}  // namespace vex
