#include "engine/numeric/quaternion.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <random>
#include <vector>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

// 2300 bits hold every sum of squares of doubles in [2^-1074, 1), and of middles between two, exactly.
using Exact2300 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<2300, boost::multiprecision::digit_base_2>>;
using Quaternion = std::array<double, 4>;

// The neighbours of the root are found by their squares, and the middle between them by its own: no root is taken.
double true_norm(const Quaternion& q) {
  Exact2300 sum = 0;
  for (const double c : q) sum += Exact2300(c) * Exact2300(c);
  double below = std::sqrt(static_cast<double>(sum));
  while (Exact2300(below) * Exact2300(below) > sum) below = std::nextafter(below, 0.0);
  while (Exact2300(std::nextafter(below, 9.0)) * Exact2300(std::nextafter(below, 9.0)) <= sum)
    below = std::nextafter(below, 9.0);
  const double above = std::nextafter(below, 9.0);
  const Exact2300 middle = (Exact2300(below) + Exact2300(above)) / 2;
  const Exact2300 middle_sq = middle * middle;
  if (sum == middle_sq) return (bits_of(below) & 1u) == 0 ? below : above;
  return sum < middle_sq ? below : above;
}

// The largest magnitude brought into [1/2, 1), as correctly_rounded_norm wants it.
Quaternion scaled(Quaternion q) {
  int exponent = 0;
  std::frexp(std::max({std::fabs(q[0]), std::fabs(q[1]), std::fabs(q[2]), std::fabs(q[3])}), &exponent);
  for (double& c : q) c = std::ldexp(c, -exponent);
  return q;
}

double random_component(std::mt19937_64& random, int widest) {
  const double mantissa = 0.5 + static_cast<double>(random() >> 12) * 0x1p-53;
  const double magnitude = std::ldexp(mantissa, -static_cast<int>(random() % static_cast<std::uint64_t>(widest)));
  return (random() & 1u) != 0 ? magnitude : -magnitude;
}

TEST(CorrectlyRoundedNorm, IsTheNearestDoubleForComponentsOfAnyMagnitude) {
  std::mt19937_64 random(1);
  int naive_is_wrong = 0, n = 0;
  for (const int widest : {1, 3, 30, 60, 200, 600, 1073}) {
    for (int k = 0; k < 700; ++k, ++n) {
      Quaternion q;
      for (double& c : q) c = random_component(random, widest);
      if (k % 7 == 0) q[random() % 4] = 0.0;
      q = scaled(q);
      ASSERT_EQ(correctly_rounded_norm(q), true_norm(q)) << q[0] << " " << q[1] << " " << q[2] << " " << q[3];
      naive_is_wrong += std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]) != true_norm(q) ? 1 : 0;
    }
  }
  EXPECT_GT(naive_is_wrong, n / 20) << "a sample that needs no care shows none";
}

// Components (2 k, k, 2 k, 0) have the norm 3 k: of 54 significant bits it is in the middle between two doubles.
TEST(CorrectlyRoundedNorm, BreaksTiesToEvenAndSeesTheLeastDifferenceFromOne) {
  std::mt19937_64 random(2);
  int n_even_is_below = 0, n_even_is_above = 0;
  for (int found = 0; found < 150;) {
    const std::uint64_t k = (1ull << 51) + (random() >> 13) % (1ull << 51);  // 52 bits, so that 2 k is a double
    const std::uint64_t three_k = 3 * k;
    if (three_k < (1ull << 53) || three_k >= (1ull << 54) || three_k % 2 == 0) continue;
    ++found;
    const double c = static_cast<double>(k);
    const std::array<Quaternion, 3> orders = {Quaternion{2 * c, c, 2 * c, 0.0}, Quaternion{0.0, -2 * c, 2 * c, c},
                                              Quaternion{c, 2 * c, 0.0, -2 * c}};
    for (const Quaternion& order : orders) {
      const Quaternion q = scaled(order);
      const double norm = correctly_rounded_norm(q);
      ASSERT_EQ(norm, true_norm(q));
      ASSERT_EQ(bits_of(norm) & 1u, 0u);
    }
    (three_k % 4 == 1 ? n_even_is_below : n_even_is_above) += 1;
    // A trifle beside it decides upwards, however small: also one whose square underflows.
    for (const double trifle : {0x1p-40, 0x1p-50, 0x1p-52, 0x1p-53, 0x1p-54, 0x1p-55, 0x1p-120, 0x1p-479, 0x1p-480,
                                0x1p-481, 0x1p-600, 0x1p-1074}) {
      Quaternion q = scaled({2 * c, c, 2 * c, 0.0});
      q[3] = trifle;
      const double norm = correctly_rounded_norm(q);
      ASSERT_EQ(norm, true_norm(q)) << trifle;
      ASSERT_EQ(norm, std::ldexp(static_cast<double>((three_k + 1) / 2), -52)) << trifle;
    }
  }
  EXPECT_GT(n_even_is_below, 40);
  EXPECT_GT(n_even_is_above, 40);
}

