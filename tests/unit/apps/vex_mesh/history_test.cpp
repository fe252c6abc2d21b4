#include "apps/vex_mesh/history.h"

#include <gtest/gtest.h>

#include "shapes/any_shape.h"

namespace vex {
namespace {

Progress progress_after(std::uint64_t n_trials) {
  Progress progress;
  progress.tally.n_trials = n_trials;
  return progress;
}

TEST(History, KeepsAHundredMomentsOfALongRun) {
  History history;
  for (std::uint64_t k = 0; k <= 100'000; ++k) history.add(progress_after(1000 * k));
  const std::vector<Tally>& kept = history.tallies();
  EXPECT_GE(kept.size(), 40u);
  EXPECT_LE(kept.size(), 128u);
  std::uint64_t previous = 0, widest = 0;
  for (const Tally& tally : kept) {
    EXPECT_GT(tally.n_trials, previous);
    widest = std::max(widest, tally.n_trials - previous);
    previous = tally.n_trials;
  }
  EXPECT_LT(widest, 10'000'000u);  // a tenth of the run
  EXPECT_GT(previous, 85'000'000u);
}

TEST(History, OfAShortRunIsItsOwnTrialsAgain) {
  const Body box = parse_shape("box:1,2,3");
  for (const char* const estimator : {"hit-or-miss", "radial", "stratified"}) {
    ExcludedVolumeSettings settings;
    settings.estimator = estimator;
    settings.trials = 4096;
    settings.threads = 2;
    const ExcludedVolume result = excluded_volume(box, box, settings);
    const std::vector<HistoryPoint> way = history_of(result, {}, box, box, settings);
    ASSERT_EQ(way.size(), 7u) << estimator;
    EXPECT_EQ(way.front().n_trials, 64u);
    EXPECT_EQ(way.back().n_trials, 4096u);
    EXPECT_EQ(way.back().value, result.value);
    for (const HistoryPoint& point : way) {
      ExcludedVolumeSettings part = settings;
      part.trials = point.n_trials;
      EXPECT_EQ(excluded_volume(box, box, part).value, point.value) << estimator << " " << point.n_trials;
      EXPECT_NEAR(point.value, 78.0, 6.0 * point.std_error) << estimator << " " << point.n_trials;
    }
  }
}

TEST(History, OfNoRunIsEmpty) {
  const Body needle = parse_shape("needle:1");
  const ExcludedVolume none = excluded_volume(needle, needle);
  EXPECT_TRUE(history_of(none, {}, needle, needle, {}).empty());
}

}  // namespace
}  // namespace vex
