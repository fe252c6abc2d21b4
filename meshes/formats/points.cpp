// Points as text, one in a line: .xyz, .csv, .txt. The first line settles what parts the fields (semicolons, else
// commas, else blanks and tabs) and how many there are; every line must have as many.
//
// - x, y, z are the columns of these names, where a line of words, or a comment, before the points names each once (or
//   Points:0, :1, :2); the first three otherwise. What stands in other columns is ignored where they have names, and
//   must be a number where they have none.
// - A first line that is one whole number is the number of points. In the .xyz files of chemistry a line of comment
//   follows, and then an atom in each line: C x y z.
// - What may mean something else is refused: commas that may be decimal ones, first columns that may be row numbers.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "meshes/formats/soup_faces.h"
#include "meshes/formats/strict_readers.h"
#include "meshes/formats/text_scanner.h"

namespace vex {
namespace {

constexpr std::size_t kMostFields = 10'000;  // of a line: what is left of it then counts as one
constexpr const char* kOnePoint = "a point: three numbers or more, x, y, z first";

using Fields = std::vector<std::string_view>;

bool is_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_number(std::string_view text) { return parse_decimal(text).has_value(); }

char lower_letter(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool is_same(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, lower_letter, lower_letter);
}

/// Whether the field may be a column's name, or is empty: nothing that could be meant for a number.
bool is_name(std::string_view field) {
  if (field.empty()) return true;
  const bool is_word = is_letter(field.front()) || field.front() == '_' || static_cast<unsigned char>(field[0]) > 127;
  return is_word && !is_same(field, "nan") && !is_same(field, "inf") && !is_same(field, "infinity");
}

bool is_comment(std::string_view line) { return line.starts_with('#') || line.starts_with("//"); }

char separator_of(std::string_view line) {
  return line.find(';') != std::string_view::npos ? ';' : line.find(',') != std::string_view::npos ? ',' : ' ';
}

/// Parts a line by `separator`, ' ' meaning blanks and tabs. Between others, a field may stand in quotation marks,
/// which are taken off.
void split(std::string_view line, char separator, Fields* fields) {
  fields->clear();
  line = TextScanner::trimmed(line);
  if (separator == ' ') {
    while (!line.empty() && fields->size() <= kMostFields) {
      const auto end = static_cast<std::size_t>(std::ranges::find_if(line, TextScanner::is_blank) - line.begin());
      fields->push_back(line.substr(0, end));
      line = TextScanner::trimmed(line.substr(end));
    }
    return;
  }
  for (bool is_more = true; is_more;) {
    line = TextScanner::trimmed(line);
    const std::size_t close = line.starts_with('"') ? line.find('"', 1) : 0;
    const std::size_t end = close == std::string_view::npos ? close : line.find(separator, close);
    std::string_view field = TextScanner::trimmed(line.substr(0, end));
    if (field.size() > 1 && field.starts_with('"') && field.ends_with('"')) {
      field = TextScanner::trimmed(field.substr(1, field.size() - 2));
    }
    fields->push_back(field);
    is_more = end != std::string_view::npos && fields->size() <= kMostFields;
    if (is_more) line.remove_prefix(end + 1);
  }
}

/// Which columns the three coordinates are.
using Columns = std::array<std::size_t, 3>;

/// Where `names` has each of x, y, z once; nothing otherwise.
std::optional<Columns> named_columns(const Fields& names) {
  constexpr std::array<std::array<std::string_view, 3>, 3> kNames{
      {{"x", "y", "z"}, {"points:0", "points:1", "points:2"}, {"points_0", "points_1", "points_2"}}};
  for (const auto& known : kNames) {
    Columns columns{};
    bool has_all = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto is_it = [&](std::string_view name) { return is_same(name, known[axis]); };
      const auto found = std::ranges::find_if(names, is_it);
      has_all = has_all && std::ranges::count_if(names, is_it) == 1;
      columns[axis] = static_cast<std::size_t>(found - names.begin());
    }
    if (has_all) return columns;
  }
  return std::nullopt;
}

class PointsReader {
 public:
  PointsReader(std::string_view bytes, const std::string& name) : scanner_(bytes, name), room_(bytes.size(), name) {}

