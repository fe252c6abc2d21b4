#include "engine/sampling/poses/axis_law.h"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/sampling/poses/axis_table_text.h"
#include "tests/referees/array_lanes.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

using Real = long double;

template <class F>
Real integral(const F& f, Real from, Real to) {
  constexpr int kPanels = 80;  // of 61 nodes: exp(3000 x) over one of them is smooth
  Real sum = 0;
  for (int k = 0; k < kPanels; ++k) {
    const Real low = from + (to - from) * k / kPanels, high = from + (to - from) * (k + 1) / kPanels;
    sum += boost::math::quadrature::gauss_kronrod<Real, 61>::integrate(f, low, high, 0);
  }
  return sum;
}

/// exp(A P_2) over its largest value, at this distance of |cos| from where that is: 1 for A > 0, or 0.
Real maier_saupe_density(double strength, Real distance) {
  const Real a = 1.5L * std::fabs(Real(strength));
  return std::exp(-a * distance * (strength >= 0.0 ? 2 - distance : distance));
}

const std::vector<double> kStrengths = {0.0, 1e-9, 0.5, 4.0, -3.0, 40.0, -200.0, 1000.0, -1000.0};

TEST(AxisLaw, OfMaierAndSaupeInvertsTheCumulatedDensity) {
  for (const double strength : kStrengths) {
    const AxisLaw law = AxisLaw::maier_saupe(strength);
    const auto density = [strength](Real distance) { return maier_saupe_density(strength, distance); };
    const Real all = integral(density, 0, 1);
    std::mt19937_64 random(1);
    Real worst = 0;
    for (int k = 0; k < 60; ++k) {
      const double u = k == 0 ? 0.5 + 0x1p-53 : (k == 1 ? 1.0 - 0x1p-53 : random_in_unit_interval(random));
      const bool is_up = u > 0.5;
      const double v = is_up ? 2.0 * u - 1.0 : 2.0 * u;
      const auto [sin, cos] = law.polar_angle(u);
      ASSERT_TRUE(is_up ? cos > -1e-15 : cos < 1e-15) << cos;  // at the equator rounding may cross it
      // 1 - |cos| with all its digits, which cos has not.
      const Real size = std::fabs(cos), off = Real(sin) * sin / (1 + size);
      const Real share = integral(density, 0, strength >= 0.0 ? off : size) / all;
      worst = std::max(worst, std::fabs(share - v));
    }
    EXPECT_LE(worst, 0x1p-43L) << strength;
    EXPECT_GT(worst, 0.0L) << strength;
  }
}

TEST(AxisLaw, OfMaierAndSaupeHasTheOrderParameterThatAQuadratureGives) {
  for (const double strength : kStrengths) {
    const auto density = [strength](Real distance) { return maier_saupe_density(strength, distance); };
    const auto weighed = [&](Real distance) {
      const Real cos = strength >= 0.0 ? 1 - distance : distance;
      return cos * cos * density(distance);
    };
    const Real second = integral(weighed, 0, 1) / integral(density, 0, 1);
    EXPECT_NEAR(AxisLaw::maier_saupe(strength).order_parameter(), static_cast<double>(1.5L * second - 0.5L), 2e-14)
        << strength;
  }
  // The first terms of its expansion: A / 5.
  EXPECT_NEAR(AxisLaw::maier_saupe(1e-6).order_parameter(), 2e-7, 1e-12);
}

/// By its definition, piece by piece.
struct Lines {
  AxisTable table;
  Real from_of(std::size_t k) const { return table.cosines[k]; }
  template <class F>
  Real integral_of(const F& f, Real from, Real to) const {
    Real sum = 0;
    for (std::size_t k = 0; k + 1 < table.cosines.size(); ++k) {
      const Real low = std::max<Real>(from, table.cosines[k]), high = std::min<Real>(to, table.cosines[k + 1]);
      if (!(low < high)) continue;
      const auto weighed = [&](Real cos) {
        const Real at = (cos - from_of(k)) / (Real(table.cosines[k + 1]) - from_of(k));
        return f(cos) * (table.densities[k] + at * (table.densities[k + 1] - table.densities[k]));
      };
      sum += boost::math::quadrature::gauss_kronrod<Real, 15>::integrate(weighed, low, high, 0);  // a polynomial
    }
    return sum;
  }
};

