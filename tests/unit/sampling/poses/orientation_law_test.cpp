#include "engine/sampling/poses/orientation_law.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"
#include "tests/referees/array_lanes.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_50;
using LawPoint = std::array<double, OrientationLaw::kMaxDimension>;

constexpr double kZ = 4.5;  // standard errors; a right law fails one mean in 150 000

LawPoint random_law_point(std::mt19937_64& random) {
  LawPoint point;
  for (double& u : point) u = random_in_unit_interval(random);
  return point;
}

Transformd rotation_at(const OrientationLaw& law, const LawPoint& point) {
  return law.rotation(std::span<const double>(point));
}

// The least and largest coordinates that are drawn, and both sides of the middle, where the sign of cos changes.
const std::vector<double> kEnds = {0x1p-53, 0.5 - 0x1p-53, 0.5 + 0x1p-53, 1.0 - 0x1p-53};

AxisTable sample_table() { return {{-0.5, 0.3, 0.9, 1.0}, {0.0, 1.0, 4.0, 2.0}}; }

std::vector<OrientationLaw> every_law() {
  return {OrientationLaw::isotropic(),
          OrientationLaw::aligned(),
          OrientationLaw::fixed(1, 2, 3, 4),
          OrientationLaw::cone(0),
          OrientationLaw::cone(1e-5),
          OrientationLaw::cone(30),
          OrientationLaw::cone(90),
          OrientationLaw::onsager(0),
          OrientationLaw::onsager(1e-18),
          OrientationLaw::onsager(1e-3),
          OrientationLaw::onsager(1),
          OrientationLaw::onsager(5.3),
          OrientationLaw::onsager(17.9),
          OrientationLaw::onsager(33),
          OrientationLaw::onsager(1e6),
          OrientationLaw::onsager(1e300),
          OrientationLaw::onsager(1.7e308),
          OrientationLaw::maier_saupe(4),
          OrientationLaw::maier_saupe(-30),
          OrientationLaw::maier_saupe(1000),
          OrientationLaw::table(sample_table()),
          OrientationLaw::each(AxisLaw::cone(20), AxisLaw::table(sample_table())),
          OrientationLaw::cone(30).about({1, 0, 0}, {1, -2, 0.5})};
}

TEST(OrientationLaw, HasTheNameItIsWrittenWith) {
  EXPECT_EQ(OrientationLaw().name(), "isotropic");
  EXPECT_EQ(OrientationLaw::aligned().name(), "aligned");
  EXPECT_EQ(OrientationLaw::fixed(1, 0, -0.5, 0.1).name(), "fixed:1,0,-0.5,0.1");
  EXPECT_EQ(OrientationLaw::cone(30).name(), "cone:30");
  EXPECT_EQ(OrientationLaw::onsager(0.1).name(), "onsager:0.1");
}

TEST(OrientationLaw, AreEqualWhereTheyDrawAlike) {
  const std::vector<OrientationLaw> laws = every_law();
  for (std::size_t i = 0; i < laws.size(); ++i) {
    for (std::size_t j = 0; j < laws.size(); ++j) EXPECT_EQ(laws[i] == laws[j], i == j);
  }
  EXPECT_NE(OrientationLaw::cone(5), OrientationLaw::onsager(5));
}

TEST(OrientationLaw, UsesAsManyCoordinatesAsItSays) {
  std::mt19937_64 random(1);
  for (const OrientationLaw& law : every_law()) {
    const LawPoint point = random_law_point(random);
    const Transformd r = rotation_at(law, point);
    for (std::size_t k = 0; k < point.size(); ++k) {
      LawPoint other = point;
      other[k] = random_in_unit_interval(random);
      const Transformd r_other = rotation_at(law, other);
      const double change = norm_1(r_other.row_x - r.row_x) + norm_1(r_other.row_y - r.row_y);
      if (k >= static_cast<std::size_t>(law.dimension())) {
        EXPECT_EQ(change, 0.0) << law.name() << " " << k;
      } else if (law != OrientationLaw::cone(0) && law.name().find("e+") == std::string::npos) {
        EXPECT_GT(change, 0.0) << law.name() << " " << k;  // all but laws whose polar angles are 0
      }
    }
  }
  EXPECT_EQ(OrientationLaw::isotropic().dimension(), 3);
  EXPECT_EQ(OrientationLaw::aligned().dimension(), 0);
  EXPECT_EQ(OrientationLaw::fixed(1, 0, 0, 0).dimension(), 0);
  EXPECT_EQ(OrientationLaw::cone(30).dimension(), 5);
  EXPECT_EQ(OrientationLaw::onsager(2).dimension(), 5);
}