  PolygonSoup soup() {
    if (!next_line()) scanner_.refuse("the file holds no point", kOnePoint);
    if (is_digits(TextScanner::trimmed(scanner_.line()))) {
      read_counted();
    } else {
      read_lines();
    }
    if (soup_.points.empty()) scanner_.refuse("the file holds no point", kOnePoint);
    soup_.n_parts = 1;
    soup_.digits = digits_.digits();
    return std::move(soup_);
  }

 private:
  /// The next line that is neither blank nor a comment. A comment that names columns is kept in mind.
  bool next_line() {
    while (scanner_.next_line()) {
      const std::string_view line = scanner_.rest_of_line();
      if (line.empty()) continue;
      if (!is_comment(line)) {
        scanner_.put_line(TextScanner::trimmed(line.substr(0, line.find('#'))));
        return true;
      }
      if (soup_.points.empty()) note_comment(line);
    }
    return false;
  }

  void note_comment(std::string_view line) {
    const std::size_t begin = std::min(line.find_first_not_of("#/"), line.size());
    line = TextScanner::trimmed(line.substr(begin));
    split(line, separator_of(line), &fields_);
    if (const auto columns = named_columns(fields_)) {
      columns_of_comment_ = *columns;
      n_named_in_comment_ = fields_.size();
    }
  }

  /// From the line at hand on, which settles what all are like.
  void read_lines() {
    separator_ = separator_of(scanner_.line());
    split(scanner_.line(), separator_, &fields_);
    n_fields_ = fields_.size();
    if (n_fields_ > kMostFields) {
      scanner_.refuse("a line of more than " + std::to_string(kMostFields) + " fields", kOnePoint,
                      "put each point on a line of its own");
    }
    const bool is_header = std::ranges::all_of(fields_, is_name);
    if (n_fields_ < 3) {
      scanner_.refuse("a line of " + std::to_string(n_fields_) + (n_fields_ == 1 ? " field" : " fields"), kOnePoint);
    }
    if (is_header) {
      take_header();
      if (!next_line()) return;
    } else if (n_named_in_comment_ == n_fields_) {
      has_names_ = true;
      columns_ = columns_of_comment_;
    }
    do {
      read_point();
    } while (next_line());
    if (!has_names_ && n_fields_ > 3) refuse_what_may_be_else();
  }

  void take_header() {
    has_names_ = true;
    const auto columns = named_columns(fields_);
    if (!columns) {
      scanner_.refuse("the columns' names do not say which are the coordinates", "x, y and z, once each, among them",
                      "name them");
    }
    columns_ = *columns;
  }

  void read_point() {
    split(scanner_.line(), separator_, &fields_);
    if (fields_.size() != n_fields_) {
      scanner_.refuse("a line of " + std::to_string(fields_.size()) + (fields_.size() == 1 ? " field" : " fields"),
                      std::to_string(n_fields_) + " as in the lines before",
                      "mend the file; decimals have a point, not a comma");
    }
    room_.require(soup_.points.size() + 1, soup_.corners.size());
    Vec3d point;
    double* const axes[] = {&point.x, &point.y, &point.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string_view field = fields_[columns_[axis]];
      const std::optional<double> value = digits_.parse(field);
      if (!value) refuse_field(field);
      *axes[axis] = *value;
    }
    if (!has_names_ && n_fields_ > 3) note_other_columns();
    soup_.points.push_back(point);
  }

  void note_other_columns() {
    for (std::size_t k = 3; k < n_fields_; ++k) {
      const bool is_open_end = separator_ != ' ' && k + 1 == n_fields_ && fields_[k].empty();
      if (!is_open_end && !is_number(fields_[k])) refuse_field(fields_[k]);
    }
    const auto is_whole = [](std::string_view field) { return field.find_first_of(".eE") == std::string_view::npos; };
    all_are_whole_ = all_are_whole_ && std::ranges::all_of(fields_, is_whole);
    are_rows_ = are_rows_ && is_digits(fields_[0]);
    has_other_than_whole_ = has_other_than_whole_ || !is_digits(fields_[1]) || !is_digits(fields_[2]);
  }

  void refuse_what_may_be_else() {
    const char* const advice = "name the columns in a first line, such as x,y,z,value";
    if (separator_ == ',' && all_are_whole_) {
      scanner_.refuse("the commas may part fields, or be decimal commas", "a decimal point somewhere, or names",
                      advice);
    }
    if (are_rows_ && has_other_than_whole_ && are_all_different()) {
      scanner_.refuse("the first column holds whole numbers alone, so that it may be x, or number the points",
                      "x, y, z first", advice);
    }
  }

