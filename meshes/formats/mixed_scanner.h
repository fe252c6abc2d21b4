// Goes through a file whose numbers are text or binary, and whose words are text: .ply, .stl, .vtk and .msh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "meshes/formats/coordinate_text.h"
#include "meshes/formats/scalar_type.h"

namespace vex {

/// How a file writes its numbers.
enum class Encoding : std::uint8_t { text, little_endian, big_endian };

/// What should stand somewhere, for messages: "a coordinate of vertex 17, counted from 0".
struct Expected {
  static constexpr std::uint64_t kNoNumber = ~std::uint64_t{0};

  Expected(const char* wanted, std::uint64_t index = kNoNumber)  // NOLINT(google-explicit-constructor): a text
      : what(wanted), number(index) {}
  std::string text() const;

  const char* what;
  std::uint64_t number;
};

/// Refers to the bytes, which must outlive it. In text, words are parted by blanks, tabs, vertical tabs, form feeds and
/// the ends of lines, which are LF, CR LF or CR. Every refusal is an InputError that names the line of a text, or the
/// byte of a binary file, counted from 0.
class MixedScanner {
 public:
  MixedScanner(std::string_view bytes, std::string name, Encoding encoding = Encoding::text, std::size_t begin = 0);

  void set_encoding(Encoding encoding);
  bool is_text() const { return is_text_; }
  std::size_t n_left() const { return bytes_.size() - at_; }
  std::string_view rest() const { return bytes_.substr(at_); }
  const std::string& name() const { return name_; }

  /// The next word, in this line or a later one; empty where there is none. Words are text in binary files too.
  std::string_view next_word() {
    const std::size_t size = bytes_.size();
    std::size_t at = at_;
    while (at < size && is_space(bytes_[at])) ++at;
    begin_of_last_ = at;
    while (at < size && !is_space(bytes_[at])) ++at;
    at_ = at;
    return {bytes_.data() + begin_of_last_, at - begin_of_last_};
  }
  /// The next word as a whole number from `least` to `most`.
  std::int64_t whole_word(const Expected& expected, std::int64_t least, std::int64_t most);
  /// What is left of the line, without blanks around it; goes behind the line's end.
  std::string_view rest_of_line();
  /// Goes behind the end of the line; refuses anything but blanks before it. In a binary file a line ends in LF or
  /// CR LF, behind which the next byte may be a number's.
  void end_line(const Expected& expected);
  /// Goes back to where `word`, a part of the file's bytes, begins.
  void back_to(std::string_view word) { at_ = static_cast<std::size_t>(word.data() - bytes_.data()); }

  /// The next number, a finite one, noted for digits().
  double coordinate(ScalarType type, const Expected& expected);
  std::int64_t whole_number(ScalarType type, const Expected& expected, std::int64_t least, std::int64_t most);
  /// Goes behind `n` numbers, whatever they are.
  void skip(ScalarType type, std::uint64_t n, const Expected& expected);
  /// The next n * size bytes.
  std::string_view take(std::uint64_t n, std::size_t size, const Expected& expected);

  /// Of all coordinates so far.
  CoordinateDigits digits() const;

  /// About what was read last.
  [[noreturn]] void refuse(const std::string& problem, const std::string& expected,
                           const std::string& advice = "mend the file") const;

 private:
  /// Called for each number.
  void end_now_and_then_if_interrupted();
  static constexpr bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  std::string_view bytes_;
  std::string name_;
  std::size_t at_;
  std::size_t begin_of_last_;  // the word or number that was read last
  bool is_text_ = true;
  bool swapped_ = false;
  WrittenDigits written_;
  double largest_ = 0.0;  // of all binary magnitudes
  bool any_float_ = false;
  unsigned n_numbers_ = 0;
};

}  // namespace vex
