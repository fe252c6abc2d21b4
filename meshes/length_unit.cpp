#include "meshes/length_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numeric>

#include "engine/numeric/errors.h"
#include "meshes/formats/text_scanner.h"
#include "meshes/report_text.h"

namespace vex {
namespace {

/// A unit of numerator / denominator metres, exactly.
struct KnownUnit {
  std::array<std::string_view, 6> names;  // the first is what it is called
  std::int64_t numerator, denominator;

  double metres() const { return static_cast<double>(numerator) / static_cast<double>(denominator); }
};

constexpr std::array<KnownUnit, 7> kUnits{{
    {{"m", "meter", "meters", "metre", "metres"}, 1, 1},
    {{"cm", "centimeter", "centimeters", "centimetre", "centimetres"}, 1, 100},
    {{"mm", "millimeter", "millimeters", "millimetre", "millimetres"}, 1, 1000},
    {{"um", "micron", "microns", "micrometer", "micrometre", "\xC2\xB5m"}, 1, 1'000'000},
    {{"nm", "nanometer", "nanometers", "nanometre", "nanometres"}, 1, 1'000'000'000},
    {{"in", "inch", "inches"}, 254, 10'000},
    {{"ft", "foot", "feet"}, 3048, 10'000},
}};

const KnownUnit* unit_named(std::string_view text) {
  const auto is_same = [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  };
  for (const KnownUnit& unit : kUnits) {
    for (const std::string_view name : unit.names) {
      if (!name.empty() && std::ranges::equal(text, name, is_same)) return &unit;
    }
  }
  return nullptr;
}

/// Scales by numerator / denominator.
struct Ratio {
  double numerator = 1.0, denominator = 1.0;

  double operator()(double x) const {
    if (denominator == 1.0) return x * numerator;
    if (numerator == 1.0) return x / denominator;
    return x * (numerator / denominator);
  }
};

Ratio ratio_of(const PolygonSoup& soup, const LengthUnit& to) {
  const KnownUnit* const from_unit = unit_named(soup.unit);
  const KnownUnit* const to_unit = unit_named(to.name);
  if (from_unit != nullptr && from_unit->metres() == soup.unit_metres && to_unit != nullptr &&
      to_unit->metres() == to.metres) {
    std::int64_t numerator = from_unit->numerator * to_unit->denominator;
    std::int64_t denominator = from_unit->denominator * to_unit->numerator;
    const std::int64_t common = std::gcd(numerator, denominator);
    numerator /= common;
    denominator /= common;
    return {static_cast<double>(numerator), static_cast<double>(denominator)};
  }
  return {static_cast<double>(static_cast<long double>(soup.unit_metres) / static_cast<long double>(to.metres)), 1.0};
}

}  // namespace

std::optional<LengthUnit> parse_length_unit(std::string_view text) {
  const KnownUnit* const unit = unit_named(text);
  if (unit == nullptr) return std::nullopt;
  return LengthUnit{std::string(unit->names[0]), unit->metres()};
}

std::optional<LengthUnit> stated_length_unit(std::string_view name, double metres) {
  if (!(metres > 0.0) || !std::isfinite(metres)) return std::nullopt;
  for (const KnownUnit& unit : kUnits) {
    if (static_cast<float>(metres) == static_cast<float>(unit.metres())) {  // 0.00999999978 is a float's 0.01
      return LengthUnit{std::string(unit.names[0]), unit.metres()};
    }
  }
  std::string shown = printable_word(name);
  if (shown.empty() || unit_named(shown) != nullptr) shown = number_text(metres) + " m";
  return LengthUnit{shown, metres};
}

void convert_unit(PolygonSoup& soup, const LengthUnit& to) {
  if (soup.unit.empty() || !(soup.unit_metres > 0.0)) {
    throw InputError("the mesh states no unit of length (" + to.name +
                     " was asked for) - scale it by a number instead");
  }
  const Ratio scale = ratio_of(soup, to);
  if (scale.numerator != 1.0 || scale.denominator != 1.0) {
    for (Vec3d& p : soup.points) p = {scale(p.x), scale(p.y), scale(p.z)};
    soup.digits.last_place = scale(soup.digits.last_place);
  }
  soup.unit = to.name;
  soup.unit_metres = to.metres;
}

}  // namespace vex
