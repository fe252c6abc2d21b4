// Monte Carlo against true values. Every seed is fixed, so a test either passes always or never; its limit of 4
// standard errors would fail one of 16 000 right estimators, and the biased ones at the end show that it does fail
// wrong ones.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/sampling/monte_carlo.h"
#include "shapes/any_shape.h"
#include "shapes/formula.h"
#include "tests/referees/bodies.h"

namespace vex {
namespace {

VolumeEstimate estimate(const ConvexBody& a, const ConvexBody& b, MonteCarloSettings settings) {
  settings.n_threads = 2;
  const RunRecord record = run_monte_carlo(a, b, settings);
  EXPECT_TRUE(record.complete);
  EXPECT_EQ(record.tally.n_undecided, 0u);
  return hit_or_miss_estimate(record.tally, settings.domain.volume);
}

MonteCarloSettings to_relative_error(const Domain& domain, double relative_error) {
  MonteCarloSettings settings;
  settings.domain = domain;
  settings.stop.relative_error = relative_error;
  return settings;
}

double z_of(const VolumeEstimate& found, double truth) { return (found.excluded_volume - truth) / found.std_error; }

// Shapes are written with 17 digits, so that their sizes are the doubles meant.
std::string box_text(double a, double b, double c) {
  char text[128];
  std::snprintf(text, sizeof text, "box:%.17g,%.17g,%.17g", a, b, c);
  return text;
}

struct Case {
  std::string name, a, b;
  double truth;
};

class TrueValues : public testing::TestWithParam<Case> {};

TEST_P(TrueValues, AreReproducedWithinFourStandardErrors) {
  const ConvexBody a = parse_shape(GetParam().a).body, b = parse_shape(GetParam().b).body;
  for (const Domain& domain : {ball_domain(a, b), box_domain(a, b)}) {
    const VolumeEstimate found = estimate(a, b, to_relative_error(domain, 1e-3));
    EXPECT_LE(found.std_error, 1e-3 * found.excluded_volume);
    EXPECT_LE(std::fabs(z_of(found, GetParam().truth)), 4.0)
        << found.excluded_volume << " +- " << found.std_error << " in the " << name_of(domain.kind);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, TrueValues,
    testing::Values(Case{"Cube", "box:1,1,1", "box:1,1,1", 11.0},
                    Case{"Capsule", "capsule:1,0.25", "capsule:1,0.25", 2.8797932657906435},
                    Case{"SphereAndCube", "sphere:0.62035049089940009", "box:1,1,1", 9.349084841933458},
                    Case{"CubeAndSphere", "box:1,1,1", "sphere:0.62035049089940009", 9.349084841933458},
                    Case{"Ellipsoid", "ellipsoid:1,2,3", "ellipsoid:1,2,3", 10.173618525 * 8 * std::numbers::pi},
                    Case{"BoxOfRatioEight", box_text(4, 0.5, 0.5), box_text(4, 0.5, 0.5), 23.25},
                    Case{"BoxOfRatioATenth", box_text(1, 10, 10), box_text(1, 10, 10),
                         100 * (2 * (1 + 21 * 240 / 400.0))}),
    [](const auto& test_case) { return test_case.param.name; });

TEST(TrueValuesOfBalls, AreExactInTheBallDomainAndRightInTheBox) {
  const ConvexBody a = parse_shape("sphere:1").body, b = parse_shape("sphere:2").body;
  const double truth = 4.0 / 3.0 * std::numbers::pi * 27.0;
  const VolumeEstimate certain = estimate(a, b, to_relative_error(ball_domain(a, b), 1e-3));
  EXPECT_NEAR(certain.excluded_volume, truth, 1e-10 * truth);
  EXPECT_GT(certain.std_error, 0.0);
  EXPECT_LE(std::fabs(z_of(estimate(a, b, to_relative_error(box_domain(a, b), 1e-3)), truth)), 4.0);
}

TEST(TrueValuesOfAlignedBodies, CubesAndBoxesAndEllipsoids) {
  const auto aligned = [](const std::string& a, const std::string& b) {
    const ConvexBody body_a = parse_shape(a).body, body_b = parse_shape(b).body;
    MonteCarloSettings settings = to_relative_error(best_domain(body_a, body_b), 1e-3);
    settings.law = OrientationLaw::aligned();
    return estimate(body_a, body_b, settings);
  };
  EXPECT_LE(std::fabs(z_of(aligned("box:1,1,1", "box:1,1,1"), 8.0)), 4.0);
  EXPECT_LE(std::fabs(z_of(aligned("box:1,2,3", "box:3,1,2"), 4.0 * 3.0 * 5.0)), 4.0) << "edges add up";
  const double v = 4.0 / 3.0 * std::numbers::pi * 6.0;
  EXPECT_LE(std::fabs(z_of(aligned("ellipsoid:1,2,3", "ellipsoid:1,2,3"), 8.0 * v)), 4.0) << "an affine image of balls";
}

// Every ordered pair of bodies against the formula.
class EveryPair : public testing::TestWithParam<NamedPair> {};

TEST_P(EveryPair, AgreesWithTheFormula) {
  const Body a = parse_shape(GetParam().a), b = parse_shape(GetParam().b);
  const VolumeEstimate found = estimate(a.body, b.body, to_relative_error(box_domain(a.body, b.body), 5e-3));
  EXPECT_LE(std::fabs(z_of(found, average_excluded_volume(a.measures, b.measures))), 4.5);
}

INSTANTIATE_TEST_SUITE_P(FormlessPairs, EveryPair, testing::ValuesIn(formless_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });
INSTANTIATE_TEST_SUITE_P(Pairs, EveryPair, testing::ValuesIn(ordered_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });

TEST(Coverage, OverManySeedsTheIntervalsHoldTheTruth) {
  // 400 runs: the 95 % interval holds the truth 95 % of the time, and z has mean 0 and variance 1.
  const ConvexBody cube = parse_shape("box:1,1,1").body;
  MonteCarloSettings settings;
  settings.domain = ball_domain(cube, cube);
  settings.stop.trials = 5000;
  constexpr int runs = 400;
  int held = 0;
  double sum = 0.0, sum_sq = 0.0;
  for (int k = 0; k < runs; ++k) {
    settings.seed = 1000 + static_cast<std::uint64_t>(k);
    const VolumeEstimate found = estimate(cube, cube, settings);
    held += found.ci95.lower <= 11.0 && 11.0 <= found.ci95.upper ? 1 : 0;
    sum += z_of(found, 11.0);
    sum_sq += z_of(found, 11.0) * z_of(found, 11.0);
  }
  EXPECT_NEAR(static_cast<double>(held) / runs, 0.95, 4.5 * std::sqrt(0.95 * 0.05 / runs));
  EXPECT_NEAR(sum / runs, 0.0, 4.5 / std::sqrt(runs));
  EXPECT_NEAR(sum_sq / runs, 1.0, 4.5 * std::sqrt(2.0 / runs));
}

// An overlap test that is a little wrong, always to one side.
class ShrunkDistances final : public OverlapBackend {
 public:
  ShrunkDistances(const ConvexBody& a, const ConvexBody& b, double factor)
      : gjk_(gjk_backend().make(a, b)), factor_(factor) {}
  void decide(std::span<const Pose> poses, std::span<Verdict> verdicts) override {
    for (std::size_t k = 0; k < poses.size(); ++k) {
      Transformd pose = poses[k].a_from_b();
      pose.translation = factor_ * pose.translation;
      verdicts[k] = gjk_->decide(pose);
    }
  }

 private:
  std::unique_ptr<OverlapBackend> gjk_;
  double factor_;
};

TEST(BiasedEstimators, AreCaught) {
  const ConvexBody cube = parse_shape("box:1,1,1").body;
  MonteCarloSettings settings = to_relative_error(ball_domain(cube, cube), 1e-3);
  // Distances taken 0.2 % too short: a bias of 0.6 %.
  settings.backend = {"biased", true, [](const ConvexBody& a, const ConvexBody& b) {
                        return std::make_unique<ShrunkDistances>(a, b, 0.998);
                      }};
  EXPECT_GT(z_of(estimate(cube, cube, settings), 11.0), 4.0);
  // And the formula with M taken for the mean radius M / 4 pi.
  const Measures m = parse_shape("box:1,1,1").measures;
  settings.backend = gjk_backend();
  const double confused = 2.0 * m.volume + 2.0 * m.mean_radius() * m.surface_area / (4.0 * std::numbers::pi);
  EXPECT_GT(std::fabs(z_of(estimate(cube, cube, settings), confused)), 4.0);
}

}  // namespace
}  // namespace vex