// |R R^T - I|, Frobenius.
double deviation(const Transformd& r) {
  const std::array<Vec3d, 3> rows = {r.row_x, r.row_y, r.row_z};
  Wide sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Wide entry =
          Wide(rows[i].x) * rows[j].x + Wide(rows[i].y) * rows[j].y + Wide(rows[i].z) * rows[j].z - (i == j ? 1 : 0);
      sum += entry * entry;
    }
  }
  return static_cast<double>(sqrt(sum));
}

TEST(OrientationLaw, DrawsRotationsToWithinTheirBound) {
  std::mt19937_64 random(2);
  double worst_of_all = 0.0;
  for (const OrientationLaw& law : every_law()) {
    double worst = 0.0;
    const auto look_at = [&](const LawPoint& point) {
      const Transformd r = rotation_at(law, point);
      worst = std::max(worst, deviation(r));
      ASSERT_NEAR(dot(r.row_x, cross(r.row_y, r.row_z)), 1.0, 1e-13) << law.name();
    };
    for (int k = 0; k < 4000; ++k) look_at(random_law_point(random));
    for (int k = 0; k < 2000; ++k) {  // the ends of the unit cube
      LawPoint point = random_law_point(random);
      for (double& u : point) {
        if (random() % 2 == 0) u = kEnds[random() % kEnds.size()];
      }
      look_at(point);
    }
    // |R|_2^2 <= 1 + |R R^T - I|, so |R|_2 - 1 is at most half of it.
    EXPECT_LE(0.5 * worst, kDrawnRotationError) << law.name();
    if (law.dimension() > 0) {
      EXPECT_GT(worst, 0.0) << law.name();
    }
    worst_of_all = std::max(worst_of_all, 0.5 * worst);
  }
  RecordProperty("log2_of_worst", std::to_string(std::log2(worst_of_all)));
}

TEST(OrientationLaw, OfOnsagerStaysARotationWhereRoundingTakesThePolarAngleToItsEnd) {
  // At the last coordinates 1 - cos is 2 but for rounding, on either side of it.
  std::mt19937_64 random(12);
  for (int k = 0; k < 50000; ++k) {
    const OrientationLaw law = OrientationLaw::onsager(std::exp2(-58.0 + 63.0 * random_in_unit_interval(random)));
    const LawPoint ends = {1.0 - 0x1p-53, 0.5 - 0x1p-53, 0.1, 0.2, 0.3};
    const Transformd r = rotation_at(law, ends);
    ASSERT_NEAR(dot(r.row_x, r.row_x), 1.0, 1e-14) << law.name();
    ASSERT_NEAR(dot(r.row_z, r.row_z), 1.0, 1e-14) << law.name();
  }
}

TEST(OrientationLaw, LanesGiveTheBitsOfOneLane) {
  constexpr int W = 4;
  std::mt19937_64 random(3);
  for (const OrientationLaw& law : every_law()) {
    for (int round = 0; round < 300; ++round) {
      std::array<LawPoint, W> points;
      std::array<ArrayLanes<W>, OrientationLaw::kMaxDimension> packet;
      for (std::size_t k = 0; k < W; ++k) {
        points[k] = random_law_point(random);
        if (random() % 4 == 0) points[k][random() % 2] = kEnds[random() % kEnds.size()];
        for (std::size_t j = 0; j < packet.size(); ++j) packet[j].lane[k] = points[k][j];
      }
      const Transform<ArrayLanes<W>> wide = law.rotation(std::span<const ArrayLanes<W>>(packet));
      for (std::size_t k = 0; k < W; ++k) {
        const Transformd one = rotation_at(law, points[k]);
        for (const auto& [row, wide_row] :
             {std::pair(one.row_x, wide.row_x), std::pair(one.row_y, wide.row_y), std::pair(one.row_z, wide.row_z)}) {
          ASSERT_EQ(bits_of(row.x), bits_of(wide_row.x.lane[k])) << law.name();
          ASSERT_EQ(bits_of(row.y), bits_of(wide_row.y.lane[k])) << law.name();
          ASSERT_EQ(bits_of(row.z), bits_of(wide_row.z.lane[k])) << law.name();
        }
      }
    }
  }
}

