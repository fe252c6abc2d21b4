#include "shapes/estimators/depletion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/numeric/errors.h"
#include "shapes/any_shape.h"
#include "shapes/formula.h"

namespace vex {
namespace {

using std::numbers::pi;

constexpr double kZ = 4.5;

DepletionSettings settings_of(double ball_radius, std::uint64_t trials, std::uint64_t seed = 1) {
  DepletionSettings settings;
  settings.ball_radius = ball_radius;
  settings.trials = trials;
  settings.seed = seed;
  settings.threads = 2;
  return settings;
}

Transformd moved(double x, double y, double z) {
  Transformd pose;
  pose.translation = {x, y, z};
  return pose;
}

void expect_value(const DepletionValue& found, double truth, const char* what) {
  EXPECT_GT(found.std_error, 0.0) << what;
  EXPECT_LE(std::fabs(found.value - truth), kZ * found.std_error)
      << what << ": " << found.value << " +- " << found.std_error << ", not " << truth;
  EXPECT_LT(found.std_error, 0.05 * truth) << what;
  EXPECT_EQ(found.record.tally.n_undecided, 0u) << what;
}

/// Asakura and Oosawa's own: the lens of two equal balls of radius s, d apart.
double equal_lens(double s, double d) { return pi / 12.0 * (4.0 * s + d) * (2.0 * s - d) * (2.0 * s - d); }

/// The lens of two equal discs.
double disc_lens(double s, double d) {
  return 2.0 * s * s * std::acos(d / (2.0 * s)) - 0.5 * d * std::sqrt(4.0 * s * s - d * d);
}

TEST(Depletion, OverlapOfBallsIsTheKnownLens) {
  for (const double d : {0.1, 0.7, 1.3, 1.99}) EXPECT_NEAR(overlap_of_balls(1.0, 1.0, d), equal_lens(1.0, d), 1e-14);
  // By decimals of 80 digits: balls that hardly touch, of unlike sizes, and very large and small ones.
  EXPECT_DOUBLE_EQ(overlap_of_balls(1.0, 1e-20, 1.0), 2.0943951023931953e-60);
  EXPECT_DOUBLE_EQ(overlap_of_balls(1e103, 1.0, 1e103), 2.0943951023931953);
  EXPECT_DOUBLE_EQ(overlap_of_balls(1e100, 1e100, 1e100), 1.3089969389957472e300);
  EXPECT_NEAR(overlap_of_balls(1e-100, 1e-100, 1e-100), 1.3089969389957472e-300, 1e-314);
  EXPECT_NEAR(overlap_of_balls(0.09446608887123319, 0.002637361716864607, 0.09710345058809779), 3.88e-37, 0.01e-37);
  EXPECT_EQ(overlap_of_balls(1.0, 2.0, 3.0), 0.0);
  EXPECT_NEAR(overlap_of_balls(1.0, 2.0, 1.0), 4.0 / 3.0 * pi, 1e-14);
  EXPECT_NEAR(overlap_of_balls(1.0, 2.0, 1.0 + 1e-9), 4.0 / 3.0 * pi, 1e-8);
  // By the discs that both are cut into, with the midpoint rule.
  const double r_1 = 1.0, r_2 = 0.6, d = 1.2;
  constexpr int n = 200000;
  double sum = 0.0;
  for (int k = 0; k < n; ++k) {
    const double x = -1.0 + 3.0 * (k + 0.5) / n;
    sum += pi * std::max(0.0, std::min(r_1 * r_1 - x * x, r_2 * r_2 - (x - d) * (x - d))) * 3.0 / n;
  }
  EXPECT_NEAR(overlap_of_balls(r_1, r_2, d), sum, 1e-8);
}

TEST(Depletion, OfSpheresFollowsTheClosedForm) {
  for (const double d : {2.0, 2.1, 2.3}) {
    const Body sphere = parse_shape("sphere:1");
    expect_value(depletion_at(sphere, sphere, moved(0.0, d, 0.0), settings_of(0.2, 100000)).overlap_volume,
                 equal_lens(1.2, d), "equal");
    const Body small = parse_shape("sphere:0.5");
    expect_value(depletion_at(sphere, small, moved(0.6 * (d - 0.4), 0.0, 0.8 * (d - 0.4)), settings_of(0.3, 100000))
                     .overlap_volume,
                 overlap_of_balls(1.3, 0.8, d - 0.4), "unlike");
  }
}

// Nearly touching shells: of few points most runs have no hit, and their values do not differ.
TEST(Depletion, OfPointsThatAllMissTheErrorIsThatOfOneThatDoesNot) {
  const Body sphere = parse_shape("sphere:1");
  const double truth = equal_lens(1.2, 2.39);
  int n_without = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const std::uint64_t trials : {1u, 60u, 300u}) {
      const DepletionValue found =
          depletion_at(sphere, sphere, moved(0.0, 2.39, 0.0), settings_of(0.2, trials, seed)).overlap_volume;
      EXPECT_LE(std::fabs(found.value - truth), kZ * found.std_error) << "seed " << seed << ", " << trials;
      n_without += found.value == 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(n_without, 0);
  OrientationLaw any;
  const DepletionAverage mean =
      depletion_average(parse_shape("box:1,1,1"), parse_shape("box:1,1,1"), 1.4, any, settings_of(0.05, 60, 3));
  EXPECT_GT(mean.overlap_volume.std_error, 1e-4);
}

TEST(Depletion, OfParallelCapsulesIsALensLongerByTheirStraightPart) {
  const Body rod = parse_shape("capsule:4,0.5");
  const double s = 0.7, d = 1.1;
  const DepletionAtPose found = depletion_at(rod, rod, moved(d, 0.0, 0.0), settings_of(0.2, 200000));
  EXPECT_EQ(found.bodies, Outcome::disjoint);
  expect_value(found.overlap_volume, 4.0 * disc_lens(s, d) + equal_lens(s, d), "capsules");
}

TEST(Depletion, OfCubesFaceToFaceHasRoundedRims) {
  const double edge = 1.0, r = 0.25, gap = 0.1, half = 0.5 * gap;
  // A cut at the height z above the middle: a square with a rim of the width sqrt(r^2 - z^2).
  const double rims = 0.5 * (r * r * std::acos(half / r) - half * std::sqrt(r * r - half * half));
  const double discs = pi * ((r * r * r - r * r * r / 3.0) - (r * r * half - half * half * half / 3.0));
  const double truth = 2.0 * (edge * edge * (r - half) + 4.0 * edge * rims + discs);
  const Body cube = parse_shape("box:1,1,1");
  expect_value(depletion_at(cube, cube, moved(0.0, 0.0, edge + gap), settings_of(r, 200000)).overlap_volume, truth,
               "cubes");
}

TEST(Depletion, TellsWhetherTheBodiesThemselvesOverlap) {
  const Body cube = parse_shape("box:1,1,1");
  EXPECT_EQ(depletion_at(cube, cube, moved(0.5, 0.0, 0.0), settings_of(0.1, 1000)).bodies, Outcome::overlap);
  const DepletionAtPose far = depletion_at(cube, cube, moved(5.0, 0.0, 0.0), settings_of(0.1, 1000));
  EXPECT_EQ(far.bodies, Outcome::disjoint);
  EXPECT_EQ(far.overlap_volume.value, 0.0);
  EXPECT_EQ(far.overlap_volume.std_error, 0.0);
  EXPECT_EQ(far.overlap_volume.record.tally.n_trials, 0u);
  EXPECT_TRUE(far.overlap_volume.complete);
  // Shells that touch.
  const Body sphere = parse_shape("sphere:1");
  const DepletionValue touching =
      depletion_at(sphere, sphere, moved(2.4, 0.0, 0.0), settings_of(0.2, 1000)).overlap_volume;
  EXPECT_LE(touching.value, touching.std_error);
  EXPECT_LT(touching.value, 1e-9);
}

/// Gauss and Legendre's ten nodes on an interval.
template <class F>
void for_each_node(double from, double to, const F& f) {
  constexpr double kNodes[5] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                                0.9739065285171717};
  constexpr double kWeights[5] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159820, 0.1494513491505806,
                                  0.0666713443086881};
  for (int k = 0; k < 5; ++k) {
    for (const double side : {-1.0, 1.0}) {
      f(0.5 * (from + to) + 0.5 * side * kNodes[k] * (to - from), 0.5 * kWeights[k] * (to - from));
    }
  }
}

