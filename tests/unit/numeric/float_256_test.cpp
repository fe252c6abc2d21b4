#include "engine/numeric/float_256.h"

#include <gtest/gtest.h>

#include "engine/numeric/directions.h"

namespace vex {
namespace {

TEST(Float256, TellsWhatTwicePrecisionDoesNot) {
  const Float256 one(1.0), tiny(0x1p-200);
  EXPECT_GT(one + tiny, one);
  EXPECT_EQ(((one + tiny) - one).high(), 0x1p-200);
  EXPECT_EQ((Float256(3.0) / Float256(4.0)).high(), 0.75);
}

TEST(Float256, TakesRootsToAllItsDigits) {
  const Float256 root = square_root(Float256(2.0));
  EXPECT_LE(absolute(root * root - Float256(2.0)).high(), 0x1p-253);
  EXPECT_EQ(square_root(Float256()).high(), 0.0);
}

TEST(Float256, ComesFromWholeNumbersInAnyUnit) {
  const whole::Dyadic x = whole::Dyadic(3.0) * whole::Dyadic(0x1p-1000) * whole::Dyadic(0x1p-1000);
  EXPECT_EQ(Float256(x, -2000).high(), 3.0);
  EXPECT_EQ(Float256(-x, -1999).high(), -1.5);
  EXPECT_EQ(Float256(whole::Dyadic(), 7).high(), 0.0);
}

TEST(Float256, VectorsAreScaledByPowersOfTwo) {
  const Vec3<Float256> v = broadcast<Float256>({0x1.8p-300, 0x1p-310, 0.0});
  const Vec3<Float256> scaled = scaled_to_unit_exponent(v);
  EXPECT_EQ(scaled.x.high(), 1.5);
  EXPECT_EQ(scaled.y.high(), 0x1p-10);
  EXPECT_EQ(scaled.z.high(), 0.0);
  EXPECT_LE(absolute(norm(unit_along(v)) - Float256(1.0)).high(), 0x1p-253);
  EXPECT_EQ(scaled_to_unit_exponent(Vec3<Float256>{}).x.high(), 0.0);
}

TEST(Float256, VectorsAreSplitIntoTwoOfDoubles) {
  const Float256 third = Float256(1.0) / Float256(3.0);
  Vec3d high, low;
  split({third, -third, Float256(0.0)}, high, low);
  EXPECT_EQ(high.x, 1.0 / 3.0);
  EXPECT_LE(absolute(third - (Float256(high.x) + Float256(low.x))).high(), 0x1p-107);
  EXPECT_EQ(low.y, -low.x);
  EXPECT_EQ(low.z, 0.0);
}

}  // namespace
}  // namespace vex