// Mean and standard error of what is seen.
class Mean {
 public:
  void add(double x) {
    sum_ += x;
    sum_sq_ += x * x;
    ++n_;
  }
  void expect(double truth, const std::string& what) const {
    const double mean = sum_ / n_;
    const double error = std::sqrt(std::max(0.0, sum_sq_ / n_ - mean * mean) / n_);
    EXPECT_LE(std::fabs(mean - truth), kZ * error + 1e-14)
        << what << ": " << mean << " +- " << error << ", not " << truth;
  }

 private:
  double sum_ = 0.0, sum_sq_ = 0.0;
  int n_ = 0;
};

constexpr int kDraws = 100000;

// |sin| of the angle between the bodies' z axes, without the cancellation of 1 - cos^2.
double sine_between_axes(const Transformd& r) { return std::hypot(r.row_x.z, r.row_y.z); }

void expect_mean_sine(const OrientationLaw& law, double truth) {
  std::mt19937_64 random(4);
  Mean sine;
  for (int k = 0; k < kDraws; ++k) sine.add(sine_between_axes(rotation_at(law, random_law_point(random))));
  sine.expect(truth, "<|sin gamma|> of " + law.name());
}

TEST(OrientationLaw, OfAConeHasTheKnownMeanSine) {
  expect_mean_sine(OrientationLaw::cone(10), .15674751);
  expect_mean_sine(OrientationLaw::cone(20), .30597567);
  expect_mean_sine(OrientationLaw::cone(30), .44088106);
  expect_mean_sine(OrientationLaw::cone(45), .60495531);
  expect_mean_sine(OrientationLaw::cone(60), .71470601);
  expect_mean_sine(OrientationLaw::cone(75), .77095325);
  expect_mean_sine(OrientationLaw::cone(90), std::numbers::pi / 4);
}

TEST(OrientationLaw, OfOnsagerHasTheKnownMeanSine) {
  expect_mean_sine(OrientationLaw::onsager(0), std::numbers::pi / 4);
  expect_mean_sine(OrientationLaw::onsager(1e-18), std::numbers::pi / 4);
  expect_mean_sine(OrientationLaw::onsager(1), .78357786);
  expect_mean_sine(OrientationLaw::onsager(2), .76690454);
  expect_mean_sine(OrientationLaw::onsager(5), .65087646);
  expect_mean_sine(OrientationLaw::onsager(10), .50912456);
  expect_mean_sine(OrientationLaw::onsager(20), .37795979);
  expect_mean_sine(OrientationLaw::onsager(30), .31356589);
  // (pi/2) I_2(2 alpha) / sinh^2(alpha) tends to sqrt(pi/alpha).
  expect_mean_sine(OrientationLaw::onsager(1e8), std::sqrt(std::numbers::pi / 1e8));
}

// E cos^k(theta) of one body.
struct Moments {
  double second, fourth;
};

Moments moments_of_cone(double degrees) {  // cos uniform on [c, 1]
  const double c = std::cos(degrees * std::numbers::pi / 180.0);
  if (c > 1.0 - 1e-12) return {1.0, 1.0};
  return {(1 - c * c * c) / (3 * (1 - c)), (1 - std::pow(c, 5)) / (5 * (1 - c))};
}

Moments moments_of_onsager(double alpha) {  // cosh(alpha x) on [0, 1], by the midpoint rule
  constexpr int n = 200000;
  double sum = 0.0, second = 0.0, fourth = 0.0;
  for (int k = 0; k < n; ++k) {
    const double x = (k + 0.5) / n;
    const double density = std::exp(alpha * (x - 1)) + std::exp(-alpha * (x + 1));
    sum += density;
    second += density * x * x;
    fourth += density * x * x * x * x;
  }
  return {second / sum, fourth / sum};
}