TEST(CorrectlyRoundedNorm, IsRightBesidePowersOfTwo) {
  // Just below 1 doubles are twice as dense as just above.
  for (int k = 30; k <= 60; ++k) {
    for (const double first : {1.0 - 0x1p-53, 1.0 - 0x1p-52, 1.0 - 0x1p-50, 0.5, 0.5 + 0x1p-53}) {
      const Quaternion q = {first, std::ldexp(1.0, -k / 2), std::ldexp(-1.5, -k / 2 - 1), std::ldexp(1.0, -k)};
      ASSERT_EQ(correctly_rounded_norm(q), true_norm(q)) << k;
    }
  }
}

bool same_bits(const Vec3d& a, const Vec3d& b) {
  return bits_of(a.x) == bits_of(b.x) && bits_of(a.y) == bits_of(b.y) && bits_of(a.z) == bits_of(b.z);
}
bool same_bits(const Transformd& a, const Transformd& b) {
  return same_bits(a.row_x, b.row_x) && same_bits(a.row_y, b.row_y) && same_bits(a.row_z, b.row_z);
}

// The documented formula; every product and sum is stored, so that no compiler can fuse them.
Transformd stated_matrix(const Quaternion& given) {
  const Quaternion q = scaled(given);
  const double n = true_norm(q);
  const double w = q[0] / n, x = q[1] / n, y = q[2] / n, z = q[3] / n;
  const auto twice_sum = [](double a, double b, double c, double d) {
    const volatile double ab = a * b, cd = c * d;
    const volatile double sum = ab + cd;
    return 2.0 * sum;
  };
  const auto one_minus = [](double value) {
    const volatile double stored = value;
    return 1.0 - stored;
  };
  Transformd r;
  r.row_x = {one_minus(twice_sum(y, y, z, z)), twice_sum(x, y, -w, z), twice_sum(x, z, w, y)};
  r.row_y = {twice_sum(x, y, w, z), one_minus(twice_sum(x, x, z, z)), twice_sum(y, z, -w, x)};
  r.row_z = {twice_sum(x, z, -w, y), twice_sum(y, z, w, x), one_minus(twice_sum(x, x, y, y))};
  return r;
}

TEST(RotationFromQuaternion, IsTheStatedFormulaBitForBit) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 1000; ++k) {
    Quaternion q;
    const int widest = k % 3 == 0 ? 1 : (k % 3 == 1 ? 20 : 900);
    for (double& c : q) c = random_component(random, widest);
    ASSERT_TRUE(same_bits(rotation_from_quaternion(q[0], q[1], q[2], q[3]), stated_matrix(q)));
  }
}

TEST(RotationFromQuaternion, DoesNotDependOnThePowerOfTwoThatScalesIt) {
  std::mt19937_64 random(4);
  for (int k = 0; k < 300; ++k) {
    Quaternion q;
    for (double& c : q) c = random_component(random, 8);
    const Transformd r = rotation_from_quaternion(q[0], q[1], q[2], q[3]);
    for (const int exponent : {-950, -400, -3, 5, 700, 1023}) {
      ASSERT_TRUE(same_bits(r, rotation_from_quaternion(std::ldexp(q[0], exponent), std::ldexp(q[1], exponent),
                                                        std::ldexp(q[2], exponent), std::ldexp(q[3], exponent))));
    }
    ASSERT_TRUE(same_bits(r, rotation_from_quaternion(-q[0], -q[1], -q[2], -q[3]))) << "q and -q turn alike";
  }
}

void expect_rows(const Transformd& r, const Vec3d& x, const Vec3d& y, const Vec3d& z) {
  for (const auto& [found, expected] : {std::pair(r.row_x, x), std::pair(r.row_y, y), std::pair(r.row_z, z)}) {
    EXPECT_EQ(found.x, expected.x);
    EXPECT_EQ(found.y, expected.y);
    EXPECT_EQ(found.z, expected.z);
  }
}

