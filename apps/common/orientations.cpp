#include "apps/common/orientations.h"

#include <string>
#include <vector>

#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

[[noreturn]] void refuse(const char* problem, std::string_view text, std::string_view option, const char* advice) {
  throw UsageError(std::string(problem) + " (\"" + std::string(text) + "\" for " + std::string(option) + ") - " +
                   advice);
}

std::vector<double> numbers_of(std::string_view list, std::string_view option) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t comma = list.find(',');
    numbers.push_back(parse_number(list.substr(0, comma), option));
    if (comma == std::string_view::npos) return numbers;
    list = list.substr(comma + 1);
  }
}

}  // namespace

OrientationLaw parse_orientations(std::string_view text, std::string_view option) {
  if (text == "isotropic") return OrientationLaw::isotropic();
  if (text == "aligned") return OrientationLaw::aligned();
  const std::size_t colon = text.find(':');
  const std::string_view name = text.substr(0, colon);
  const bool takes_numbers = name == "fixed" || name == "cone" || name == "angle" || name == "onsager";
  if (!takes_numbers || (name.size() == text.size())) {
    refuse("not a choice", text, option,
           "there are isotropic, aligned, fixed:W,X,Y,Z, cone:DEG, angle:DEG, onsager:ALPHA");
  }
  const std::vector<double> numbers = numbers_of(text.substr(colon + 1), option);
  if (name == "fixed") {
    if (numbers.size() != 4) refuse("not a quaternion", text, option, "write fixed:W,X,Y,Z, as in fixed:1,0,0,0");
    bool is_zero = true;
    for (const double number : numbers) is_zero = is_zero && number == 0.0;
    if (is_zero) refuse("a quaternion of length 0", text, option, "it turns nothing into nothing: give another");
    return OrientationLaw::fixed(numbers[0], numbers[1], numbers[2], numbers[3]);
  }
  if (numbers.size() != 1) refuse("more than one number", text, option, "write cone:DEG, angle:DEG or onsager:ALPHA");
  if (name == "cone") {
    if (!(numbers[0] >= 0.0 && numbers[0] <= 90.0)) {
      refuse("not an angle from +-z", text, option, "give degrees from 0 to 90");
    }
    return OrientationLaw::cone(numbers[0]);
  }
  if (name == "angle") {
    if (!(numbers[0] >= 0.0 && numbers[0] <= 180.0)) {
      refuse("not an angle between two axes", text, option, "give degrees from 0 to 180");
    }
    return OrientationLaw::angle(numbers[0]);
  }
  if (!(numbers[0] >= 0.0)) refuse("a negative alpha", text, option, "give 0 or more");
  return OrientationLaw::onsager(numbers[0]);
}

}  // namespace vex