// With P_l the mean Legendre polynomials of cos(theta), those of cos(gamma) are their squares: the azimuths are
// uniform and independent.
void expect_moments(const OrientationLaw& law, const Moments& one_body) {
  std::mt19937_64 random(5);
  Mean odd, p2, p4, third;
  for (int k = 0; k < kDraws; ++k) {
    const double c = rotation_at(law, random_law_point(random)).row_z.z;
    const double c2 = c * c;
    odd.add(c);
    third.add(c * c2);
    p2.add(0.5 * (3 * c2 - 1));
    p4.add((35 * c2 * c2 - 30 * c2 + 3) / 8);
  }
  const double p2_of_one = 0.5 * (3 * one_body.second - 1);
  const double p4_of_one = (35 * one_body.fourth - 30 * one_body.second + 3) / 8;
  odd.expect(0.0, "cos of " + law.name());
  third.expect(0.0, "cos^3 of " + law.name());
  p2.expect(p2_of_one * p2_of_one, "P2 of " + law.name());
  p4.expect(p4_of_one * p4_of_one, "P4 of " + law.name());
}

TEST(OrientationLaw, LegendreMomentsAreTheSquaresOfOneBodys) {
  for (const double degrees : {10.0, 30.0, 60.0, 90.0}) {
    expect_moments(OrientationLaw::cone(degrees), moments_of_cone(degrees));
  }
  for (const double alpha : {0.0, 0.3, 2.0, 10.0, 40.0}) {
    expect_moments(OrientationLaw::onsager(alpha), moments_of_onsager(alpha));
  }
}

TEST(OrientationLaw, OfOneBodyAloneIsWhatItsDensitySays) {
  // With the other body's axis within 2^-26 of z the third column of R_A^T is one body's axis: the map at u_B's end,
  // where d = 1 - cos is smallest. Kolmogorov's distance of the empirical from the true distribution of cos(theta).
  const auto expect_distribution = [](const OrientationLaw& law, const auto& distribution) {
    std::mt19937_64 random(6);
    constexpr int n = 20000;
    std::vector<double> cosines;
    for (int k = 0; k < n; ++k) {
      LawPoint point = random_law_point(random);
      point[1] = 0.5 + 0x1p-53;  // cos just below 1
      cosines.push_back(rotation_at(law, point).row_z.z);
    }
    std::sort(cosines.begin(), cosines.end());
    double distance = 0.0;
    for (int k = 0; k < n; ++k) {
      const double truth = distribution(cosines[static_cast<std::size_t>(k)]);
      distance = std::max({distance, std::fabs((k + 1.0) / n - truth), std::fabs(static_cast<double>(k) / n - truth)});
    }
    EXPECT_LE(distance * std::sqrt(n), 2.5) << law.name();  // 2 exp(-2 * 2.5^2): one in 130 000
    EXPECT_GT(distance * std::sqrt(n), 0.2) << law.name();
  };
  const double c = std::cos(std::numbers::pi / 6);
  expect_distribution(OrientationLaw::cone(30), [c](double x) {
    return 0.5 + (x < 0.0 ? -0.5 + 0.5 * std::max(0.0, 1 + x) / (1 - c) : 0.5 * std::max(0.0, x - c) / (1 - c));
  });
  for (const double alpha : {0.5, 3.0, 12.0}) {
    expect_distribution(OrientationLaw::onsager(alpha),
                        [alpha](double x) { return 0.5 + 0.5 * std::sinh(alpha * x) / std::sinh(alpha); });
  }
}

