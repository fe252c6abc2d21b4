#include "engine/numeric/elementary.h"

#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <random>

#include "engine/numeric/rounding.h"
#include "tests/referees/array_lanes.h"

namespace vex {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_50;

// |computed - truth| in units of u * |truth|.
double error_in_u(double computed, const Wide& truth) {
  if (truth == 0) return computed == 0.0 ? 0.0 : 1e300;
  return static_cast<double>(abs((Wide(computed) - truth) / truth)) / kUnitRoundoff;
}

std::vector<double> arguments_up_to(double largest) {
  std::mt19937_64 random(7);
  std::vector<double> xs;
  for (int k = 0; k < 20000; ++k) xs.push_back(largest * static_cast<double>(random() >> 11) * 0x1p-53);
  for (int k = 1; k < 60; ++k) xs.push_back(std::ldexp(largest, -k));  // small ones
  for (int q = 0; q <= 8; ++q) {                                       // both sides of every boundary of the reduction
    const double edge = largest * q / 8.0;
    for (const double x : {std::nextafter(edge, -1.0), edge, std::nextafter(edge, 9.0)}) {
      if (x > 0x1p-1000 && x <= largest) xs.push_back(x);  // normal numbers: the bounds are relative
    }
  }
  return xs;
}

TEST(SinCosPi, IsWithinFourRoundoffsOfTheTruth) {
  const Wide pi = boost::math::constants::pi<Wide>();
  double worst = 0.0;
  for (const double x : arguments_up_to(2.0)) {
    const SinCos<double> found = sincospi(x);
    // sin(pi x) by the reduction 2 - x and 1 - x, exact here, so that the referee itself is right near its zeros.
    const Wide s =
        x > 1.0 ? -sin(pi * (Wide(2) - Wide(x))) : (x > 0.5 ? sin(pi * (Wide(1) - Wide(x))) : sin(pi * Wide(x)));
    const Wide c = x > 1.0 ? sin(pi * (Wide(x) - Wide(1.5))) : sin(pi * (Wide(0.5) - Wide(x)));
    worst = std::max({worst, error_in_u(found.sin, s), error_in_u(found.cos, c)});
  }
  EXPECT_LE(worst, 4.0);
  EXPECT_GT(worst, 0.5) << "a referee that agrees to the last bit everywhere is comparing a value with itself";
}

TEST(SinCosPi, IsExactAtWholeQuarterTurns) {
  EXPECT_EQ(sincospi(0.0).sin, 0.0);
  EXPECT_EQ(sincospi(0.0).cos, 1.0);
  EXPECT_EQ(sincospi(0.5).sin, 1.0);
  EXPECT_EQ(sincospi(0.5).cos, 0.0);
  EXPECT_EQ(sincospi(1.0).sin, 0.0);
  EXPECT_EQ(sincospi(1.0).cos, -1.0);
  EXPECT_EQ(sincospi(1.5).sin, -1.0);
  EXPECT_EQ(sincospi(1.5).cos, 0.0);
  EXPECT_EQ(sincospi(2.0).sin, 0.0);
  EXPECT_EQ(sincospi(2.0).cos, 1.0);
}

TEST(CubeRoot, IsWithinTwoRoundoffsOfTheTruth) {
  double worst = 0.0;
  std::vector<double> xs = arguments_up_to(1.0);
  for (int e = -1000; e <= 1000; e += 7) xs.push_back(std::ldexp(1.2345, e));
  for (const double x : xs) {
    const double found = cube_root(x);
    // The root r of x has relative error (found^3 - x) / (3 x), to first order; found is within 1e-15, so second order
    // is 1e-30.
    const Wide cube = Wide(found) * Wide(found) * Wide(found);
    worst = std::max(worst, static_cast<double>(abs((cube - Wide(x)) / (3 * Wide(x)))) / kUnitRoundoff);
  }
  EXPECT_LE(worst, 2.0);
  EXPECT_GT(worst, 0.1);
}

TEST(CubeRoot, IsExactForSmallCubes) {
  for (const double root : {0.5, 0.25, 1.0, 3.0, 7.0, 0.125}) EXPECT_EQ(cube_root(root * root * root), root);
}

TEST(CubeRoot, DividesTheExponentByThreeExactlyForEveryHighWord) {
  // The multiplication that stands for the division, over a sample of all high words and their neighbours.
  std::mt19937_64 random(11);
  for (int k = 0; k < 1000000; ++k) {
    const std::uint64_t high = random() & 0x7fffffffu;
    ASSERT_EQ((high * 0xAAAAAAABull) >> 33, high / 3);
  }
  for (std::uint64_t high = 0xffffff00u; high <= 0xffffffffu; ++high) ASSERT_EQ((high * 0xAAAAAAABull) >> 33, high / 3);
}

// Over [0, 1): small ones, both sides of every boundary of 1 - t, and some of every size.
std::vector<double> complements() {
  std::mt19937_64 random(13);
  std::vector<double> ts = {0x1p-1022, 1e-300, 0x1p-54, 0x1.0000000000001p-54, 0x1.8p-53, 1.0 - 0x1p-53, 1.0 - 0x1p-52};
  for (int k = 0; k < 20000; ++k) {
    const double t = static_cast<double>(random() >> 11) * 0x1p-53;
    ts.push_back(t);
    ts.push_back(std::ldexp(0.5 + 0.5 * t, -static_cast<int>(random() % 1000)));
    ts.push_back(std::ldexp(0.5 + 0.5 * t, -static_cast<int>(random() % 60)));
    ts.push_back(1.0 - std::ldexp(0.5 + 0.5 * t, -static_cast<int>(random() % 52)));
  }
  for (int k = 0; k <= 52; ++k) {
    for (const double x : {std::ldexp(1.0, -k), std::ldexp(std::sqrt(0.5), -k)}) {
      double t = 1.0 - x;
      for (int step = 0; step < 4; ++step) t = std::nextafter(t, 0.0);
      for (int step = 0; step < 9; ++step, t = std::nextafter(t, 1.0)) ts.push_back(t);
    }
  }
  std::erase_if(ts, [](double t) { return !(t > 0.0 && t <= 1.0 - 0x1p-53); });
  return ts;
}

TEST(MinusLogOfComplement, IsWithinEightRoundoffsOfTheTruth) {
  double worst = 0.0;
  for (const double t : complements()) {
    // Of small t the series, whose terms fall off as t: the referee must not lose t beside 1 either.
    Wide truth;
    if (t < 0x1p-30) {
      truth = 0;
      for (int k = 8; k >= 1; --k) truth = Wide(t) * (Wide(1) / k + truth);
    } else {
      truth = -log(Wide(1) - Wide(t));
    }
    const double error = error_in_u(minus_log_of_complement(t), truth);
    ASSERT_LE(error, 8.0) << t;
    worst = std::max(worst, error);
  }
  EXPECT_GT(worst, 0.5);
  RecordProperty("worst_in_u", std::to_string(worst));
}

TEST(MinusLogOfComplement, IsExactWhereItCanBe) {
  EXPECT_EQ(minus_log_of_complement(0.0), 0.0);
  for (const double t : {0x1p-54, 1e-17, 1e-100, 1e-300, 0x1p-1022}) EXPECT_EQ(minus_log_of_complement(t), t);
  EXPECT_EQ(minus_log_of_complement(0.5), 0x1.62e42fefa39efp-1);
  EXPECT_EQ(minus_log_of_complement(1.0 - 0x1p-52), 52 * 0x1.62e42fefa39efp-1);
  EXPECT_EQ(minus_log_of_complement(1.0 - 0x1p-53), 53 * 0x1.62e42fefa39efp-1);
}

TEST(MinusLogOfComplement, LanesGiveTheBitsOfOneLane) {
  constexpr int W = 4;
  std::vector<double> ts = complements();
  ts.push_back(0.0);
  for (std::size_t k = 0; k + W <= ts.size(); ++k) {  // every neighbour in every lane
    ArrayLanes<W> packet;
    for (std::size_t j = 0; j < W; ++j) packet.lane[j] = ts[k + j];
    const ArrayLanes<W> wide = minus_log_of_complement(packet);
    for (std::size_t j = 0; j < W; ++j) ASSERT_EQ(bits_of(wide.lane[j]), bits_of(minus_log_of_complement(ts[k + j])));
  }
}

TEST(Elementary, LanesGiveTheBitsOfOneLane) {
  constexpr int W = 4;
  const std::vector<double> xs = arguments_up_to(1.0);
  for (std::size_t k = 0; k + W <= xs.size(); k += W) {
    ArrayLanes<W> packet;
    for (std::size_t j = 0; j < W; ++j) packet.lane[j] = xs[k + j];
    const SinCos<ArrayLanes<W>> both_wide = sincospi(packet);
    const ArrayLanes<W> root_wide = cube_root(packet);
    for (std::size_t j = 0; j < W; ++j) {
      const SinCos<double> one = sincospi(xs[k + j]);
      ASSERT_EQ(bits_of(both_wide.sin.lane[j]), bits_of(one.sin));
      ASSERT_EQ(bits_of(both_wide.cos.lane[j]), bits_of(one.cos));
      ASSERT_EQ(bits_of(root_wide.lane[j]), bits_of(cube_root(xs[k + j])));
    }
  }
}

}  // namespace
}  // namespace vex