TEST(RotationFromQuaternion, OfTheIdentityAndHalfTurnsIsExactAtEverySize) {
  for (const double size : {1.0, -1.0, 3.0, 0.1, 0x1p-1074, 0x1.23p-1060, 1e-310, 1.7976931348623157e308}) {
    expect_rows(rotation_from_quaternion(size, 0, 0, 0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    expect_rows(rotation_from_quaternion(0, size, 0, 0), {1, 0, 0}, {0, -1, 0}, {0, 0, -1});
    expect_rows(rotation_from_quaternion(0, 0, size, 0), {-1, 0, 0}, {0, 1, 0}, {0, 0, -1});
    expect_rows(rotation_from_quaternion(0, 0, 0, size), {-1, 0, 0}, {0, -1, 0}, {0, 0, 1});
  }
}

TEST(RotationFromQuaternion, OfThirdsOfATurnAboutADiagonalIsExact) {
  // (1, 1, 1, 1) has the norm 2.
  expect_rows(rotation_from_quaternion(5, 5, 5, 5), {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  expect_rows(rotation_from_quaternion(-7, 7, 7, 7), {0, 1, 0}, {0, 0, 1}, {1, 0, 0});
}

TEST(RotationFromQuaternion, QuarterTurnsAreExactToRounding) {
  // 1/sqrt(2) is no double, so neither 0 nor 1 need come out; no entry is off by more than 4 u.
  const auto expect_near = [](const Transformd& r, const Vec3d& x, const Vec3d& y, const Vec3d& z) {
    for (const auto& [found, expected] : {std::pair(r.row_x, x), std::pair(r.row_y, y), std::pair(r.row_z, z)}) {
      EXPECT_LE(norm_1(found - expected), 0x1p-51);
    }
  };
  expect_near(rotation_from_quaternion(1, 1, 0, 0), {1, 0, 0}, {0, 0, -1}, {0, 1, 0});
  expect_near(rotation_from_quaternion(1, 0, 1, 0), {0, 0, 1}, {0, 1, 0}, {-1, 0, 0});
  expect_near(rotation_from_quaternion(1, 0, 0, 1), {0, -1, 0}, {1, 0, 0}, {0, 0, 1});
}

TEST(RotationFromQuaternion, TurnsAsHamiltonsProductDoes) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 300; ++k) {
    const double w = random_component(random, 3), x = random_component(random, 3), y = random_component(random, 3),
                 z = random_component(random, 3);
    const Vec3d p{random_component(random, 3), random_component(random, 3), random_component(random, 3)};
    // q p q* / |q|^2 = ((w^2 - v.v) p + 2 (v.p) v + 2 w v x p) / |q|^2
    const Vec3d v{x, y, z};
    const double norm_sq = w * w + dot(v, v);
    const Vec3d expected =
        (1.0 / norm_sq) * (((w * w - dot(v, v)) * p + (2.0 * dot(v, p)) * v) + (2.0 * w) * cross(v, p));
    ASSERT_LE(norm(rotation_from_quaternion(w, x, y, z)(p) - expected), 1e-14);
  }
}

TEST(RotationsFromQuaternions, AreThoseOfEachBitForBit) {
  std::mt19937_64 random(3);
  std::array<std::vector<double>, 4> components;
  constexpr std::size_t kN = 1003;
  for (std::size_t k = 0; k < kN; ++k) {
    const int widest = std::array{1, 3, 60, 600, 1073}[k % 5];
    const int shift = k % 7 == 0 ? 900 : k % 11 == 0 ? -400 : 0;
    for (std::vector<double>& of_one : components)
      of_one.push_back(std::ldexp(random_component(random, widest), shift));
    if (k % 3 == 0) components[random() % 4].back() = 0.0;
    if (k % 13 == 0) {  // 3, 4, 12, 84: norms that are whole, and one half of a last place beside them
      for (std::size_t i = 0; i < 4; ++i) components[i].back() = std::array{3.0, 4.0, 12.0, 84.0}[i];
      if (k % 2 == 0) components[3].back() = std::nextafter(84.0, 85.0);
    }
    bool is_zero = true;
    for (const std::vector<double>& of_one : components) is_zero = is_zero && of_one.back() == 0.0;
    if (is_zero) components[0].back() = 1.0;
  }
  std::vector<double> rotations(9 * kN);
  rotations_from_quaternions({components[0].data(), components[1].data(), components[2].data(), components[3].data()},
                             kN, rotations.data(), kN);
  for (std::size_t k = 0; k < kN; ++k) {
    const Transformd r =
        rotation_from_quaternion(components[0][k], components[1][k], components[2][k], components[3][k]);
    std::size_t column = 0;
    for (const Vec3d* const row : {&r.row_x, &r.row_y, &r.row_z}) {
      for (const double value : {row->x, row->y, row->z}) {
        ASSERT_EQ(bits_of(rotations[column++ * kN + k]), bits_of(value)) << k;
      }
    }
  }
  components[2][500] = std::nan("");
  EXPECT_THROW(rotations_from_quaternions(
                   {components[0].data(), components[1].data(), components[2].data(), components[3].data()}, kN,
                   rotations.data(), kN),
               InputError);
}

}  // namespace
}  // namespace vex