  /// Of the first coordinates.
  bool are_all_different() const {
    std::vector<double> sorted;
    for (const Vec3d& p : soup_.points) sorted.push_back(p.x);
    std::ranges::sort(sorted);
    return std::ranges::adjacent_find(sorted) == sorted.end();
  }

  /// The line at hand is a number of points, or of atoms.
  void read_counted() {
    const std::size_t count_line = scanner_.line_number();
    const double count = parse_decimal(scanner_.next_word()).value_or(HUGE_VAL);
    TextScanner ahead = scanner_;
    const bool has_second = ahead.next_line();
    const std::string_view second = ahead.line();
    ahead.next_line();
    const std::string_view third = ahead.rest_of_line();
    split(second, separator_of(second), &fields_);
    const bool is_second_a_point = fields_.size() >= 3 && is_number(fields_[0]);
    if (!third.empty() && is_letter(third.front())) {
      read_atoms(count);
    } else if (has_second) {
      if (!is_second_a_point) scanner_.next_line();  // a comment
      if (next_line()) read_lines();
      if (!is_second_a_point && !has_names_ && n_fields_ > 3) {
        scanner_.refuse("the first column may be x, or the numbers of elements", "three numbers in each line",
                        "take out the other columns");
      }
    }
    if (static_cast<double>(soup_.points.size()) != count) {
      refuse_text(scanner_.name(), count_line,
                  "the count does not hold: the file has " + std::to_string(soup_.points.size()) + " points",
                  "their number");
    }
  }

  void read_atoms(double count) {
    scanner_.next_line();
    const std::size_t properties = scanner_.line().find("Properties=");
    if (properties != std::string_view::npos &&
        !scanner_.line().substr(properties + 11).starts_with("species:S:1:pos:R:3")) {
      scanner_.refuse("the columns come in another order", "Properties=species:S:1:pos:R:3 first",
                      "put the species and the position first");
    }
    while (static_cast<double>(soup_.points.size()) < count && scanner_.next_line()) {
      const std::string_view label = scanner_.next_word();
      if (label.empty() || !is_letter(label.front())) scanner_.refuse("there is no atom", "C x y z");
      room_.require(soup_.points.size() + 1, soup_.corners.size());
      Vec3d& point = soup_.points.emplace_back();
      point.x = scanner_.coordinate("C x y z", digits_);
      point.y = scanner_.coordinate("C x y z", digits_);
      point.z = scanner_.coordinate("C x y z", digits_);
      are_rows_ = are_rows_ && point.x == static_cast<double>(soup_.points.size()) && is_number(scanner_.next_word());
    }
    if (are_rows_ && !soup_.points.empty()) {
      scanner_.refuse("the numbers behind the labels count the atoms, so that x may be the first or the second",
                      "C x y z", "take out the other columns");
    }
    while (scanner_.next_line()) {
      if (!scanner_.rest_of_line().empty()) {
        scanner_.refuse("there is more than " + std::to_string(soup_.points.size()) + " atoms", "the end of the file",
                        "mend the count, or keep one frame of several");
      }
    }
  }

  [[noreturn]] void refuse_field(std::string_view field) {
    scanner_.refuse(field.empty() ? "a field is empty" : quoted(field) + " is no finite decimal number", kOnePoint,
                    "mend the file; decimals have a point, not a comma");
  }

  TextScanner scanner_;
  SoupRoom room_;
  PolygonSoup soup_;
  WrittenDigits digits_;
  Fields fields_;  // of the line at hand
  Columns columns_{0, 1, 2};
  Columns columns_of_comment_{};
  char separator_ = ' ';
  std::size_t n_fields_ = 0;            // of every line
  std::size_t n_named_in_comment_ = 0;  // columns; 0 where no comment names x, y, z
  bool has_names_ = false;
  bool all_are_whole_ = true;          // no number of the file has a point or an exponent
  bool are_rows_ = true;               // the first column holds whole numbers without a sign
  bool has_other_than_whole_ = false;  // in the second or third column
};

}  // namespace

PolygonSoup read_points(std::string_view bytes, const std::string& name) { return PointsReader(bytes, name).soup(); }

}  // namespace vex