TEST(Depletion, OverAllDistancesTheOverlapIsTheProductOfTheShellsVolumes) {
  // Needles never overlap, so nothing is taken out: the integral of |A_r and (t + R B_r)| over t is V(A_r) V(B_r).
  const Body needle = parse_shape("needle:1");
  const double r = 0.5, shell = 4.0 / 3.0 * pi * r * r * r + pi * r * r;
  double sum = 0.0, variance = 0.0;
  std::uint64_t seed = 10;
  for (const auto& [from, to] : {std::pair{0.0, 1.0}, std::pair{1.0, 2.0}}) {
    for_each_node(from, to, [&](double d, double weight) {
      const DepletionAverage found =
          depletion_average(needle, needle, d, OrientationLaw::isotropic(), settings_of(r, 10000, ++seed));
      EXPECT_EQ(found.free_share.value, 1.0);
      const double factor = weight * 4.0 * pi * d * d;
      sum += factor * found.overlap_volume.value;
      variance += std::pow(factor * found.overlap_volume.std_error, 2);
    });
  }
  EXPECT_LE(std::fabs(sum - shell * shell), kZ * std::sqrt(variance) + 1e-3 * shell * shell)
      << sum << " " << shell * shell;
  EXPECT_LT(std::sqrt(variance), 0.01 * shell * shell);
}