std::vector<AxisTable> sample_tables() {
  AxisTable onsager;
  for (int k = 0; k <= 2000; ++k) {
    const double cos = -1.0 + k / 1000.0;
    onsager.cosines.push_back(cos);
    onsager.densities.push_back(1e300 * std::cosh(5.0 * cos) / std::cosh(5.0));
  }
  return {{{-0.5, 0.3, 0.9, 1.0}, {0.0, 1.0, 4.0, 2.0}},
          {{0.25, 0.5}, {3.0, 3.0}},
          {{-1.0, -0.5, 0.0, 0.5, 1.0}, {1.0, 0.0, 0.0, 0.0, 1e-6}},
          onsager};
}

TEST(AxisLaw, OfATableInvertsTheCumulatedDensity) {
  const auto one = [](Real) { return Real(1); };
  for (const AxisTable& table : sample_tables()) {
    const AxisLaw law = AxisLaw::table(table);
    const Lines lines{*law.points()};
    EXPECT_NEAR(static_cast<double>(lines.integral_of(one, -1, 1)), 1.0, 1e-14);
    std::mt19937_64 random(2);
    for (int k = 0; k < 60; ++k) {
      const double u = k == 0 ? 0x1p-53 : (k == 1 ? 1.0 - 0x1p-53 : random_in_unit_interval(random));
      const double cos = law.polar_angle(u).cos;
      ASSERT_GE(cos, table.cosines.front() - 1e-15);
      ASSERT_LE(cos, table.cosines.back() + 1e-15);
      EXPECT_NEAR(static_cast<double>(lines.integral_of(one, cos, 1)), u, 0x1p-43) << k;
    }
  }
}

TEST(AxisLaw, OfATableHasTheOrderParameterThatAQuadratureGives) {
  for (const AxisTable& table : sample_tables()) {
    const AxisLaw law = AxisLaw::table(table);
    const Lines lines{*law.points()};
    const Real s = lines.integral_of([](Real cos) { return 1.5L * cos * cos - 0.5L; }, -1, 1);
    EXPECT_NEAR(law.order_parameter(), static_cast<double>(s), 1e-14);
  }
  EXPECT_NEAR(AxisLaw::table(sample_tables()[3]).order_parameter(), AxisLaw::onsager(5).order_parameter(), 1e-5);
}

TEST(AxisLaw, DrawsTheSameBitsInLanes) {
  constexpr int W = 4;
  for (const AxisLaw& law : {AxisLaw::maier_saupe(7), AxisLaw::maier_saupe(-7), AxisLaw::table(sample_tables()[0]),
                             AxisLaw::table(sample_tables()[3])}) {
    std::mt19937_64 random(3);
    for (int round = 0; round < 200; ++round) {
      ArrayLanes<W> u;
      for (double& lane : u.lane) lane = random_in_unit_interval(random);
      const AxisLaw::Polar<ArrayLanes<W>> wide = law.polar_angle(u);
      for (std::size_t k = 0; k < W; ++k) {
        const AxisLaw::Polar<double> one = law.polar_angle(u.lane[k]);
        ASSERT_EQ(bits_of(one.cos), bits_of(wide.cos.lane[k]));
        ASSERT_EQ(bits_of(one.sin), bits_of(wide.sin.lane[k]));
      }
    }
  }
}

