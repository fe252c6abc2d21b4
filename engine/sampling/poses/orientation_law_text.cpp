#include "engine/sampling/poses/orientation_law_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

/// Of a law's text; the option that it is the value of is named where there is one.
struct LawText {
  std::string_view text, option;

  [[noreturn]] void refuse(const char* problem, std::string_view part, const char* advice) const {
    throw UsageError(std::string(problem) + " (\"" + std::string(part) + "\"" +
                     (option.empty() ? "" : " for " + std::string(option)) + ") - " + advice);
  }
  [[noreturn]] void refuse(const char* problem, const char* advice) const { refuse(problem, text, advice); }

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

}  // namespace

OrientationLaw parse_orientation_law(std::string_view text, std::string_view option) {
  const LawText law{text, option};
  if (text == "isotropic") return OrientationLaw::isotropic();
  if (text == "aligned") return OrientationLaw::aligned();
  const std::size_t colon = text.find(':');
  const std::string_view name = text.substr(0, colon);
  const bool takes_numbers = name == "fixed" || name == "cone" || name == "angle" || name == "onsager";
  if (!takes_numbers || name.size() == text.size()) {
    law.refuse("not a choice", "there are isotropic, aligned, fixed:W,X,Y,Z, cone:DEG, angle:DEG, onsager:ALPHA");
  }
  const std::vector<double> numbers = law.numbers(text.substr(colon + 1));
  if (name == "fixed") {
    if (numbers.size() != 4) law.refuse("not a quaternion", "write fixed:W,X,Y,Z, as in fixed:1,0,0,0");
    if (std::ranges::all_of(numbers, [](double number) { return number == 0.0; })) {
      law.refuse("a quaternion of length 0", "it turns nothing into nothing: give another");
    }
    return OrientationLaw::fixed(numbers[0], numbers[1], numbers[2], numbers[3]);
  }
  if (numbers.size() != 1) law.refuse("more than one number", "write cone:DEG, angle:DEG or onsager:ALPHA");
  const double number = numbers[0];
  if (name == "cone") {
    if (!(number >= 0.0 && number <= 90.0)) law.refuse("not an angle from +-z", "give degrees from 0 to 90");
    return OrientationLaw::cone(number);
  }
  if (name == "angle") {
    if (!(number >= 0.0 && number <= 180.0)) {
      law.refuse("not an angle between two axes", "give degrees from 0 to 180");
    }
    return OrientationLaw::angle(number);
  }
  if (!(number >= 0.0)) law.refuse("a negative alpha", "give 0 or more");
  return OrientationLaw::onsager(number);
}

}  // namespace vex
