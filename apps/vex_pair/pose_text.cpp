#include "apps/vex_pair/pose_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/quaternion.h"

namespace vex {
namespace {

constexpr std::array<std::string_view, 12> kMatrixColumns = {"r11", "r12", "r13", "r21", "r22", "r23",
                                                             "r31", "r32", "r33", "tx",  "ty",  "tz"};
constexpr std::array<std::string_view, 7> kQuaternionColumns = {"tx", "ty", "tz", "qw", "qx", "qy", "qz"};

std::span<const std::string_view> columns_of(PoseFormat format) {
  if (format == PoseFormat::matrix) return kMatrixColumns;
  return kQuaternionColumns;
}

std::string_view without_blanks(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// Takes the text up to the next comma off the line; none where nothing is left.
class Cells {
 public:
  explicit Cells(std::string_view line) : rest_(line) {}

  std::optional<std::string_view> next() {
    if (!rest_) return std::nullopt;
    const std::size_t comma = rest_->find(',');
    const std::string_view cell = without_blanks(rest_->substr(0, comma));
    if (comma == std::string_view::npos) {
      rest_.reset();
    } else {
      rest_->remove_prefix(comma + 1);
    }
    return cell;
  }

 private:
  std::optional<std::string_view> rest_;
};

std::size_t number_of_cells(std::string_view line) {
  return static_cast<std::size_t>(std::ranges::count(line, ',')) + 1;
}

// What a message quotes: not more than a reader takes in, and no character that ends a message.
std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  return "\"" + printable(first_bytes(text, kLongest)) + (text.size() > kLongest ? "...\"" : "\"");
}

enum class Reading { a_number, not_a_number, not_finite, out_of_range };

Reading read_number(std::string_view text, double& value) {
  bool negative = false;
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
    negative = text.front() == '-';
    text.remove_prefix(1);
  }
  std::chars_format format = std::chars_format::general;
  if (text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X')) {
    text.remove_prefix(2);
    format = std::chars_format::hex;
  }
  if (text.empty() || text.front() == '-' || text.front() == '+') return Reading::not_a_number;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, format);
  if (error == std::errc::invalid_argument || end != text.data() + text.size()) return Reading::not_a_number;
  if (error != std::errc{}) return Reading::out_of_range;
  if (!std::isfinite(value)) return Reading::not_finite;
  if (negative) value = -value;
  return Reading::a_number;
}

// An empty text where it is a number.
std::string problem_of(Reading reading, std::string_view text, std::string_view name) {
  const std::string where = " (" + quoted(text) + " for " + std::string(name) + ") - ";
  switch (reading) {
    case Reading::a_number: return "";
    case Reading::not_a_number: return "not a number" + where + "write it like 0.5, 1e-3 or 0x1.8p-3";
    case Reading::not_finite: return "not finite" + where + "give a finite number";
    case Reading::out_of_range: break;
  }
  return "out of the range of doubles" + where + "choose another unit of length";
}

Transformd with_translation(Transformd rotation, const Vec3d& translation) {
  rotation.translation = translation;
  return rotation;
}

}  // namespace

double pose_number(std::string_view text, std::string_view name) {
  double value = 0.0;
  const std::string_view word = without_blanks(text);
  const Reading reading = read_number(word, value);
  if (reading == Reading::a_number) return value;
  const std::string problem = problem_of(reading, word, name);
  if (reading == Reading::not_a_number) throw UsageError(problem);
  throw InputError(problem);
}

void read_numbers(std::string_view text, std::string_view option, std::span<double> numbers) {
  if (const std::size_t n = number_of_cells(text); n != numbers.size()) {
    throw UsageError("wrong number of numbers (" + std::to_string(n) + " for " + std::string(option) + ") - give " +
                     std::to_string(numbers.size()) + ", separated by commas");
  }
  Cells cells(text);
  for (double& number : numbers) number = pose_number(*cells.next(), option);
}

PoseFormat format_of_header(std::string_view line) {
  const std::string advice = std::string(" - the first line is ") + kHeaders;
  const std::string_view first = *Cells(line).next();
  double ignored = 0.0;
  if (read_number(first, ignored) == Reading::a_number) {
    throw InputError("the header is missing (a row of numbers, " + quoted(line) + ")" + advice);
  }
  const PoseFormat format = first == kMatrixColumns.front() ? PoseFormat::matrix : PoseFormat::quaternion;
  Cells cells(line);
  for (const std::string_view expected : columns_of(format)) {
    const std::optional<std::string_view> cell = cells.next();
    if (cell != expected) {
      throw InputError("not a header of poses (" + (cell ? quoted(*cell) : "nothing") + " where " +
                       std::string(expected) + " is expected)" + advice);
    }
  }
  if (const std::optional<std::string_view> more = cells.next()) {
    throw InputError("not a header of poses (a further column " + quoted(*more) + ")" + advice);
  }
  return format;
}

Transformd pose_of_row(std::string_view line, PoseFormat format) {
  const std::span<const std::string_view> columns = columns_of(format);
  if (without_blanks(line).empty()) {
    throw InputError("an empty row (it has no numbers) - remove it");
  }
  if (const std::size_t n = number_of_cells(line); n != columns.size()) {
    throw InputError("wrong number of columns (" + std::to_string(n) + ") - the header has " +
                     std::to_string(columns.size()));
  }
  std::array<double, 12> numbers{};
  Cells cells(line);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::string_view cell = *cells.next();
    const Reading reading = read_number(cell, numbers[k]);
    if (reading != Reading::a_number) throw InputError(problem_of(reading, cell, columns[k]));
  }
  if (format == PoseFormat::matrix) return pose_of_matrix(numbers);
  return pose_of_quaternion({numbers[3], numbers[4], numbers[5], numbers[6]}, {numbers[0], numbers[1], numbers[2]});
}

Transformd pose_of_matrix(const std::array<double, 12>& numbers) {
  const auto vec = [&numbers](std::size_t k) { return Vec3d{numbers[k], numbers[k + 1], numbers[k + 2]}; };
  const Transformd pose{vec(0), vec(3), vec(6), vec(9)};
  return Pose(pose).a_from_b();
}

Transformd pose_of_quaternion(const std::array<double, 4>& wxyz, const Vec3d& translation) {
  const auto [w, x, y, z] = wxyz;
  return with_translation(rotation_from_quaternion(w, x, y, z), translation);
}

}  // namespace vex
