#include "meshes/report_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

#include "meshes/nearest_float.h"

namespace vex {
namespace {

/// A 32-bit float with the nine digits that tell it apart, any other double with as few as tell that one apart.
std::string coordinate_text(double x) {
  if (!(std::fabs(x) <= double{std::numeric_limits<float>::max()}) || nearest_float(x) == x) {
    return number_text(x);
  }
  std::array<char, 40> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), x);
  return {text.data(), end};
}

}  // namespace

std::string number_text(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.9g", value);
  return text.data();
}

std::string point_text(const Vec3d& point) {
  return "(" + coordinate_text(point.x) + ", " + coordinate_text(point.y) + ", " + coordinate_text(point.z) + ")";
}

std::string hull_advice(const std::string& first_advice) {
  return " - " + first_advice + ", or use --hull, which takes the convex hull instead";
}

}  // namespace vex
