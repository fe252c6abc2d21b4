// Over many seeds the 95 % interval holds the truth 95 % of the time: every estimator, bodies from needle to plate.
//
// Of n independent intervals n/20 miss, give or take sqrt(n 19)/20. The limits are 4 of these; seeds are fixed.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/common/estimators.h"
#include "shapes/excluded_volume.h"

namespace vex {
namespace {

constexpr int kSeeds = 200;

const char* const kBodies[] = {"box:1,1,1",      "box:64,1,1",    "box:0.01,1,1", "ellipsoid:4,1,1",
                               "capsule:1,0.25", "tetrahedron:1", "cone:1,0.5",   "disc:1"};

struct Way {
  Estimator estimator;
  Sequence sequence;
  std::uint64_t n_trials;
};

// Hits must be many enough for an interval of any width to mean something.
const Way kWays[] = {{Estimator::hit_or_miss, Sequence::random, 20000},
                     {Estimator::hit_or_miss, Sequence::sobol, 1u << 15},
                     {Estimator::hit_or_miss_fitted, Sequence::random, 5000},
                     {Estimator::hit_or_miss_fitted, Sequence::sobol, 1u << 13},
                     {Estimator::stratified, Sequence::random, 20000},
                     {Estimator::stratified, Sequence::sobol, 1u << 15},
                     {Estimator::radial, Sequence::random, 4096},
                     {Estimator::radial, Sequence::sobol, 1u << 12},
                     {Estimator::mixed_volume, Sequence::random, 2048},
                     {Estimator::mixed_volume, Sequence::sobol, 1u << 11},
                     {Estimator::mean_width, Sequence::random, 2048},
                     {Estimator::mean_width, Sequence::sobol, 1u << 11}};

int most_misses(int n) { return static_cast<int>(n / 20.0 + 4.0 * std::sqrt(19.0 * n) / 20.0); }
int least_misses(int n) { return static_cast<int>(std::ceil(n / 20.0 - 4.0 * std::sqrt(19.0 * n) / 20.0)); }

// Of all seeds the intervals, `stretch` times as wide, that miss.
int misses(const Way& way, const char* name, double stretch) {
  const MeasuredBody body = parse_shape(name);
  const double truth = average_excluded_volume(body.measures, body.measures);
  MonteCarloSettings settings;
  settings.sequence = way.sequence;
  settings.stop.trials = way.n_trials;
  set_estimator(settings, way.estimator, body, body);
  int n = 0;
  for (int k = 0; k < kSeeds; ++k) {
    settings.seed = static_cast<std::uint64_t>(k) + 1;
    const VolumeEstimate found =
        volume_estimate(run_monte_carlo(body.body, body.body, settings).tally, settings.domain);
    const double middle = found.excluded_volume;
    if (truth < middle + stretch * (found.ci95.lower - middle)) ++n;
    if (truth > middle + stretch * (found.ci95.upper - middle)) ++n;
  }
  return n;
}

class Coverage : public testing::TestWithParam<Way> {};

TEST_P(Coverage, IsNinetyFivePercent) {
  int n_misses = 0;
  for (const char* const body : kBodies) {
    // Of 300 hits of a needle in the ball Wilson's interval holds the truth a little less or more often.
    const int of_body = misses(GetParam(), body, 1.0);
    EXPECT_LE(of_body, most_misses(kSeeds)) << body;
    n_misses += of_body;
  }
  const int n_all = kSeeds * static_cast<int>(std::size(kBodies));
  EXPECT_LE(n_misses, most_misses(n_all));
  EXPECT_GE(n_misses, least_misses(n_all));
}

INSTANTIATE_TEST_SUITE_P(Estimators, Coverage, testing::ValuesIn(kWays), [](const auto& way) {
  std::string name = std::string(name_of(way.param.estimator)) + "_" + std::string(name_of(way.param.sequence));
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
});

TEST(Coverage, OfIntervalsHalfAsWideIsNot) {
  for (const Way& way :
       {Way{Estimator::radial, Sequence::sobol, 1u << 11}, Way{Estimator::hit_or_miss, Sequence::random, 20000}}) {
    EXPECT_GT(misses(way, "box:1,1,1", 0.5), most_misses(kSeeds));
  }
}

}  // namespace
}  // namespace vex
