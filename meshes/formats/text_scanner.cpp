#include "meshes/formats/text_scanner.h"

#include <charconv>
#include <system_error>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"

namespace vex {

void refuse_text(const std::string& name, std::size_t line, const std::string& problem, const std::string& expected,
                 const std::string& advice) {
  throw InputError(problem + " (" + name + ", line " + std::to_string(line) + ": expected " + expected + ") - " +
                   advice);
}

std::string printable_word(std::string_view word) {
  constexpr std::size_t kMost = 40;
  std::string text;
  for (const char c : word.substr(0, kMost)) text += c < ' ' || c > '~' ? '?' : c;
  // In messages " - " comes before the advice, and nowhere else.
  for (std::size_t at = text.find(" - "); at != std::string::npos; at = text.find(" - ", at)) text[at] = '?';
  return text + (word.size() > kMost ? "..." : "");
}

std::string quoted(std::string_view word) { return "'" + printable_word(word) + "'"; }

std::string_view TextScanner::trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

TextScanner::TextScanner(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
  next_feed_ = std::min(text_.find('\n'), text_.size());
  next_return_ = std::min(text_.find('\r'), text_.size());
}

bool TextScanner::next_line() {
  if (next_ >= text_.size()) {
    put_line({});
    return false;
  }
  // Each kind of end is looked for again only once it has been passed: a text has as a rule but one of them.
  if (next_feed_ < next_) next_feed_ = std::min(text_.find('\n', next_), text_.size());
  if (next_return_ < next_) next_return_ = std::min(text_.find('\r', next_), text_.size());
  const std::size_t end = std::min(next_feed_, next_return_);
  put_line(text_.substr(next_, end - next_));
  next_ = std::min(text_.size(), end + (next_return_ + 1 == next_feed_ ? 2 : 1));
  if (++line_number_ % 256 == 0) end_if_interrupted();
  if (line_number_ == 1 && (line_.starts_with("\xFF\xFE") || line_.starts_with("\xFE\xFF"))) {
    refuse("the text is in UTF-16", "ASCII or UTF-8", "save it in UTF-8");
  }
  return true;
}

bool TextScanner::next_line_of_content() {
  while (next_line()) {
    put_line(line_.substr(0, line_.find('#')));
    if (has_word()) return true;
  }
  return false;
}

double TextScanner::coordinate(const char* expected, WrittenDigits& digits) {
  const std::string_view word = next_word();
  const std::optional<double> value = digits.parse(word);
  if (!value) refuse_number(word, expected);
  return *value;
}

double TextScanner::number(const char* expected) {
  const std::string_view word = next_word();
  const std::optional<double> value = parse_decimal(word);
  if (!value) refuse_number(word, expected);
  return *value;
}

std::int64_t TextScanner::signed_whole_number(std::string_view word, const char* expected, std::int64_t least,
                                              std::int64_t most) const {
  if (word.empty()) refuse("a number is missing", expected);
  const std::string_view shown = word;
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  std::int64_t value = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) refuse(quoted(shown) + " is no whole number", expected);
  if (error != std::errc{} || value < least || value > most) {
    refuse(quoted(shown) + " is out of range",
           std::string(expected) + " from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return value;
}

void TextScanner::refuse(const std::string& problem, const std::string& expected, const std::string& advice) const {
  refuse_text(name_, line_number_, problem, expected, advice);
}

void TextScanner::refuse_number(std::string_view word, const char* expected) const {
  refuse(word.empty() ? "a number is missing" : quoted(word) + " is no finite decimal number", expected);
}

}  // namespace vex
