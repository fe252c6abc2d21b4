// The driver's other ways: Sobol' points, strata, and integrands.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/sampling/monte_carlo.h"
#include "engine/sampling/poses/fitted_domain.h"
#include "engine/sampling/radial/radial_estimator.h"
#include "shapes/any_shape.h"
#include "shapes/formula.h"

namespace vex {
namespace {

enum class Way { sobol_box, sobol_fitted, stratified, sobol_between_balls, radial, radial_sobol };
constexpr Way kWays[] = {Way::sobol_box,           Way::sobol_fitted, Way::stratified,
                         Way::sobol_between_balls, Way::radial,       Way::radial_sobol};

MonteCarloSettings settings_of(Way way, const ConvexBody& a, const ConvexBody& b, std::uint64_t trials) {
  MonteCarloSettings settings;
  settings.stop.trials = trials;
  settings.sequence = way == Way::stratified || way == Way::radial ? Sequence::random : Sequence::sobol;
  switch (way) {
    case Way::sobol_box: settings.domain = box_domain(a, b); break;
    case Way::sobol_fitted: settings.domain = fitted_domain(a, b); break;
    case Way::stratified:
    case Way::sobol_between_balls:
      settings.domain = ball_domain(a, b);
      settings.stratified = true;
      break;
    case Way::radial:
    case Way::radial_sobol:
      settings.integrand = [&a, &b, law = settings.law] { return std::make_unique<RadialEstimator>(a, b, law); };
      break;
  }
  return settings;
}

// An integrand of one line.
class Function final : public Integrand {
 public:
  using Value = std::function<double(std::span<const double>)>;
  Function(int dimension, Value value) : dimension_(dimension), value_(std::move(value)) {}
  int dimension() const override { return dimension_; }
  double scale() const override { return 1.0; }
  double relative_rounding() const override { return 1e-10; }
  double cost() const override { return 10.0; }
  Doubts evaluate(std::span<const double> points, std::span<double> values) override {
    Doubts doubts;
    std::vector<double> point(static_cast<std::size_t>(dimension_));
    for (std::size_t k = 0; k < values.size(); ++k) {
      for (std::size_t c = 0; c < point.size(); ++c) point[c] = points[c * values.size() + k];
      values[k] = value_(point);
      if (!std::isnan(values[k])) continue;
      values[k] = 0.5;
      doubts.push_back({k, 0.5});
    }
    return doubts;
  }

