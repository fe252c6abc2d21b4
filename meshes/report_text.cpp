#include "meshes/report_text.h"

#include <array>
#include <cstdio>

namespace vex {

std::string number_text(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.9g", value);
  return text.data();
}

std::string point_text(const Vec3d& point) {
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), "(%.9g, %.9g, %.9g)", point.x, point.y, point.z);
  return text.data();
}

std::string hull_advice(const std::string& first_advice) {
  return " - " + first_advice + ", or use --hull, which takes the convex hull instead";
}

}  // namespace vex