TEST(AxisLaw, OfATableIsNamedByItsNumbersAndNotByTheirScale) {
  const AxisTable table = sample_tables()[0];
  AxisTable other = table;
  EXPECT_EQ(AxisLaw::table(table).name(), AxisLaw::table(other).name());
  EXPECT_EQ(AxisLaw::table(table), AxisLaw::table(other));
  const AxisTable normalised = *AxisLaw::table(sample_tables()[3]).points();
  EXPECT_EQ(AxisLaw::table(normalised).name(), AxisLaw::table(sample_tables()[3]).name()) << "normalised once for all";
  other.densities[1] = std::nextafter(other.densities[1], 2.0);
  EXPECT_NE(AxisLaw::table(table).name(), AxisLaw::table(other).name());
  EXPECT_FALSE(AxisLaw::table(table) == AxisLaw::table(other));
  for (double& density : other.densities) density = 0.0;
  other = table;
  for (double& density : other.densities) density *= 8.0;
  EXPECT_EQ(AxisLaw::table(table).name(), AxisLaw::table(other).name());
  EXPECT_EQ(AxisLaw::table(table).name().size(), std::string("table:0123456789abcdef").size());
}

TEST(AxisLaw, RefusesWhatIsNoDensity) {
  const double nan = std::nan(""), infinity = HUGE_VAL;
  for (const AxisTable& table : std::vector<AxisTable>{{{}, {}},
                                                       {{0.5}, {1.0}},
                                                       {{0.0, 1.0}, {1.0}},
                                                       {{0.0, 0.0}, {1.0, 1.0}},
                                                       {{0.5, 0.0}, {1.0, 1.0}},
                                                       {{0.0, 1.1}, {1.0, 1.0}},
                                                       {{-1.0001, 1.0}, {1.0, 1.0}},
                                                       {{nan, 1.0}, {1.0, 1.0}},
                                                       {{0.0, 1.0}, {1.0, nan}},
                                                       {{0.0, 1.0}, {1.0, infinity}},
                                                       {{0.0, 1.0}, {1.0, -1e-300}},
                                                       {{0.0, 1.0}, {0.0, 0.0}},
                                                       {std::vector<double>(100001), std::vector<double>(100001)}}) {
    EXPECT_THROW(AxisLaw::table(table), InputError) << table.cosines.size();
  }
  for (const double strength : {1000.1, -1001.0, nan, infinity}) {
    EXPECT_THROW(AxisLaw::maier_saupe(strength), UsageError);
  }
}

TEST(AxisTableText, ReadsTwoColumns) {
  const AxisTable table = parse_axis_table("# cos density\n -1 0.5\r\n\n0.25,\t1e3 # middle\n1 , 2\n", "f");
  EXPECT_EQ(table.cosines, (std::vector<double>{-1.0, 0.25, 1.0}));
  EXPECT_EQ(table.densities, (std::vector<double>{0.5, 1000.0, 2.0}));
}

TEST(AxisTableText, RefusesWhatIsNoLineOfTwoNumbersAndNamesIt) {
  for (const char* line : {"0.5", "0.5 1 2", "a 1", "0.5,,1", "0.5 nan", "inf 1", "0.5 1x", "cos density", "0.5;1"}) {
    try {
      parse_axis_table(std::string("0 1\n") + line + "\n1 1\n", "here.txt");
      ADD_FAILURE() << line;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("here.txt, line 2"), std::string::npos) << error.what();
    }
  }
  // It came about that a zero byte ended the message before its advice.
  try {
    parse_axis_table(std::string("0 1\n\0\x1b 1\n", 9), "here.txt");
    ADD_FAILURE() << "a zero byte is no number";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"??\" (here.txt, line 2) - write"), std::string::npos) << error.what();
  }
  EXPECT_THROW(read_axis_table("/dev/zero"), InputError);
  EXPECT_THROW(read_axis_table("/nowhere"), InputError);
  EXPECT_THROW(read_axis_table("/"), InputError);
}

}  // namespace
}  // namespace vex