TEST(Depletion, OverAllDistancesWhatIsNotFreeIsTheExcludedVolume) {
  const Body box = parse_shape("box:1,1,2"), ball = parse_shape("sphere:0.5");
  double sum = 0.0, variance = 0.0;
  std::uint64_t seed = 50;
  // No box is nearer than 1 to where it may be; the share is smooth but for a few distances.
  for (const auto& [from, to] : {std::pair{1.0, 1.21}, std::pair{1.21, 1.5}, std::pair{1.5, 1.75}}) {
    for_each_node(from, to, [&](double d, double weight) {
      const DepletionAverage found =
          depletion_average(box, ball, d, OrientationLaw::isotropic(), settings_of(0.1, 10000, ++seed));
      const double factor = weight * 4.0 * pi * d * d;
      sum += factor * (1.0 - found.free_share.value);
      variance += std::pow(factor * found.free_share.std_error, 2);
    });
  }
  sum += 4.0 / 3.0 * pi;  // nothing is free below 1
  const double truth = average_excluded_volume(box.measures, ball.measures);
  EXPECT_LE(std::fabs(sum - truth), kZ * std::sqrt(variance) + 1e-3 * truth) << sum << " " << truth;
  EXPECT_LT(std::sqrt(variance), 0.01 * truth);
}

TEST(Depletion, MeansOfFreeOrientationsAreThoseOfThePosesThatAreFree) {
  const Body sphere = parse_shape("sphere:1");
  const DepletionAverage found =
      depletion_average(sphere, sphere, 2.2, OrientationLaw::isotropic(), settings_of(0.3, 100000));
  EXPECT_EQ(found.free_share.value, 1.0);
  EXPECT_LE(std::fabs(found.mean_of_free() - equal_lens(1.3, 2.2)), kZ * found.mean_of_free_error());
  const DepletionAverage none =
      depletion_average(sphere, sphere, 1.0, OrientationLaw::isotropic(), settings_of(0.3, 10000));
  EXPECT_EQ(none.overlap_volume.value, 0.0);
  EXPECT_EQ(none.free_share.value, 0.0);
  EXPECT_TRUE(std::isnan(none.mean_of_free()));
}

TEST(Depletion, IsTheSameOnAnyNumberOfThreadsAndRefusesWhatIsNoSetting) {
  const Body cube = parse_shape("box:1,1,1");
  DepletionSettings settings = settings_of(0.2, 20000);
  const double on_two = depletion_at(cube, cube, moved(1.1, 0.2, 0.0), settings).overlap_volume.value;
  settings.threads = 1;
  EXPECT_EQ(depletion_at(cube, cube, moved(1.1, 0.2, 0.0), settings).overlap_volume.value, on_two);
  for (const double radius : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    settings.ball_radius = radius;
    EXPECT_THROW(depletion_at(cube, cube, moved(2, 0, 0), settings), UsageError);
  }
  settings.ball_radius = 1e80;
  EXPECT_THROW(depletion_at(cube, cube, moved(2, 0, 0), settings), InputError);
  settings.ball_radius = 0.1;
  EXPECT_THROW(depletion_average(cube, cube, -1.0, {}, settings), UsageError);
}

}  // namespace
}  // namespace vex
