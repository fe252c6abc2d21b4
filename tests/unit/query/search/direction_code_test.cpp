#include "engine/query/search/direction_code.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/referees/random_poses.h"

namespace vex {
namespace {

Vec3d unit(std::mt19937_64& random) { return unit_along(random_direction(random)); }

TEST(DirectionCode, KeepsHowFarADirectionIsFromTheMiddle) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 2000; ++k) {
    const Vec3d middle = unit(random);
    const DirectionCode code(middle, unit(random), unit(random));
    const double aside = std::ldexp(1.0, -(k % 50));
    const Vec3d dir = unit_along(middle + aside * unit(random)), back = code.unit_dir(code.code(dir));
    // An axis may be at a sharp angle to the other one.
    EXPECT_LE(norm(back - dir), 0x1p-4 * norm(dir - middle) + 2e-15);
    EXPECT_NEAR(norm(back), 1.0, 4.0 * 0x1p-53);
  }
}

TEST(DirectionCode, KeepsWhatIsAcrossAnAxisAcrossIt) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 200; ++k) {
    const Vec3d middle = unit(random), edge = unit_along(cross(middle, unit(random)));
    const DirectionCode code(middle, cross(edge, middle), edge);
    // Turned along x alone it is across the edge, however far.
    const Vec3d dir = unit_along(middle + 0.3 * code.x());
    EXPECT_NEAR(dot(code.unit_dir(code.code(dir)), edge), 0.0, 1e-15);
    const Vec3d off = unit_along(dir + 1e-9 * edge);
    EXPECT_GT(dot(code.unit_dir(code.code(off)), edge), 0.9e-9);
  }
}

TEST(DirectionCode, MakesAUnitVectorOfAnyCodeAndAxes) {
  std::mt19937_64 random(3);
  const double nan = std::nan("");
  for (const Vec3d& x : {Vec3d{}, Vec3d{nan, 0, 0}, Vec3d{0, 0, 1}, Vec3d{1, 0, 0}, Vec3d{1e300, 1e300, 0}}) {
    for (const Vec3d& y : {Vec3d{}, Vec3d{0, nan, 0}, Vec3d{1, 0, 0}, Vec3d{1, 1e-9, 0}, Vec3d{0, 1, 0}}) {
      const DirectionCode code({0, 0, 1}, x, y);
      for (int k = 0; k < 200; ++k) {
        EXPECT_NEAR(norm(code.unit_dir(static_cast<std::uint32_t>(random()))), 1.0, 8.0 * 0x1p-53);
      }
    }
  }
  for (const std::uint32_t special : {0u, 0x7f807f80u, 0xffffffffu, 0x7fc00000u, 0x00007f80u, 0x80008000u}) {
    EXPECT_NEAR(norm(DirectionCode({0, 0, 1}, {}, {}).unit_dir(special)), 1.0, 8.0 * 0x1p-53);
  }
}

}  // namespace
}  // namespace vex