// E R_ij = 0, E R_ij^2 = 1/3, E R_ij^4 = 1/5, E trace^2 = 1 (the mean of squared characters), for Haar measure.
void expect_uniform(const OrientationLaw& law) {
  std::mt19937_64 random(7);
  constexpr int n = 200000;
  std::array<double, 9> first{}, second{}, fourth{};
  double trace_sq = 0.0;
  for (int k = 0; k < n; ++k) {
    const Transformd r = rotation_at(law, random_law_point(random));
    const std::array<double, 9> e = {r.row_x.x, r.row_x.y, r.row_x.z, r.row_y.x, r.row_y.y,
                                     r.row_y.z, r.row_z.x, r.row_z.y, r.row_z.z};
    for (std::size_t i = 0; i < 9; ++i) {
      first[i] += e[i];
      second[i] += e[i] * e[i];
      fourth[i] += e[i] * e[i] * e[i] * e[i];
    }
    trace_sq += (e[0] + e[4] + e[8]) * (e[0] + e[4] + e[8]);
  }
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(first[i] / n, 0.0, kZ * std::sqrt(1.0 / 3 / n)) << law.name();
    EXPECT_NEAR(second[i] / n, 1.0 / 3, kZ * std::sqrt((1.0 / 5 - 1.0 / 9) / n)) << law.name();
    EXPECT_NEAR(fourth[i] / n, 1.0 / 5, kZ * std::sqrt((1.0 / 9 - 1.0 / 25) / n)) << law.name();
  }
  EXPECT_NEAR(trace_sq / n, 1.0, kZ * std::sqrt(2.0 / n)) << law.name();  // E trace^4 = 3
}

TEST(OrientationLaw, IsUniformWhereItRestrictsNothing) {
  for (const OrientationLaw& law : {OrientationLaw::isotropic(), OrientationLaw::cone(90), OrientationLaw::onsager(0),
                                    OrientationLaw::onsager(1e-18), OrientationLaw::onsager(1e-9)}) {
    expect_uniform(law);
  }
}

TEST(OrientationLaw, RollsAreUniformAndIndependentOfTheAxes) {
  // R = Rz(-psi_A) X Rz(psi_B): the third column turns about z with -psi_A, the third row with psi_B.
  for (const OrientationLaw& law : {OrientationLaw::cone(25), OrientationLaw::onsager(4)}) {
    std::mt19937_64 random(8);
    std::array<Mean, 12> means;
    for (int k = 0; k < kDraws; ++k) {
      const Transformd r = rotation_at(law, random_law_point(random));
      const double s = sine_between_axes(r);
      const double cos_a = r.row_x.z / s, sin_a = r.row_y.z / s, cos_b = r.row_z.x / s, sin_b = r.row_z.y / s;
      const std::array<double, 12> zeros = {cos_a,
                                            sin_a,
                                            cos_b,
                                            sin_b,
                                            cos_a * cos_a - 0.5,
                                            cos_b * cos_b - 0.5,
                                            cos_a * sin_a,
                                            cos_b * sin_b,
                                            cos_a * cos_b,
                                            sin_a * sin_b,
                                            cos_a * sin_b,
                                            (cos_a * cos_b + sin_a * sin_b) * r.row_z.z};
      for (std::size_t i = 0; i < zeros.size(); ++i) means[i].add(zeros[i]);
    }
    for (std::size_t i = 0; i < means.size(); ++i) means[i].expect(0.0, law.name() + " " + std::to_string(i));
  }
}

TEST(OrientationLaw, TreatsAAndBAlike) {
  // Of R and its transpose, functions that a law which did not would tell apart.
  for (const OrientationLaw& law : every_law()) {
    if (law.dimension() == 0 || law.kind() == OrientationLaw::Kind::each || law.has_axes()) continue;
    std::mt19937_64 random(9);
    std::array<Mean, 4> differences;
    for (int k = 0; k < kDraws / 2; ++k) {
      const Transformd r = rotation_at(law, random_law_point(random));
      differences[0].add(r.row_x.z * r.row_x.z - r.row_z.x * r.row_z.x);
      differences[1].add(std::fabs(r.row_y.z) - std::fabs(r.row_z.y));
      differences[2].add(r.row_x.y * r.row_x.y - r.row_y.x * r.row_y.x);
      differences[3].add(r.row_x.x * r.row_x.y * r.row_x.z - r.row_x.x * r.row_y.x * r.row_z.x);
    }
    for (const Mean& difference : differences) difference.expect(0.0, law.name());
  }
}

