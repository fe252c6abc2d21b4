#include "engine/sampling/poses/orientation_law_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/sampling/poses/axis_table_text.h"

namespace vex {
namespace {

/// Of a law's text; the option that it is the value of is named where there is one.
struct LawText {
  std::string_view text, option;

  [[noreturn]] void refuse(const char* problem, std::string_view part, std::string_view advice) const {
    throw UsageError(std::string(problem) + " (\"" + std::string(part) + "\"" +
                     (option.empty() ? "" : " for " + std::string(option)) + ") - " + std::string(advice));
  }
  [[noreturn]] void refuse(const char* problem, std::string_view advice) const { refuse(problem, text, advice); }

  double number(std::string_view word) const {
    double value = 0.0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || stop != word.data() + word.size() || !std::isfinite(value)) {
      refuse("not a number", word, "write it like 0.5 or 1e-3");
    }
    return value;
  }

  std::vector<double> numbers(std::string_view list) const {
    std::vector<double> found;
    while (true) {
      const std::size_t comma = list.find(',');
      found.push_back(number(list.substr(0, comma)));
      if (comma == std::string_view::npos) return found;
      list = list.substr(comma + 1);
    }
  }
};

constexpr std::string_view kTable = "table:";
constexpr const char* kAxisLaws = "isotropic, aligned, cone:DEG, onsager:ALPHA, maier-saupe:A, table:FILE";

struct Word {
  std::string_view name;
  std::optional<std::string_view> value;
};

Word split(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return {text, std::nullopt};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

/// Nothing where the text is no law of an axis.
std::optional<AxisLaw> axis_law(const LawText& law) {
  if (law.text == "isotropic") return AxisLaw();
  if (law.text == "aligned") return AxisLaw::aligned();
  if (const std::optional<std::string> file = file_of_law(law.text)) {
    if (file->empty()) law.refuse("a table without a file", "write table:FILE");
    return AxisLaw::table(read_axis_table(*file));
  }
  const auto [name, value] = split(law.text);
  if (!value || (name != "cone" && name != "onsager" && name != "maier-saupe")) return std::nullopt;
  const std::vector<double> numbers = law.numbers(*value);
  if (numbers.size() != 1) law.refuse("more than one number", "write cone:DEG, onsager:ALPHA or maier-saupe:A");
  const double number = numbers[0];
  if (name == "cone") {
    if (!(number >= 0.0 && number <= 90.0)) law.refuse("not an angle from +-z", "give degrees from 0 to 90");
    return AxisLaw::cone(number);
  }
  if (name == "onsager") {
    if (!(number >= 0.0)) law.refuse("a negative alpha", "give 0 or more");
    return AxisLaw::onsager(number);
  }
  if (!(std::fabs(number) <= AxisLaw::kLargestMaierSaupe)) {
    law.refuse("too strong a law of Maier and Saupe", "give a number from -1000 to 1000");
  }
  return AxisLaw::maier_saupe(number);
}

}  // namespace

std::optional<std::string> file_of_law(std::string_view text) {
  if (!text.starts_with(kTable)) return std::nullopt;
  return std::string(text.substr(kTable.size()));
}

AxisLaw parse_axis_law(std::string_view text, std::string_view option) {
  const LawText law{text, option};
  if (const std::optional<AxisLaw> found = axis_law(law)) return *found;
  const std::string_view name = split(text).name;
  if (name == "fixed" || name == "angle") {
    law.refuse("a law of two bodies, not of one", "give it to --orientations, or choose another");
  }
  law.refuse("not a choice", (std::string("there are ") + kAxisLaws).c_str());
}

Vec3d parse_axis(std::string_view text, std::string_view option) {
  if (text == "x") return {1.0, 0.0, 0.0};
  if (text == "y") return {0.0, 1.0, 0.0};
  if (text == "z") return {0.0, 0.0, 1.0};
  const LawText axis{text, option};
  const std::vector<double> numbers = axis.numbers(text);
  if (numbers.size() != 3) axis.refuse("not an axis", "write x, y, z, or a direction X,Y,Z");
  if (numbers[0] == 0.0 && numbers[1] == 0.0 && numbers[2] == 0.0) {
    axis.refuse("a direction of length 0", "give another");
  }
  return {numbers[0], numbers[1], numbers[2]};
}

OrientationLaw parse_orientation_law(std::string_view text, std::string_view option, std::string_view choices) {
  const LawText law{text, option};
  const auto [name, value] = split(text);
  if (value && name == "fixed") {
    const std::vector<double> numbers = law.numbers(*value);
    if (numbers.size() != 4) law.refuse("not a quaternion", "write fixed:W,X,Y,Z, as in fixed:1,0,0,0");
    if (std::ranges::all_of(numbers, [](double number) { return number == 0.0; })) {
      law.refuse("a quaternion of length 0", "it turns nothing into nothing: give another");
    }
    return OrientationLaw::fixed(numbers[0], numbers[1], numbers[2], numbers[3]);
  }
  if (value && name == "angle") {
    const std::vector<double> numbers = law.numbers(*value);
    if (numbers.size() != 1) law.refuse("more than one number", "write angle:DEG");
    if (!(numbers[0] >= 0.0 && numbers[0] <= 180.0)) {
      law.refuse("not an angle between two axes", "give degrees from 0 to 180");
    }
    return OrientationLaw::angle(numbers[0]);
  }
  if (const std::optional<AxisLaw> of_both = axis_law(law)) return OrientationLaw::both_by(*of_both);
  law.refuse("not a choice", "there are " + std::string(choices));
}

}  // namespace vex
