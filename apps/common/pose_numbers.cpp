#include "apps/common/pose_numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "apps/common/text.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/quaternion.h"

namespace vex {
namespace {

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
  const std::string where = " (" + in_quotation_marks(text) + " for " + std::string(name) + ") - ";
  switch (reading) {
    case Reading::a_number: return "";
    case Reading::not_a_number: return "not a number" + where + "write it like 0.5, 1e-3 or 0x1.8p-3";
    case Reading::not_finite: return "not finite" + where + "give a finite number";
    case Reading::out_of_range: break;
  }
  return "out of the range of doubles" + where + "choose another unit";
}

Transformd with_translation(Transformd rotation, const Vec3d& translation) {
  rotation.translation = translation;
  return rotation;
}

}  // namespace

std::string_view without_blanks(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string in_quotation_marks(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  return "\"" + printable(first_bytes(text, kLongest)) + (text.size() > kLongest ? "...\"" : "\"");
}

bool is_a_number(std::string_view text) {
  double ignored = 0.0;
  return read_number(text, ignored) == Reading::a_number;
}

double pose_number(std::string_view text, std::string_view name) {
  double value = 0.0;
  const std::string_view word = without_blanks(text);
  const Reading reading = read_number(word, value);
  if (reading == Reading::a_number) return value;
  const std::string problem = problem_of(reading, word, name);
  if (reading == Reading::not_a_number) throw UsageError(problem);
  throw InputError(problem);
}

double cell_number(std::string_view cell, std::string_view column) {
  double value = 0.0;
  const std::string_view word = without_blanks(cell);
  const Reading reading = read_number(word, value);
  if (reading != Reading::a_number) throw InputError(problem_of(reading, word, column));
  return value;
}

void read_numbers(std::string_view text, std::string_view option, std::span<double> numbers) {
  const std::size_t n = static_cast<std::size_t>(std::ranges::count(text, ',')) + 1;
  if (n != numbers.size()) {
    throw UsageError("wrong number of numbers (" + std::to_string(n) + " for " + std::string(option) + ") - give " +
                     std::to_string(numbers.size()) + ", separated by commas");
  }
  for (double& number : numbers) {
    const std::size_t comma = text.find(',');
    number = pose_number(text.substr(0, comma), option);
    if (comma != std::string_view::npos) text.remove_prefix(comma + 1);
  }
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