TEST(OrientationLaw, OfAConeOfNoAngleIsParallelOrAntiparallelWithAnyRoll) {
  std::mt19937_64 random(10);
  const OrientationLaw law = OrientationLaw::cone(0);
  Mean antiparallel, cos_roll, cos_roll_sq;
  for (int k = 0; k < 20000; ++k) {
    const Transformd r = rotation_at(law, random_law_point(random));
    ASSERT_EQ(std::fabs(r.row_z.z), 1.0);
    ASSERT_EQ(sine_between_axes(r), 0.0);
    antiparallel.add(r.row_z.z < 0.0 ? 1.0 : 0.0);
    cos_roll.add(r.row_x.x);
    cos_roll_sq.add(r.row_x.x * r.row_x.x);
  }
  antiparallel.expect(0.5, "antiparallel");
  cos_roll.expect(0.0, "cos of the roll");
  cos_roll_sq.expect(0.5, "cos^2 of the roll");
}

TEST(OrientationLaw, KeepsWithinTheCone) {
  std::mt19937_64 random(11);
  for (const double degrees : {1e-5, 1.0, 20.0}) {
    const double least = std::cos(2.0 * degrees * std::numbers::pi / 180.0);
    double seen = 1.0;
    for (int k = 0; k < 20000; ++k) {
      const double c = std::fabs(rotation_at(OrientationLaw::cone(degrees), random_law_point(random)).row_z.z);
      ASSERT_GE(c, least - 1e-14);
      seen = std::min(seen, c);
    }
    EXPECT_LE(1.0 - seen, (1.0 - least) * 1.01 + 1e-14);
    EXPECT_GE(1.0 - seen, (1.0 - least) * 0.9 - 1e-14) << "and fills it";
  }
}

TEST(OrientationLaw, FixedTurnsBByItsQuaternionInAsFrame) {
  // A quarter turn about z takes B's x to A's y.
  const LawPoint point{};
  const double half = std::sqrt(0.5);
  const Transformd r = rotation_at(OrientationLaw::fixed(half, 0, 0, half), point);
  EXPECT_LE(norm(r({1, 0, 0}) - Vec3d{0, 1, 0}), 1e-15);
  const Transformd i = rotation_at(OrientationLaw::aligned(), point);
  EXPECT_EQ(deviation(i), 0.0);
  EXPECT_EQ(i.row_x.x + i.row_y.y + i.row_z.z, 3.0);
}

TEST(OrientationLaw, OfEachBodyIsThatOfBothWhereTheyAreAlike) {
  EXPECT_EQ(OrientationLaw::each(AxisLaw::cone(20), AxisLaw::cone(20)), OrientationLaw::cone(20));
  EXPECT_EQ(OrientationLaw::each(AxisLaw(), AxisLaw()), OrientationLaw::isotropic());
  EXPECT_EQ(OrientationLaw::each(AxisLaw::aligned(), AxisLaw::aligned()), OrientationLaw::aligned());
  const OrientationLaw unlike = OrientationLaw::each(AxisLaw::aligned(), AxisLaw::onsager(5));
  EXPECT_EQ(unlike.name(), "A aligned, B onsager:5");
  EXPECT_EQ(unlike.order_parameter(), std::nullopt);
  EXPECT_EQ(unlike.order_parameters()->at(0), 1.0);
  EXPECT_EQ(unlike.order_parameters()->at(1), AxisLaw::onsager(5).order_parameter());
  // Beside a body that is turned in any way the other one's law is not seen.
  const OrientationLaw one_isotropic = OrientationLaw::each(AxisLaw(), AxisLaw::cone(5));
  EXPECT_EQ(one_isotropic.kind(), OrientationLaw::Kind::isotropic);
  EXPECT_EQ(one_isotropic.name(), "A isotropic, B cone:5");
  EXPECT_FALSE(one_isotropic.order_parameter());
  expect_uniform(one_isotropic);
}

TEST(OrientationLaw, OfEachBodyHasTheProductOfItsLegendreMoments) {
  const OrientationLaw law = OrientationLaw::each(AxisLaw::maier_saupe(3), AxisLaw::table(sample_table()));
  std::mt19937_64 random(13);
  Mean p2;
  for (int k = 0; k < kDraws; ++k) {
    const double c = rotation_at(law, random_law_point(random)).row_z.z;
    p2.add(0.5 * (3 * c * c - 1));
  }
  const std::array<double, 2> each = *law.order_parameters();
  EXPECT_GT(each[0] * each[1], 0.05);
  p2.expect(each[0] * each[1], "P2 of " + law.name());
}

