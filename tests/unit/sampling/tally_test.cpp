#include "engine/sampling/tally.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace vex {
namespace {

Tally of_values(double offset, const std::vector<double>& values) {
  Tally tally;
  tally.by_class.kind = ClassTally::Kind::one;
  tally.by_class.offset = offset;
  tally.by_class.unit = 2.0;
  tally.by_class.classes.resize(1);
  ClassSums& sums = tally.by_class.classes[0];
  sums.n = tally.n_trials = values.size();
  for (const double value : values) sums.values.add((value - offset) / 2.0);
  return tally;
}

TEST(Tally, AddsWhatIsCountedInTheSameWay) {
  Tally sum;
  sum += of_values(1.0, {3.0, 4.0});
  sum += of_values(1.0, {5.0});
  EXPECT_EQ(sum, of_values(1.0, {5.0, 3.0, 4.0}));
  sum += Tally{};
  EXPECT_EQ(sum, of_values(1.0, {5.0, 3.0, 4.0}));
}

// The sum of values less two different offsets is of nothing, and their variance tells nothing of it: that was so, and
// z was -1110.
TEST(Tally, RefusesToAddUnlikeOnes) {
  const std::vector<std::pair<const char*, std::function<void(Tally&)>>> changes = {
      {"offset", [](Tally& t) { t.by_class.offset = 1.0 + 0x1p-50; }},
      {"unit", [](Tally& t) { t.by_class.unit = 3.0; }},
      {"kind", [](Tally& t) { t.by_class.kind = ClassTally::Kind::strata; }},
      {"no values", [](Tally& t) { t.by_class = {}; }},
      {"hits", [](Tally& t) { t.by_class.are_hits = true; }},
      {"rounding", [](Tally& t) { t.by_class.relative_rounding = 1e-9; }},
      {"classes", [](Tally& t) { t.by_class.classes.resize(2); }}};
  for (const auto& [what, change] : changes) {
    Tally sum = of_values(1.0, {3.0, 4.0}), other = of_values(1.0, {5.0});
    change(other);
    EXPECT_THROW(sum += other, std::logic_error) << what;
    EXPECT_EQ(sum, of_values(1.0, {3.0, 4.0})) << what << ": a refused one changes nothing";
    EXPECT_THROW(other += sum, std::logic_error) << what;
  }
}

}  // namespace
}  // namespace vex
