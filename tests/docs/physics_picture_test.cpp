#include "tests/docs/physics_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace vex {
namespace {

// Of a square prism there is no formula as short; of the others, of length L between the caps and thickness D: L.
// Onsager, Ann. N.Y. Acad. Sci. 51, 627, 1949.
double volume_of_spherocylinder(double length, double d) {
  return std::acos(-1.0) * (0.25 * length * d * d + d * d * d / 6.0);
}
double excluded_by_spherocylinder(double length, double d, double gamma) {
  return 2.0 * length * length * d * std::sin(gamma) + std::acos(-1.0) * (2.0 * length * d * d + 4.0 / 3.0 * d * d * d);
}
double excluded_by_cylinder(double length, double d, double gamma) {
  const double pi = std::acos(-1.0), e = std::comp_ellint_2(std::sin(gamma));
  return 2.0 * length * length * d * std::sin(gamma) + 0.5 * pi * d * d * d * std::sin(gamma) +
         0.5 * pi * length * d * d * (1.0 + std::fabs(std::cos(gamma)) + 4.0 / pi * e);
}

TEST(PhysicsPicture, HasTheCurvesOfTheFormulas) {
  for (const Rod& rod : rods()) {
    for (const RodValue& value : rod.exact) {
      const double gamma = value.degrees / 180.0 * std::acos(-1.0);
      if (rod.label == "cylinder") {
        EXPECT_NEAR(value.value, excluded_by_cylinder(5, 1, gamma) / (1.25 * std::acos(-1.0)), 5.0 * value.std_error);
      } else if (rod.label == "spherocylinder") {
        EXPECT_NEAR(value.value, excluded_by_spherocylinder(4, 1, gamma) / volume_of_spherocylinder(4, 1),
                    5.0 * value.std_error);
      }
      EXPECT_LT(value.std_error, 2e-3) << rod.label << value.degrees;  // a thirtieth of a pixel
    }
    // The points are between two of the line.
    for (const RodValue& point : rod.monte_carlo) {
      std::size_t k = 1;
      while (rod.exact[k].degrees < point.degrees) ++k;
      const RodValue &low = rod.exact[k - 1], &high = rod.exact[k];
      const double share = (point.degrees - low.degrees) / (high.degrees - low.degrees);
      EXPECT_NEAR(point.value, low.value + share * (high.value - low.value), 0.03 + 5.0 * point.std_error) << rod.label;
      EXPECT_LT(point.std_error, 0.2) << rod.label;  // less than the dot
    }
  }
}

TEST(PhysicsPicture, IsTheOneThatTheProgramDraws) {
  std::ifstream file(std::string(VEX_SOURCE_DIR) + "/docs/excluded_volume/physics.svg", std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  // Not EXPECT_EQ: it would print both files.
  EXPECT_TRUE(physics_picture() == text.str()) << "draw it again: vex_draw_shapes docs/excluded_volume/physics.svg";
}

}  // namespace
}  // namespace vex