TEST(OrientationLaw, AboutOtherAxesTurnsThemAsTheLawAboutZTurnsZ) {
  const Vec3d a{1.0, 0.0, 0.0}, b{0.6, 0.0, -0.8};
  const OrientationLaw law = OrientationLaw::cone(30), turned = law.about(a, {3.0, 0.0, -4.0});
  EXPECT_EQ(turned.name(), "cone:30 about 1,0,0 and 0.6,0,-0.8");
  EXPECT_EQ(law.about({0, 0, 2}, {0, 0, 1}), law);
  const OrientationLaw once = law.about({0, 3, 4}, {1, 2, 3});
  EXPECT_EQ(law.about(once.axis_of(0), once.axis_of(1)), once) << "normalised once for all";
  EXPECT_EQ(law.about({0, 3, 0}, {0, 1, 0}).name(), "cone:30 about 0,1,0");
  std::mt19937_64 random(14);
  for (int k = 0; k < 1000; ++k) {
    const LawPoint point = random_law_point(random);
    const Transformd r = rotation_at(turned, point);
    ASSERT_NEAR(dot(a, r(b)), rotation_at(law, point).row_z.z, 1e-14);
  }
  for (const OrientationLaw& none :
       {OrientationLaw::isotropic(), OrientationLaw::aligned(), OrientationLaw::fixed(1, 0, 0, 0)}) {
    EXPECT_THROW(none.about(a, b), UsageError);
  }
  EXPECT_THROW(law.about({0, 0, 0}, b), UsageError);
  EXPECT_THROW(law.about(a, {HUGE_VAL, 0, 0}), UsageError);
}

TEST(OrientationLaw, OfOneBodyAboutAnotherAxisTurnsThatAxis) {
  const OrientationLaw law = OrientationLaw::maier_saupe(-5).about({0, 1, 0}, {0, 1, 0});
  std::mt19937_64 random(15);
  Mean p2;
  for (int k = 0; k < kDraws; ++k) {
    const LawPoint point = random_law_point(random);
    const double c = law.rotation_of_body(std::span<const double>(point)).row_z.y;
    p2.add(0.5 * (3 * c * c - 1));
  }
  p2.expect(*law.order_parameter(), "P2 of " + law.name());
}

TEST(OrientationLaw, PutsTheEndsAndTheMiddleOfThePolarCoordinateWhereTheDistributionHasThem) {
  // A's axis is z but for rounding (the least distance from it), so R_zz is cos(theta) of B's.
  const auto cos_of_b = [](const OrientationLaw& law, double u) {
    const std::array<double, OrientationLaw::kMaxDimension> point = {0.5 + 0x1p-53, u, 0.3, 0.4, 0.6};
    return law.rotation(std::span<const double>(point)).row_z.z;
  };
  const double last = 1.0 - 0x1p-53;
  for (const double degrees : {5.0, 30.0, 60.0, 89.0}) {
    const double cos_edge = std::cos(degrees * std::numbers::pi / 180.0);
    EXPECT_NEAR(cos_of_b(OrientationLaw::cone(degrees), last), cos_edge, 1e-7);
    EXPECT_NEAR(cos_of_b(OrientationLaw::cone(degrees), 0.75), 0.5 * (1.0 + cos_edge), 1e-7);
    EXPECT_NEAR(cos_of_b(OrientationLaw::cone(degrees), 0.25), -0.5 * (1.0 + cos_edge), 1e-7);
  }
  for (const double alpha : {0.01, 0.3, 1.0, 5.0, 40.0}) {
    // Of the density exp(alpha cos) half lies above 1 + log((1 + exp(-2 alpha))/2)/alpha.
    const double median = 1.0 + std::log(0.5 * (1.0 + std::exp(-2.0 * alpha))) / alpha;
    EXPECT_NEAR(cos_of_b(OrientationLaw::onsager(alpha), 0.75), median, 1e-7) << alpha;
    EXPECT_NEAR(cos_of_b(OrientationLaw::onsager(alpha), 0.25), -median, 1e-7) << alpha;
    if (alpha > 5.0) continue;  // exp(-2 alpha) is less than the last coordinate leaves
    EXPECT_NEAR(cos_of_b(OrientationLaw::onsager(alpha), last), -1.0, 1e-7) << alpha;
  }
}

}  // namespace
}  // namespace vex
