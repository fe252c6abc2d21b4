// Words and lines of a text file, with line numbers for messages.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/numeric/vec3.h"
#include "meshes/formats/coordinate_text.h"

namespace vex {

/// Throws InputError: "problem (name, line 12: expected ...) - advice".
[[noreturn]] void refuse_text(const std::string& name, std::size_t line, const std::string& problem,
                              const std::string& expected, const std::string& advice = "mend the file");

/// A word of a file as messages show it: printable, not too long, and without the " - " that comes before advice.
std::string printable_word(std::string_view word);
/// The same in quotes.
std::string quoted(std::string_view word);

/// Goes through a text once. Lines end in LF, CR LF or CR. A byte-order mark of UTF-8 at the beginning is skipped, one
/// of UTF-16 refused. Refers to the text, which must outlive it.
class TextScanner {
 public:
  /// What parts words: blanks, tabs, vertical tabs and form feeds.
  static constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  /// Without blanks at either end.
  static std::string_view trimmed(std::string_view text);

  TextScanner(std::string_view text, std::string name);

  /// Puts the next line, without its end, into line() and its first word at hand; false where there is no more.
  bool next_line();
  /// Puts the next line that is more than blanks and a comment, without its comment, which begins with '#' wherever
  /// that stands; false where there is no more.
  bool next_line_of_content();
  /// Puts `line` in the place of the line, and its first word at hand. It must outlive the reading of it.
  void put_line(std::string_view line) {
    line_ = line;
    at_ = 0;
  }
  /// The next word of the line; empty where there is none.
  std::string_view next_word() {
    skip_blanks();
    std::size_t end = at_;
    while (end < line_.size() && !is_blank(line_[end])) ++end;
    const std::size_t begin = at_;
    at_ = end;
    return line_.substr(begin, end - begin);
  }
  /// Whether the line has another word.
  bool has_word() {
    skip_blanks();
    return at_ < line_.size();
  }
  /// What is left of the line, from the next word on; without blanks at its end.
  std::string_view rest_of_line() const { return trimmed(line_.substr(at_)); }
  /// What is left of the text behind this line.
  std::string_view rest_of_text() const { return text_.substr(next_); }
  std::string_view line() const { return line_; }
  std::size_t line_number() const { return line_number_; }  // from 1; behind the last line, the last line's
  const std::string& name() const { return name_; }

  /// next_word() as a coordinate, noted in `digits`; refuses what is none, or missing.
  double coordinate(const char* expected, WrittenDigits& digits);
  /// next_word() as a number that is no coordinate; refuses what is none, or missing.
  double number(const char* expected);
  /// next_word() as a whole number from `least` to `most`; refuses what is none.
  std::int64_t whole_number(const char* expected, std::int64_t least, std::int64_t most) {
    skip_blanks();
    std::int64_t value = 0;
    std::size_t end = at_;
    const std::size_t most_end = std::min(line_.size(), at_ + 18);  // no overflow so far
    for (; end < most_end && line_[end] >= '0' && line_[end] <= '9'; ++end) value = 10 * value + (line_[end] - '0');
    const bool is_word = end > at_ && (end == line_.size() || is_blank(line_[end]));
    if (!is_word || value < least || value > most) return signed_whole_number(next_word(), expected, least, most);
    at_ = end;
    return value;
  }

  [[noreturn]] void refuse(const std::string& problem, const std::string& expected,
                           const std::string& advice = "mend the file") const;

 private:
  void skip_blanks() {
    std::size_t at = at_;
    while (at < line_.size() && is_blank(line_[at])) ++at;
    at_ = at;
  }
  std::int64_t signed_whole_number(std::string_view word, const char* expected, std::int64_t least,
                                   std::int64_t most) const;
  [[noreturn]] void refuse_number(std::string_view word, const char* expected) const;

  std::string_view text_;
  std::string name_;
  std::size_t next_ = 0;         // where the next line begins
  std::size_t next_feed_ = 0;    // the first \n from there on, or the text's end
  std::size_t next_return_ = 0;  // the first \r, likewise
  std::size_t line_number_ = 0;
  std::string_view line_;
  std::size_t at_ = 0;  // in the line
};

}  // namespace vex
