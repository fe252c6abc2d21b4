// The rows of vex_paper: the paper's numbers, each row's own random numbers, and who is blamed where tests differ.
#include "apps/vex_paper/rows.h"

#include <gtest/gtest.h>

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <set>

#include "apps/referees/specialised_backend.h"
#include "apps/vex_paper/report.h"
#include "engine/query/overlap.h"

namespace vex {
namespace {

struct Transcribed {
  double aspect_ratio, monte_carlo, uncertainty, calculated;
};

// Taken from the paper a second time, by another hand than apps/vex_paper/paper.h.
constexpr Transcribed kTableOne[] = {
    {1e-06, 1751600.0, 467.911, 2000002.0},
    {0.01, 182.76, 0.048, 207.02},
    {0.5, 11.488, 0.002, 12.0},
    {0.6, 11.058, 0.002, 11.533},
    {0.7, 10.804, 0.001, 11.257},
    {0.8, 10.659, 0.001, 11.1},
    {0.9, 10.591, 0.001, 11.022},
    {1.0, 10.569, 0.001, 11.0},
    {2.0, 11.543, 0.003, 12.0},
    {4.0, 15.023, 0.003, 15.5},
    {8.0, 22.774, 0.007, 23.25},
    {16.0, 38.654, 0.016, 39.125},
    {32.0, 70.624, 0.046, 39.125},
    {64.0, 134.599, 0.175, 135.03125},
};
constexpr Transcribed kTableTwo[] = {
    {0.03125, 77.739, 0.006, 77.741}, {0.0625, 40.281, 0.003, 40.281}, {0.125, 21.811, 0.002, 21.81},
    {0.25, 12.956, 0.001, 12.956},    {0.5, 9.077, 0.007, 9.077},      {1.0, 8.001, 0.002, 8.0},
    {2.0, 9.077, 0.001, 9.077},       {4.0, 12.957, 0.002, 12.956},    {8.0, 21.813, 0.005, 21.81},
    {16.0, 40.28, 0.014, 40.281},     {32.0, 77.7, 0.04, 77.741},
};

Sampling sampling_of(std::uint64_t n_trials) {
  Sampling sampling;
  sampling.n_trials = n_trials;
  sampling.n_threads = 2;
  return sampling;
}

template <std::size_t N>
void expect_as_transcribed(const std::vector<Case>& cases, const Transcribed (&rows)[N]) {
  ASSERT_EQ(cases.size(), N);
  for (std::size_t k = 0; k < N; ++k) {
    EXPECT_EQ(cases[k].aspect_ratio, rows[k].aspect_ratio);
    ASSERT_TRUE(cases[k].printed.has_value());
    EXPECT_EQ(cases[k].printed->excluded_volume, rows[k].monte_carlo) << rows[k].aspect_ratio;
    EXPECT_EQ(cases[k].printed->uncertainty, rows[k].uncertainty) << rows[k].aspect_ratio;
    EXPECT_EQ(cases[k].printed->calculated, rows[k].calculated) << rows[k].aspect_ratio;
  }
}

TEST(PaperRows, HaveTheNumbersThatThePaperPrints) {
  expect_as_transcribed(table_one(), kTableOne);
  expect_as_transcribed(erratum_cases(), kTableOne);
  expect_as_transcribed(table_two(), kTableTwo);
  const std::vector<Case> text = cases_of_the_text();
  const std::pair<double, double> expected[] = {{2.8797, 0.0006}, {9.347, 0.001}, {8.0, 0.002}, {11.0, 0.002}};
  for (std::size_t k = 0; k < std::size(expected); ++k) {
    ASSERT_TRUE(text[k].printed.has_value());
    EXPECT_EQ(text[k].printed->excluded_volume, expected[k].first) << text[k].label;
    EXPECT_EQ(text[k].printed->uncertainty, expected[k].second) << text[k].label;
  }
  for (std::size_t k = std::size(expected); k < text.size(); ++k) EXPECT_FALSE(text[k].printed) << text[k].label;
}

TEST(PaperRows, DrawFromSeedsOfTheirOwn) {
  std::set<std::uint64_t> seeds;
  std::size_t n = 0;
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{2}, Sampling::kLargestSeed}) {
    Sampling sampling = sampling_of(1);
    sampling.seed = seed;
    for (const auto& cases : {table_one(), table_two(), cases_of_the_text(), erratum_cases(), erratum_orientations(),
                              referee_cases(), curve_cases()}) {
      for (const Case& what : cases) {
        seeds.insert(sampling.seed_of(what));
        ++n;
      }
    }
  }
  EXPECT_EQ(seeds.size(), n) << "two rows, or two runs, share their random numbers";
}

TEST(PaperRows, ZIsTheDifferenceInStandardErrorsOfBoth) {
  Row row;
  row.exact = 11.0;
  row.exact_error = 0.3;
  row.found.excluded_volume = 12.5;
  row.found.std_error = 0.4;
  EXPECT_DOUBLE_EQ(row.z(), 3.0);
  ErratumRow wrong;
  wrong.what.printed = paper::Printed{10.0, 0.03};
  wrong.values.push_back({"one-sided", 9.9, 0.04, 1.1});
  EXPECT_NEAR(wrong.z(), -2.0, 1e-12);
  wrong.exact = 11.0;
  wrong.found = row.found;
  EXPECT_DOUBLE_EQ(wrong.z_of_exact_test(), 3.75);
}

