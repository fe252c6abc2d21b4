// What vex_stress counts: a backend that is wrong is found out, and which way.
#include "apps/vex_stress/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "apps/referees/test_backend.h"
#include "apps/referees/wrong_tests.h"
#include "engine/numeric/errors.h"
#include "engine/query/overlap.h"

namespace vex {
namespace {

Stratum stratum_named(const std::string& name) {
  for (Stratum& stratum : all_strata()) {
    if (stratum.name == name) return stratum;
  }
  throw UsageError("no such stratum (" + name + ")");
}

BackendKind always(const std::string& name, const Verdict& verdict) {
  return {name, false, [verdict](const ConvexBody&, const ConvexBody&) {
            return test_backend([verdict](const Transformd&) { return verdict; });
          }};
}

StressSettings settings_of(std::vector<BackendKind> backends, std::uint64_t n_pairs) {
  StressSettings settings;
  settings.n_pairs = n_pairs;
  settings.backends = std::move(backends);
  return settings;
}

TEST(StressMeasure, ABackendThatAlwaysSaysTheSameIsWrongOneWay) {
  const StressRow row =
      measure(stratum_named("contact/curved/d=1e-6"),
              settings_of({always("all disjoint", Verdict::disjoint(DecidedBy::gjk)),
                           always("all overlap", Verdict::overlap(DecidedBy::gjk)),
                           always("all open", Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding)),
                           always("all given up", Verdict::undecided(DecidedBy::gjk, UndecidedReason::iteration_cap))},
                          320));
  ASSERT_EQ(row.n_pairs, 320u);
  EXPECT_EQ(row.n_unjudged, 0u);
  EXPECT_GT(row.n_overlaps, 100u);
  EXPECT_LT(row.n_overlaps, 220u);
  EXPECT_TRUE(row.complete);
  EXPECT_EQ(row.counts[0].n_missed, row.n_overlaps);
  EXPECT_EQ(row.counts[0].n_invented, 0u);
  ASSERT_TRUE(row.counts[0].first_wrong.has_value());
  EXPECT_EQ(row.counts[1].n_missed, 0u);
  EXPECT_EQ(row.counts[1].n_invented, row.n_pairs - row.n_overlaps);
  EXPECT_EQ(row.counts[2].n_wrong(), 0u);
  EXPECT_EQ(row.counts[2].n_undecided, 320u);
  EXPECT_EQ(row.counts[2].n_beyond_band, 320u);  // at 1e-6 nothing may be open
  EXPECT_EQ(row.counts[2].n_escalated, 320u);
  EXPECT_EQ(row.counts[2].n_capped, 0u);
  EXPECT_NEAR(row.counts[2].widest_undecided, 1e-6, 1e-9);
  EXPECT_EQ(row.counts[3].n_capped, 320u);
}

TEST(StressMeasure, OnlyCurvedBodiesHaveABandToBeUndecidedIn) {
  const auto beyond = [](const std::string& stratum) {
    const auto open = always("open", Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding));
    return measure(stratum_named(stratum), settings_of({open}, 100)).counts[0].n_beyond_band;
  };
  EXPECT_EQ(beyond("contact/curved/d=1e-15"), 0u);
  EXPECT_EQ(beyond("contact/curved/d=1e-13"), 100u);
  EXPECT_EQ(beyond("contact/rounded/d=1e-15"), 100u);
  EXPECT_EQ(beyond("contact/polytopes/d=1e-15"), 100u);
  EXPECT_EQ(beyond("aspect/cones/1e9"), 0u);  // the band there is measured, not prescribed
}

TEST(StressMeasure, WrongTestsOfBoxesAreFoundOut) {
  for (const BackendKind& kind : wrong_box_backends()) {
    Stratum boxes = stratum_named("random/cubes");
    const StressRow row = measure(boxes, settings_of({kind}, 3000));
    EXPECT_GT(row.counts[0].n_wrong(), 20u) << kind.name;
    EXPECT_EQ(row.counts[0].n_invented > 0, kind.name == "face-normals-only") << kind.name;
  }
}

