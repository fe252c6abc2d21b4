// Distance and depth of every kind of pair: each answer judged in twice the precision, and the laws that need no judge.
// vex_query_truth is the same with many more poses.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/numeric/pose_algebra.h"
#include "engine/query/separation.h"
#include "tests/referees/separation_kinds.h"
#include "tests/referees/separation_tally.h"

namespace vex {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class SeparationLaws : public testing::TestWithParam<SeparationKind> {
 protected:
  /// The k-th of a sequence: every other one anywhere, the others near contact.
  Transformd pose(int k) {
    return k % 2 == 0 ? random_pose(random_, domain_, b_) : near_contact_pose(a_, b_, random_, k / 2);
  }
  void expect_right(const Transformd& pose, const Separation& answer, const SeparationJudgement& judgement) {
    if (!judgement.is_right()) {
      ADD_FAILURE() << judgement.faults.front() << " at " << pose_as_source(pose) << ": " << answer.signed_distance;
    }
  }
  bool is_curved() const { return !a_.exact_form()->is_rounded_polytope() || !b_.exact_form()->is_rounded_polytope(); }
  double size() const { return a_.circumradius() + b_.circumradius(); }

  const ConvexBody a_ = separation_body(GetParam().a), b_ = separation_body(GetParam().b);
  const SeparationJudge judge_{a_, b_};
  const Domain domain_ = ball_domain(a_, b_);
  std::mt19937_64 random_{41};
};

/// Both are of one truth, so their bounds have something in common, but for what poses are rounded by.
void expect_agree(const Separation& one, const Separation& other, double rounding) {
  EXPECT_LE(one.lower, other.upper + rounding);
  EXPECT_LE(other.lower, one.upper + rounding);
}

TEST_P(SeparationLaws, AnswersAreRight) {
  SeparationTally tally;
  for (int k = 0; k < 300; ++k) {
    const Transformd at = pose(k);
    const Separation answer = signed_distance(a_, b_, at);
    tally.add(at, answer, judge_.judge(at, answer));
  }
  for (const auto& [text, fault] : tally.faults) ADD_FAILURE() << fault.n << " times, first: " << fault.first;
  EXPECT_EQ(tally.n_unknown, 0u) << "the judge must know";
  EXPECT_GE(tally.n_apart, tally.n / 5);
  const bool are_needles = GetParam().a == "needle:2" && GetParam().b == "needle:2";  // which hardly ever meet
  if (!are_needles) {
    EXPECT_LE(tally.n_apart, 4 * tally.n / 5);
  }
}

TEST_P(SeparationLaws, AnswersAreRightWhereAxesAreParallel) {
  SeparationTally tally;
  for (int k = 0; k < 40; ++k) {
    const Transformd at = aligned_pose(a_, b_, random_, k);
    const Separation answer = signed_distance(a_, b_, at);
    tally.add(at, answer, judge_.judge(at, answer));
  }
  for (const auto& [text, fault] : tally.faults) ADD_FAILURE() << fault.n << " times, first: " << fault.first;
  EXPECT_GT(tally.n_apart, 0u);
  EXPECT_LT(tally.n_apart, tally.n);
  if (!is_curved()) {
    EXPECT_EQ(tally.n_unknown, 0u) << "of polytopes the least of many equal ways out is known";
  }
}

TEST_P(SeparationLaws, IsMutual) {
  for (int k = 0; k < 40; ++k) {
    const Transformd at = pose(k);
    const Separation one = signed_distance(a_, b_, at);
    const Separation other = signed_distance(b_, a_, inverse(at));
    // A turn moves no point of a body by more than some roundings of its coordinates.
    const double rounding = 32.0 * 0x1p-53 * (a_.reach() + b_.reach() + norm_1(at.translation));
    expect_agree(one, other, rounding);
    // The other answer, turned round, is one of this pair.
    Separation turned = other;
    Transformd turn = at;
    turn.translation = {};
    turned.normal = -turn(other.normal);
    turned.normal = (1.0 / norm(turned.normal)) * turned.normal;
    turned.point_a = at(other.point_b);
    turned.point_b = at(other.point_a);
    turned.lower -= rounding;
    turned.upper += rounding;
    turned.verdict = one.verdict;  // of poses that differ by rounding
    turned.signed_distance = one.verdict.outcome == Outcome::overlap ? std::min(other.signed_distance, 0.0)
                                                                     : std::max(other.signed_distance, 0.0);
    expect_right(at, turned, judge_.judge(at, turned));
  }
}

TEST_P(SeparationLaws, ScalesByPowersOfTwo) {
  for (const int power : {-100, 40, 120}) {
    const double scale = std::ldexp(1.0, power);
    const ConvexBody a = separation_body(GetParam().a, scale), b = separation_body(GetParam().b, scale);
    for (int k = 0; k < 20; ++k) {
      Transformd at = pose(k);
      const Separation one = signed_distance(a_, b_, at);
      at.translation = scale * at.translation;
      Separation other = signed_distance(a, b, at);
      EXPECT_EQ(one.verdict.outcome, other.verdict.outcome);
      other.lower /= scale;
      other.upper /= scale;
      expect_agree(one, other, 0.0);
      EXPECT_LE(other.upper - other.lower, judge_.accuracy() * (size() + std::fabs(one.signed_distance)));
    }
  }
}

TEST_P(SeparationLaws, IsContinuousThroughContact) {
  for (int k = 0; k < 3; ++k) {
    const ContactLine line = random_contact_line(a_, b_, random_);
    const double step = std::ldexp(size(), -6 - 12 * k);
    Separation last;
    for (int n = -10; n <= 10; ++n) {
      const Separation answer = signed_distance(a_, b_, line.at(a_, b_, line.contact + n * step));
      if (n > -10) {
        const double widths = (answer.upper - answer.lower) + (last.upper - last.lower);
        const double rounding = 32.0 * 0x1p-53 * (a_.reach() + b_.reach() + norm_1(line.unit_dir) * line.contact);
        EXPECT_LE(std::fabs(answer.signed_distance - last.signed_distance), step + widths + rounding);
      }
      last = answer;
    }
  }
}

TEST_P(SeparationLaws, AWarmStartChangesNoAnswer) {
  WarmStart warm_start;
  for (int k = 0; k < 4; ++k) {
    const ContactLine line = random_contact_line(a_, b_, random_);  // and from a start that is far off, too
    for (int n = -10; n <= 10; ++n) {
      const Transformd at = line.at(a_, b_, line.contact + n * 0.01 * size());
      const Separation cold = signed_distance(a_, b_, at), warm = signed_distance(a_, b_, at, {}, &warm_start);
      EXPECT_EQ(cold.verdict.outcome, warm.verdict.outcome);
      expect_agree(cold, warm, 0.0);
      expect_right(at, warm, judge_.judge(at, warm));
    }
  }
}

TEST_P(SeparationLaws, DistanceAndDepthAreItsTwoSides) {
  for (int k = 0; k < 60; ++k) {
    const Transformd at = pose(k);
    const Separation both = signed_distance(a_, b_, at);
    const Separation apart = distance(a_, b_, at), depth = penetration_depth(a_, b_, at);
    EXPECT_EQ(apart.verdict.outcome, both.verdict.outcome);
    EXPECT_EQ(depth.verdict.outcome, both.verdict.outcome);
    const auto expect_nothing = [](const Separation& one, double lower, double upper) {
      EXPECT_FALSE(one.has_witnesses);
      EXPECT_EQ(one.signed_distance, 0.0);
      EXPECT_EQ(one.lower, lower);
      EXPECT_EQ(one.upper, upper);
      EXPECT_EQ(norm_1(one.normal) + norm_1(one.point_a) + norm_1(one.point_b), 0.0);
    };
    if (both.verdict.outcome == Outcome::disjoint) {
      expect_right(at, apart, judge_.judge(at, apart));
      expect_nothing(depth, 0.0, kInfinity);
    } else if (both.verdict.outcome == Outcome::overlap) {
      expect_right(at, depth, judge_.judge(at, depth));
      expect_nothing(apart, -kInfinity, 0.0);
    }
  }
}

TEST_P(SeparationLaws, LessThatIsAskedIsToldByTheBounds) {
  SeparationSettings settings;
  settings.relative_gap = 1e-3;
  // Of a depth of few digits it is asked what the normal alone shows.
  constexpr int kCallsToMeasure = 2;
  double n_calls = 0.0, n_calls_in_full = 0.0;
  for (int k = 0; k < 100; ++k) {
    const Transformd at = pose(k);
    const Separation answer = signed_distance(a_, b_, at, settings);
    expect_right(at, answer, judge_.judge(at, answer, settings.relative_gap));
    if (k % 2 != 0) continue;  // near contact a coarse search may leave the sign to be asked for once more
    n_calls += answer.n_support_calls - (answer.signed_distance < 0.0 ? kCallsToMeasure : 0);
    n_calls_in_full += signed_distance(a_, b_, at).n_support_calls;
  }
  if (is_curved()) {
    EXPECT_LE(n_calls, n_calls_in_full);
  }
}

std::string test_name_of(const testing::TestParamInfo<SeparationKind>& kind) {
  std::string name = test_name({kind.param.a, kind.param.b});
  for (char& c : name) c = c == '-' ? 'm' : c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Kinds, SeparationLaws, testing::ValuesIn(separation_kinds()), test_name_of);

}  // namespace
}  // namespace vex