TEST(PaperRows, TrialsForAThousandthScaleWithTheSquareOfTheError) {
  Row row;
  row.found.excluded_volume = 2.0;
  row.found.std_error = 0.02;
  row.record.tally.n_trials = 1000;
  EXPECT_NEAR(row.trials_for_a_thousandth(), 1e5, 1e-6);
}

TEST(PaperRows, ChiSquaredIsThatOfTheRows) {
  std::vector<ErratumRow> rows;
  double sum = 0.0;
  for (const double z : {0.5, -1.0, 2.0, 1.5}) {
    ErratumRow row;
    row.what.printed = paper::Printed{10.0, 0.0};
    row.values.push_back({"one-sided", 10.0 + z, 1.0, 0.0});
    rows.push_back(row);
    sum += z * z;
  }
  EXPECT_NEAR(chi_squared(rows).value, sum, 1e-12);
  EXPECT_NEAR(chi_squared(rows).p, boost::math::gamma_q(2.0, 0.5 * sum), 1e-12);
}

// Answers as the specialised test does, but to one pose of 64 the contrary.
class Contrary final : public OverlapBackend {
 public:
  Contrary(const ConvexBody& a, const ConvexBody& b) : right_(specialised_backend().make(a, b)) {}
  void decide(std::span<const Pose> poses, std::span<Verdict> verdicts) override {
    right_->decide(poses, verdicts);
    for (std::size_t k = 0; k < poses.size(); ++k) {
      if ((bits_of(poses[k].a_from_b().translation.x) >> 8 & 63u) != 0 || verdicts[k].outcome == Outcome::undecided) continue;
      verdicts[k].outcome = verdicts[k].outcome == Outcome::overlap ? Outcome::disjoint : Outcome::overlap;
    }
  }

 private:
  std::unique_ptr<OverlapBackend> right_;
};

BackendKind contrary() {
  return {"contrary", true, [](const ConvexBody& a, const ConvexBody& b) { return std::make_unique<Contrary>(a, b); },
          [](const ConvexBody& a, const ConvexBody& b) { return specialised_backend().takes(a, b); }};
}

TEST(PaperReferees, BlameTheTestThatIsWrong) {
  for (const Case& what : referee_cases()) {
    const std::vector<RefereeRow> rows = measure_referees(what, sampling_of(3000), {contrary()});
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_GT(rows[0].n_disagreements, 3u) << what.label;
    EXPECT_EQ(rows[0].n_engine_right, rows[0].n_disagreements) << what.label;
    EXPECT_EQ(rows[0].n_test_right, 0u) << what.label;
    EXPECT_EQ(rows[0].n_not_judged(), 0u) << what.label;
  }
}

TEST(PaperReferees, BlameTheEngineWhereItIsWrong) {
  const std::vector<Case> cases = referee_cases();
  for (const char* const label : {"box:1,1,1", "sphere:1", "ellipsoid:4,1,1 and sphere:1"}) {
    const auto what = std::ranges::find_if(cases, [label](const Case& one) { return one.label == label; });
    ASSERT_NE(what, cases.end()) << label;
    const std::vector<RefereeRow> rows =
        measure_referees(*what, sampling_of(3000), {specialised_backend()}, contrary());
    EXPECT_GT(rows[0].n_disagreements, 3u) << label;
    EXPECT_EQ(rows[0].n_test_right, rows[0].n_disagreements) << label;
    EXPECT_EQ(rows[0].n_engine_right, 0u) << label;
    PaperRun run{"vex_paper", {}};
    EXPECT_FALSE(run.has_disagreement());
    run.referees = rows;
    EXPECT_TRUE(run.has_disagreement());
  }
}

TEST(PaperReferees, AskTheEngineAboutEveryPose) {
  // Quick verdicts would answer for it: of two balls, always.
  BackendKind counting = gjk_backend();
  const auto n_asked = std::make_shared<std::atomic<std::uint64_t>>(0);
  class Counting final : public OverlapBackend {
   public:
    Counting(std::unique_ptr<OverlapBackend> backend, std::shared_ptr<std::atomic<std::uint64_t>> n)
        : backend_(std::move(backend)), n_(std::move(n)) {}
    void decide(std::span<const Pose> poses, std::span<Verdict> verdicts) override {
      *n_ += poses.size();
      backend_->decide(poses, verdicts);
    }

   private:
    std::unique_ptr<OverlapBackend> backend_;
    std::shared_ptr<std::atomic<std::uint64_t>> n_;
  };
  counting.make = [n_asked](const ConvexBody& a, const ConvexBody& b) {
    return std::make_unique<Counting>(gjk_backend().make(a, b), n_asked);
  };
  for (const Case& what : referee_cases()) {
    *n_asked = 0;
    measure_referees(what, sampling_of(500), specialised_tests(), counting);
    EXPECT_EQ(n_asked->load(), 500u) << what.label;
  }
}

TEST(PaperRows, AnExactTestThatIsOffIsADisagreement) {
  PaperRun run{"vex_paper", {}};
  ErratumRow row;
  row.exact = 11.0;
  row.found.excluded_volume = 10.0;
  row.found.std_error = 0.1;
  run.erratum.push_back(row);
  EXPECT_TRUE(run.has_disagreement());
  run.erratum.front().found.excluded_volume = 11.05;
  EXPECT_FALSE(run.has_disagreement());
  Row off;
  off.exact = 11.0;
  off.found = {11.7, 0.1, {}};
  run.table_1.push_back(off);
  EXPECT_TRUE(run.has_disagreement()) << "7 standard errors, of 6";
}

}  // namespace
}  // namespace vex