 private:
  int dimension_;
  Value value_;
};

MonteCarloSettings averaging(int dimension, Function::Value value, Sequence sequence, std::uint64_t trials) {
  MonteCarloSettings settings;
  settings.sequence = sequence;
  settings.stop.trials = trials;
  settings.integrand = [=] { return std::make_unique<Function>(dimension, value); };
  return settings;
}

const ConvexBody kNobody = parse_shape("sphere:1").body;

TEST(EstimatorsOfTheDriver, GiveTheSameSumsForAnyNumberOfThreadsAndInstructionSet) {
  const ConvexBody a = parse_shape("box:1,2,3").body, b = parse_shape("ellipsoid:1,1,2").body;
  for (const Way way : kWays) {
    for (const std::uint64_t trials : {1ull, 33ull, 5000ull, 40003ull}) {
      MonteCarloSettings settings = settings_of(way, a, b, trials);
      const RunRecord one = run_monte_carlo(a, b, settings);
      ASSERT_EQ(one.tally.n_trials, trials);
      const auto expect_same = [&](const std::string& what) {
        const RunRecord other = run_monte_carlo(a, b, settings);
        EXPECT_EQ(other.tally.by_class, one.tally.by_class) << what;
        EXPECT_EQ(other.tally.n_hits, one.tally.n_hits) << what;
        EXPECT_EQ(other.tally.all, one.tally.all) << what;
      };
      for (const int n : {2, 5}) {
        settings.n_threads = n;
        expect_same(std::to_string(n) + " threads, way " + std::to_string(static_cast<int>(way)));
      }
      for (const InstructionSet set : instruction_sets()) {
        settings.instruction_set = set;
        settings.backend = gjk_backend(set);
        expect_same(std::string(name_of(set)));
      }
    }
  }
}

TEST(EstimatorsOfTheDriver, CountTheTrialsOfEachPoseOneByOne) {
  const ConvexBody a = parse_shape("box:1,2,3").body, b = parse_shape("cone:1,1").body;
  for (const Way way : {Way::sobol_box, Way::sobol_fitted, Way::stratified, Way::sobol_between_balls}) {
    MonteCarloSettings settings = settings_of(way, a, b, 3001);
    const RunRecord record = run_monte_carlo(a, b, settings);
    const std::unique_ptr<OverlapBackend> backend = gjk_backend().make(a, b);
    std::vector<std::uint64_t> hits(kClasses, 0), trials(kClasses, 0);
    std::uint64_t n_hits = 0;
    for (std::uint64_t i = 0; i < 3001; ++i) {
      const Transformd pose = trial_pose(a, b, settings, i);
      const Verdict verdict = backend->decide(pose);
      ASSERT_NE(verdict.outcome, Outcome::undecided);
      ++trials[i % kClasses];
      if (verdict.outcome != Outcome::overlap) continue;
      ++hits[i % kClasses];
      ++n_hits;
    }
    EXPECT_EQ(record.tally.n_hits, n_hits);
    ASSERT_EQ(record.tally.by_class.classes.size(), kClasses);
    for (std::size_t k = 0; k < kClasses; ++k) {
      const ClassSums& sums = record.tally.by_class.classes[k];
      EXPECT_EQ(sums.n, trials[k]);
      if (way != Way::sobol_fitted) {
        EXPECT_EQ(sums.values.first.value(), static_cast<double>(hits[k]));
      }
    }
  }
}

TEST(EstimatorsOfTheDriver, AgreeWithTheFormula) {
  for (const auto& [name_a, name_b] : {std::pair{"box:1,1,1", "box:1,1,1"},
                                       {"ellipsoid:4,1,1", "capsule:1,0.25"},
                                       {"box:0.01,1,1", "box:8,1,1"},
                                       {"disc:1", "needle:2"}}) {
    const Body a = parse_shape(name_a), b = parse_shape(name_b);
    const double truth = average_excluded_volume(a.measures, b.measures);
    for (const Way way : kWays) {
      const MonteCarloSettings settings = settings_of(way, a.body, b.body, 200000);
      const VolumeEstimate found = volume_estimate(run_monte_carlo(a.body, b.body, settings).tally, settings.domain);
      EXPECT_LE(std::fabs(found.excluded_volume - truth), 5.0 * found.std_error)
          << name_a << " " << name_b << ", way " << static_cast<int>(way);
      EXPECT_LE(found.std_error, 0.05 * truth);
    }
  }
}

TEST(EstimatorsOfTheDriver, StrataAndSobolPointsBeatPlainHits) {
  const ConvexBody cube = parse_shape("box:1,1,1").body;
  const auto error_of = [&](const MonteCarloSettings& settings) {
    return volume_estimate(run_monte_carlo(cube, cube, settings).tally, settings.domain).relative_error();
  };
  MonteCarloSettings plain = settings_of(Way::stratified, cube, cube, 1u << 17);
  plain.stratified = false;
  const double hits = error_of(plain);
  EXPECT_LT(error_of(settings_of(Way::stratified, cube, cube, 1u << 17)), 0.6 * hits);
  EXPECT_LT(error_of(settings_of(Way::sobol_between_balls, cube, cube, 1u << 17)), 0.6 * hits);
  const double radial = error_of(settings_of(Way::radial, cube, cube, 1u << 17));
  EXPECT_LT(radial, 0.4 * hits);
  EXPECT_LT(error_of(settings_of(Way::radial_sobol, cube, cube, 1u << 17)), 0.6 * radial);
}

TEST(AveragingRun, OfASmoothFunctionFallsFasterThanTheSquareRoot) {
  const Function::Value smooth = [](std::span<const double> u) { return std::exp(u[0]) * (1.0 + u[1] * u[2]); };
  const double truth = (std::exp(1.0) - 1.0) * 1.25;
  const auto run = [&](Sequence sequence, std::uint64_t n) {
    const MonteCarloSettings settings = averaging(3, smooth, sequence, n);
    const VolumeEstimate found = volume_estimate(run_monte_carlo(kNobody, kNobody, settings).tally, {});
    EXPECT_LE(std::fabs(found.excluded_volume - truth), 5.0 * found.std_error);
    return found.std_error;
  };
  EXPECT_NEAR(run(Sequence::random, 1u << 16) / run(Sequence::random, 1u << 10), 1.0 / 8.0, 0.03);
  EXPECT_LT(run(Sequence::sobol, 1u << 16) / run(Sequence::sobol, 1u << 10), 1.0 / 100.0);
}

TEST(AveragingRun, StopsAtTheRelativeErrorAtTheSameValueForAnyNumberOfThreads) {
  const Function::Value value = [](std::span<const double> u) { return std::fabs(u[0] - u[1]); };
  for (const Sequence sequence : {Sequence::random, Sequence::sobol}) {
    MonteCarloSettings settings = averaging(2, value, sequence, 1);
    settings.stop = {};
    settings.stop.relative_error = 1e-3;
    const RunRecord one = run_monte_carlo(kNobody, kNobody, settings);
    EXPECT_EQ(one.stopped_by, StopReason::relative_error);
    EXPECT_LE(volume_estimate(one.tally, {}).relative_error(), 1e-3);
    settings.n_threads = 3;
    EXPECT_EQ(run_monte_carlo(kNobody, kNobody, settings).tally, one.tally);
  }
}

TEST(AveragingRun, GivesUpWhereRoundingOrUndecidedValuesKeepTheError) {
  MonteCarloSettings settings = averaging(
      1, [](std::span<const double> u) { return u[0]; }, Sequence::sobol, 1);
  settings.stop = {};
  settings.stop.relative_error = 1e-11;  // rounding is 1e-10
  EXPECT_EQ(run_monte_carlo(kNobody, kNobody, settings).stopped_by, StopReason::rounding);
  settings.integrand = [] {
    return std::make_unique<Function>(1, [](std::span<const double> u) { return u[0] < 0.1 ? std::nan("") : 1.0; });
  };
  settings.stop.relative_error = 1e-3;
  const RunRecord record = run_monte_carlo(kNobody, kNobody, settings);
  EXPECT_EQ(record.stopped_by, StopReason::undecided);
  const VolumeEstimate found = volume_estimate(record.tally, {});
  EXPECT_NEAR(found.excluded_volume, 0.95, 0.01);
  EXPECT_GE(found.ci95.upper, 1.0) << "what is undecided may be all";
  EXPECT_LE(found.ci95.lower, 0.9) << "or nothing";
}

TEST(AveragingRun, TakesValuesOfEitherSign) {
  const MonteCarloSettings settings = averaging(
      1, [](std::span<const double> u) { return u[0] < 0.75 ? -1.0 : 5.0; }, Sequence::random, 100000);
  const VolumeEstimate found = volume_estimate(run_monte_carlo(kNobody, kNobody, settings).tally, {});
  EXPECT_NEAR(found.excluded_volume, 0.5, 5.0 * found.std_error);
}

TEST(AveragingRun, RefusesValuesThatAreLostToRounding) {
  for (const double value : {1e30, std::numeric_limits<double>::infinity()}) {
    const MonteCarloSettings settings = averaging(
        1, [value](std::span<const double>) { return value; }, Sequence::random, 100);
    EXPECT_THROW(run_monte_carlo(kNobody, kNobody, settings), UsageError);
  }
}

TEST(AveragingRun, EndsWhenInterrupted) {
  std::atomic<int> interrupt = 0;
  MonteCarloSettings settings = averaging(
      1, [](std::span<const double> u) { return u[0]; }, Sequence::sobol, 1);
  settings.stop.trials = 100'000'000'000;
  settings.interrupt = &interrupt;
  settings.on_progress = [&](const Progress& progress) {
    if (progress.tally.n_trials > 0) interrupt = 2;
  };
  const RunRecord record = run_monte_carlo(kNobody, kNobody, settings);
  EXPECT_EQ(record.stopped_by, StopReason::interrupted);
  EXPECT_GT(record.tally.n_trials, 0u);
  const MonteCarloSettings again = averaging(
      1, [](std::span<const double> u) { return u[0]; }, Sequence::sobol, record.tally.n_trials);
  EXPECT_EQ(run_monte_carlo(kNobody, kNobody, again).tally, record.tally) << "the first ones, all of them";
}

}  // namespace
}  // namespace vex