TEST(StressMeasure, TheEngineTurnedRoundIsAlwaysWrong) {
  const BackendKind flipped{"flipped", false, [](const ConvexBody& a, const ConvexBody& b) {
                              return test_backend([a, b](const Transformd& pose) {
                                const Outcome outcome = overlap(a, b, pose).outcome;
                                if (outcome == Outcome::undecided) return outcome;
                                return outcome == Outcome::overlap ? Outcome::disjoint : Outcome::overlap;
                              });
                            }};
  for (const char* const name : {"contact/curved/d=1e-9", "contact/rounded/d=1e-9", "feature/edge-edge"}) {
    const StressRow row = measure(stratum_named(name), settings_of({flipped, gjk_backend()}, 200));
    EXPECT_EQ(row.counts[0].n_wrong() + row.counts[0].n_undecided + row.n_unjudged, 200u) << name;
    EXPECT_GT(row.counts[0].n_wrong(), 100u) << name;
    EXPECT_EQ(row.counts[1].n_wrong(), 0u) << name;
  }
}

TEST(StressMeasure, TheSameCountsForAnyNumberOfThreads) {
  for (const char* const name : {"parallel/d=1e-15", "aspect/ellipsoids/1e6", "cases/known-failures"}) {
    StressSettings settings = settings_of({gjk_backend()}, 200);
    const StressRow one = measure(stratum_named(name), settings);
    settings.n_threads = 3;
    const StressRow three = measure(stratum_named(name), settings);
    EXPECT_EQ(one.n_overlaps, three.n_overlaps);
    EXPECT_EQ(one.counts[0].n_undecided, three.counts[0].n_undecided);
    EXPECT_EQ(one.counts[0].widest_undecided, three.counts[0].widest_undecided);
    ASSERT_EQ(one.counts[0].first_beyond_band.has_value(), three.counts[0].first_beyond_band.has_value());
    if (one.counts[0].first_beyond_band) {
      EXPECT_EQ(one.counts[0].first_beyond_band->index, three.counts[0].first_beyond_band->index);
    }
  }
}

TEST(StressMeasure, AnInterruptLeavesAPartialRow) {
  std::atomic<int> interrupt = 0;
  StressSettings settings = settings_of({gjk_backend()}, 100'000);
  settings.interrupt = &interrupt;
  settings.on_progress = [&interrupt](std::uint64_t n_done) { interrupt = n_done >= 32 ? 2 : 0; };
  const StressRow row = measure(stratum_named("random/cubes"), settings);
  EXPECT_FALSE(row.complete);
  EXPECT_GE(row.n_pairs, 32u);
  EXPECT_LT(row.n_pairs, 1000u);
}

TEST(StressStrata, HaveNamesOfTheirOwnAndBothAnswers) {
  std::set<std::string> names;
  for (const Stratum& stratum : all_strata()) EXPECT_TRUE(names.insert(stratum.name).second) << stratum.name;
  EXPECT_GE(names.size(), 100u);
  for (const Stratum& stratum : all_strata()) {
    if (stratum.name == "hull/1e5-vertices") continue;  // seconds
    const StressRow row = measure(stratum, settings_of({}, 60));
    EXPECT_GT(row.n_overlaps, 2u) << stratum.name;
    EXPECT_GT(row.n_pairs - row.n_overlaps, 2u) << stratum.name;
    EXPECT_LE(row.n_unjudged, 2u) << stratum.name;
  }
}

TEST(Draw, IsAFunctionOfSeedStratumAndIndex) {
  Draw first(1, "a", 7), same(1, "a", 7), other_seed(2, "a", 7), other_stratum(1, "b", 7), other_index(1, "a", 8);
  std::set<double> seen;
  for (int k = 0; k < 200; ++k) {  // more than are drawn at once
    const double x = first();
    EXPECT_EQ(x, same());
    EXPECT_NE(x, other_seed());
    EXPECT_NE(x, other_stratum());
    EXPECT_NE(x, other_index());
    EXPECT_TRUE(x > 0.0 && x < 1.0);
    seen.insert(x);
  }
  EXPECT_EQ(seen.size(), 200u);
}

TEST(Features, OfACubeAndAnIcosahedron) {
  const StressPair pair = named_pair("box:1,2,3 icosahedron:1");
  EXPECT_EQ(pair.features_a.faces.size(), 6u);
  EXPECT_EQ(pair.features_a.edges.size(), 12u);
  EXPECT_EQ(pair.features_b.faces.size(), 20u);
  EXPECT_EQ(pair.features_b.edges.size(), 30u);
  const StressPair curved = named_pair("plate:1,1 sphere:1");
  EXPECT_TRUE(curved.features_a.faces.empty());
  EXPECT_TRUE(curved.features_b.faces.empty());
}

}  // namespace
}  // namespace vex
