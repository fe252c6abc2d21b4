// The judge of distances and depths: right answers in closed form pass, each kind of wrong one is refused, and what it
// takes for the truth is that of exact arithmetic.
#include "tests/referees/separation_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "shapes/any_shape.h"
#include "tests/referees/exact_distance.h"
#include "tests/referees/polytopes.h"
#include "tests/unit/apps/referees/pairs.h"

namespace vex {
namespace {

ConvexBody judged_body(const char* text) { return parse_shape(text).body; }

Transformd moved_by(double x, double y, double z, Transformd turn = {}) {
  turn.translation = {x, y, z};
  return turn;
}

Separation answer_of(double value, const Vec3d& normal, const Vec3d& point_a, double rounding = 0.0) {
  Separation answer;
  answer.verdict = value > 0.0 ? Verdict::disjoint(DecidedBy::gjk) : Verdict::overlap(DecidedBy::gjk);
  answer.signed_distance = value;
  answer.lower = value - rounding;
  answer.upper = value + rounding;
  answer.has_witnesses = true;
  answer.normal = normal;
  answer.point_a = point_a;
  answer.point_b = point_a + value * normal;
  return answer;
}

struct KnownAnswer {
  const char *a, *b;
  Transformd pose;
  Separation answer;
};

// Every one in closed form, with a normal that is the only one.
std::vector<KnownAnswer> known_answers() {
  const double root_half = std::numbers::sqrt2 / 2.0;
  return {
      {"box:1,2,3", "box:1,2,3", moved_by(0, 0, 5), answer_of(2.0, {0, 0, 1}, {0.25, 0.25, 1.5})},
      {"box:1,2,3", "box:1,2,3", moved_by(0.75, 0, 0.1), answer_of(-0.25, {1, 0, 0}, {0.5, 0.25, 0.5})},
      {"box:1,2,3", "box:1,2,3", moved_by(4, 6, 0), answer_of(5.0, {0.6, 0.8, 0}, {0.5, 1.0, 1.0}, 1e-15)},
      {"box:4,4,4", "box:0.5,0.5,0.5", moved_by(1, 0, 0), answer_of(-1.25, {1, 0, 0}, {2, 0.125, 0})},
      {"sphere:0.5", "sphere:0.25", moved_by(3, 4, 0), answer_of(4.25, {0.6, 0.8, 0}, {0.3, 0.4, 0}, 1e-15)},
      {"sphere:0.5", "sphere:0.25", moved_by(0, 0.375, 0), answer_of(-0.375, {0, 1, 0}, {0, 0.5, 0})},
      {"capsule:2,0.25", "capsule:2,0.5", moved_by(3, 0, 4),
       answer_of(std::sqrt(13.0) - 0.75, {3.0 / std::sqrt(13.0), 0, 2.0 / std::sqrt(13.0)},
                 {0.75 / std::sqrt(13.0), 0, 1.0 + 0.5 / std::sqrt(13.0)}, 1e-15)},
      {"needle:2", "plate:1,1", moved_by(0, 0, 1.5), answer_of(0.5, {0, 0, 1}, {0, 0, 1})},
      {"needle:2", "plate:1,1", moved_by(0, 0, 0.75), answer_of(-0.25, {0, 0, 1}, {0, 0, 1})},
      {"rounded:0.25,box:1,1,1", "box:1,1,1", moved_by(0, 1, 0), answer_of(-0.25, {0, 1, 0}, {0.125, 0.75, 0})},
      {"ellipsoid:1,2,3", "ellipsoid:0.5,0.5,1", moved_by(0, 0, 4.5), answer_of(0.5, {0, 0, 1}, {0, 0, 3})},
      {"ellipsoid:1,2,3", "ellipsoid:0.5,0.5,1", moved_by(-1.25, 0, 0), answer_of(-0.25, {-1, 0, 0}, {-1, 0, 0})},
      {"ellipsoid:1,1,1e-6", "ellipsoid:1,1,1e-6", moved_by(0, 0, 3e-6),
       answer_of(1e-6, {0, 0, 1}, {0, 0, 1e-6}, 1e-20)},
      {"cylinder:2,0.5", "box:1,1,1", moved_by(0.875, 0, 0), answer_of(-0.125, {1, 0, 0}, {0.5, 0, 0.25})},
      {"cylinder:2,0.5", "cylinder:2,0.25", moved_by(0, 0, 3), answer_of(1.0, {0, 0, 1}, {0, 0, 1})},
      {"hemisphere:1", "sphere:0.25", moved_by(0, 0, -0.75), answer_of(0.5, {0, 0, -1}, {0, 0, 0})},
      {"box:4,4,1", "cylinder:2,0.5", moved_by(0, 0, 1.5, rotation_about({0, 1, 0}, std::numbers::pi / 4.0)),
       answer_of(1.0 - 1.5 * root_half, {0, 0, 1}, {-0.5 * root_half, 0, 0.5}, 1e-15)},
  };
}

SeparationJudgement judgement_of(const KnownAnswer& known, const Separation& answer) {
  return SeparationJudge(judged_body(known.a), judged_body(known.b)).judge(known.pose, answer);
}

std::string name_of(const KnownAnswer& known) { return std::string(known.a) + " " + known.b; }

TEST(SeparationJudge, TakesRightAnswers) {
  for (const KnownAnswer& known : known_answers()) {
    SCOPED_TRACE(name_of(known));
    const SeparationJudgement found = judgement_of(known, known.answer);
    EXPECT_TRUE(found.is_known);
    EXPECT_TRUE(found.is_right()) << found.faults.front();
    EXPECT_LE(found.error, 1e-15);
    EXPECT_LE(found.upper - found.lower, 1e-17 * found.size);
  }
}

// What the judge must say of the answer once it has been spoilt.
template <class Spoil>
void expect_refused(const Spoil& spoil, const std::string& fault) {
  int n = 0;
  for (const KnownAnswer& known : known_answers()) {
    SCOPED_TRACE(name_of(known));
    Separation answer = known.answer;
    const SeparationJudge judge(judged_body(known.a), judged_body(known.b));
    const double size =
        judged_body(known.a).circumradius() + judged_body(known.b).circumradius() + std::fabs(answer.signed_distance);
    if (!spoil(answer, 2.0 * judge.accuracy() * size)) continue;
    ++n;
    const SeparationJudgement found = judge.judge(known.pose, answer);
    EXPECT_TRUE(std::ranges::any_of(found.faults, [&](const std::string& one) { return one.starts_with(fault); }))
        << fault;
  }
  EXPECT_GT(n, 5);
}

TEST(SeparationJudge, RefusesValuesThatAreOff) {
  for (const double sign : {-1.0, 1.0}) {
    const auto biased = [sign](Separation& answer, double off) {
      answer.signed_distance += sign * off;
      answer.lower = std::min(answer.lower, answer.signed_distance);
      answer.upper = std::max(answer.upper, answer.signed_distance);
      return true;
    };
    expect_refused(biased, "the signed distance is off");
  }
}

TEST(SeparationJudge, RefusesBoundsThatDoNotHold) {
  // By far less than the value may be off.
  const auto scale = [](const Separation& answer) { return 1e-6 * std::fabs(answer.signed_distance); };
  expect_refused(
      [&](Separation& answer, double) {
        const double width = answer.upper - answer.lower;
        answer.lower += width + 1e-9 * scale(answer);
        answer.upper += width + 1e-9 * scale(answer);
        answer.signed_distance = answer.lower;
        return true;
      },
      "the lower bound is above the truth");
  expect_refused(
      [&](Separation& answer, double) {
        const double width = answer.upper - answer.lower;
        answer.lower -= width + 1e-9 * scale(answer);
        answer.upper -= width + 1e-9 * scale(answer);
        answer.signed_distance = answer.upper;
        return true;
      },
      "the upper bound is below the truth");
  expect_refused(
      [](Separation& answer, double off) {
        answer.lower = answer.signed_distance + 0.25 * off;
        return true;
      },
      "the value is not between its bounds");
  expect_refused(
      [](Separation& answer, double off) {
        answer.lower -= off;
        answer.upper += off;
        return true;
      },
      "the bounds are farther");
}

TEST(SeparationJudge, RefusesNormalsThatAreWrong) {
  expect_refused(
      [](Separation& answer, double) {
        answer.normal = -answer.normal;
        return true;
      },
      "along the normal");
  expect_refused(
      [](Separation& answer, double) {
        std::swap(answer.point_a, answer.point_b);
        return true;
      },
      "the points are not where the normal leads");
  expect_refused(
      [](Separation& answer, double) {
        answer.normal = (1.0 + 4e-15) * answer.normal;
        return true;
      },
      "the normal is not of length 1");
  expect_refused(
      [](Separation& answer, double) {
        answer.normal = {};
        return true;
      },
      "there is no answer");
}

TEST(SeparationJudge, RefusesPointsThatAreNotOfTheirBodies) {
  for (const double sign : {-1.0, 1.0}) {
    expect_refused(
        [sign](Separation& answer, double off) {
          answer.point_a = answer.point_a + off * answer.normal;
          answer.point_b = answer.point_b + sign * off * answer.normal;
          return true;
        },
        "point_a is not of A");
    expect_refused(
        [sign](Separation& answer, double off) {
          answer.point_a = answer.point_a - sign * off * answer.normal;
          answer.point_b = answer.point_b - off * answer.normal;
          return true;
        },
        "point_b is not of B");
  }
  expect_refused(
      [](Separation& answer, double off) {
        answer.point_b = answer.point_b + off * answer.normal;
        return true;
      },
      "the points are not where the normal leads");
  const Separation aside = answer_of(0.5, {0, 0, 1}, {0.2, 0, 1});
  EXPECT_FALSE(judgement_of({"needle:2", "plate:1,1", moved_by(0, 0, 1.5), {}}, aside).is_right());
}

TEST(SeparationJudge, RefusesVerdictsThatAreWrong) {
  const auto with = [](Verdict disjoint, Verdict overlap) {
    return [=](Separation& answer, double) {
      answer.verdict = answer.signed_distance > 0.0 ? disjoint : overlap;
      return true;
    };
  };
  const DecidedBy by = DecidedBy::gjk;
  expect_refused(with(Verdict::overlap(by), Verdict::disjoint(by)), "the verdict is wrong");
  expect_refused(with(Verdict::overlap(by), Verdict::disjoint(by)), "verdict and sign differ");
  const Verdict undecided = Verdict::undecided(by, UndecidedReason::rounding);
  expect_refused(with(undecided, undecided), "it is undecided");
}

TEST(SeparationJudge, RefusesADepthThatIsNotTheLeast) {
  // Out by the second shortest way.
  EXPECT_FALSE(judgement_of({"box:4,4,4", "box:0.5,0.5,0.5", moved_by(1, 0.5, 0), {}},
                            answer_of(-1.75, {0, 1, 0}, {1.125, 2, 0}))
                   .is_right());
  EXPECT_FALSE(judgement_of({"ellipsoid:1,2,3", "sphere:0.25", moved_by(0.25, 0, 0), {}},
                            answer_of(-1.5, {-1, 0, 0}, {-1, 0, 0}))
                   .is_right());
  EXPECT_TRUE(
      judgement_of({"ellipsoid:1,2,3", "sphere:0.25", moved_by(0.25, 0, 0), {}}, answer_of(-1.0, {1, 0, 0}, {1, 0, 0}))
          .is_right());
}

TEST(SeparationJudge, RefusesWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const KnownAnswer& known : known_answers()) {
    for (double Separation::*const member : {&Separation::signed_distance, &Separation::lower, &Separation::upper}) {
      Separation answer = known.answer;
      answer.*member = nan;
      EXPECT_FALSE(judgement_of(known, answer).is_right()) << name_of(known);
    }
    for (Vec3d Separation::*const member : {&Separation::normal, &Separation::point_a, &Separation::point_b}) {
      Separation answer = known.answer;
      (answer.*member).y = nan;
      EXPECT_FALSE(judgement_of(known, answer).is_right()) << name_of(known);
    }
    Separation none = known.answer;
    none.has_witnesses = false;
    EXPECT_FALSE(judgement_of(known, none).is_right()) << name_of(known);
  }
}

TEST(SeparationJudge, KnowsTheTruthOfExactArithmetic) {
  const std::vector<std::pair<const char*, const char*>> pairs = {
      {"box:1,2,3", "box:1,1,1"},  {"box:1,1,1", "rounded:0.1,tetrahedron:1"}, {"capsule:1,0.25", "octahedron:1"},
      {"plate:1,1.3", "needle:2"}, {"needle:2", "rounded:0.2,plate:1,0.8"},    {"tetrahedron:1", "box:1e-4,1,1"}};
  std::mt19937_64 random(311);
  int n_overlap = 0, n = 0;
  for (const auto& [a, b] : pairs) {
    const ConvexBody body_a = judged_body(a), body_b = judged_body(b);
    const SeparationJudge judge(body_a, body_b);
    const Domain domain = ball_domain(body_a, body_b);
    for (int k = 0; k < 8; ++k) {
      const Transformd pose = random_pose(random, domain, body_b);
      const SignedDistance exact = exact_signed_distance(body_a, body_b, pose);
      const SeparationJudgement found = judge.judge(pose, {});
      SCOPED_TRACE(std::string(a) + " " + b + " " + std::to_string(exact.value));
      EXPECT_LE(found.lower, exact.value + 1e-17);
      EXPECT_GE(found.upper, exact.value - 1e-17);
      EXPECT_LE(found.upper - found.lower, 1e-15);
      n_overlap += exact.value <= 0.0 ? 1 : 0;
      ++n;
    }
  }
  EXPECT_GT(n_overlap, n / 10);
  EXPECT_LT(n_overlap, 9 * n / 10);
}

TEST(SeparationJudge, KnowsTheTruthOfTurnedDiscsAndEllipsoids) {
  std::mt19937_64 random(313);
  const ConvexBody disc = judged_body("disc:0.7"), needle = judged_body("needle:2"),
                   ellipsoid = judged_body("ellipsoid:1,2,3");
  for (int k = 0; k < 3; ++k) {
    const Transformd pose = random_pose(random, ball_domain(disc, needle), needle);
    const SignedDistance exact = exact_signed_distance(disc, needle, pose);
    const SeparationJudgement found = SeparationJudge(disc, needle).judge(pose, {});
    EXPECT_LE(found.lower, exact.value + exact.error + 1e-17);
    EXPECT_GE(found.upper, exact.value - exact.error - 1e-17);
    EXPECT_LE(found.upper - found.lower, 1e-15);
  }
  // No closed form, and no direction of many that would do better.
  for (int k = 0; k < 20; ++k) {
    const Transformd pose = random_pose(random, ball_domain(ellipsoid, ellipsoid), ellipsoid);
    const SeparationJudgement found = SeparationJudge(ellipsoid, ellipsoid).judge(pose, {});
    EXPECT_LE(found.upper - found.lower, 1e-15);
    for (int j = 0; j < 2000; ++j) {
      const Vec3d dir = random_direction(random);
      const Vec3d w = ellipsoid.support(dir) - pose(ellipsoid.support(-pose.direction_to_b(dir)));
      EXPECT_LE(-dot(w, dir) / norm(dir), found.upper + 1e-14);
    }
  }
}

}  // namespace
}  // namespace vex
