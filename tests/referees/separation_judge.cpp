#include "tests/referees/separation_judge.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/referees/core_separation.h"

namespace vex {
namespace {

using exact::Bounds;
using exact::DifferenceBody;
using exact::Vec3dd;

constexpr double kLengthOfNormal = 1e-15;
// Of the bodies' exact forms more is decided than a search in double-double can be held to.
constexpr double kAlwaysDecided = 1e-18;
// Roundings of the judge's own bounds, in units of DifferenceBody::scale.
constexpr double kDoubt = 0x1p-84;

Vec3dd widened(const Vec3d& p) { return {p.x, p.y, p.z}; }

ExactForm point_form(const Vec3d& p) { return {{p}, {}, 0.0}; }

// How far a point is from the core, less the ball's radius: 0 or negative within the body.
double off_body(const DifferenceBody& core_and_point, const Vec3d& start, double ball_radius) {
  const Bounds bounds = exact::distance_of_cores(core_and_point, widened(start));
  return (bounds.upper * DoubleDouble(1.0 / core_and_point.scale()) - ball_radius).value();
}

class Findings {
 public:
  Findings(SeparationJudgement& judgement, double accuracy) : judgement_(judgement), accuracy_(accuracy) {}

  void refuse(bool is_wrong, const char* fault, double by = 0.0) {
    if (!is_wrong) return;
    char text[200];
    std::snprintf(text, sizeof text, "%s (%.3g)", fault, by);
    judgement_.faults.emplace_back(text);
  }
  /// A length that must be within the accuracy; a NaN is not.
  void refuse_beyond(double length, const char* fault) {
    refuse(!(std::fabs(length) <= accuracy_ * judgement_.size), fault, length / judgement_.size);
  }

 private:
  SeparationJudgement& judgement_;
  double accuracy_;
};

}  // namespace

SeparationJudge::SeparationJudge(const ConvexBody& a, const ConvexBody& b)
    : a_(a.exact_form().value()),
      b_(b.exact_form().value()),
      radii_(a.circumradius() + b.circumradius()),
      is_rounded_polytope_(a_.is_rounded_polytope() && b_.is_rounded_polytope()) {}

SeparationJudgement SeparationJudge::judge(const Transformd& a_from_b, const Separation& answer,
                                           double accuracy) const {
  SeparationJudgement result;
  const Vec3dd normal = widened(answer.normal);
  const DoubleDouble length = norm(normal);
  const bool is_usable = is_finite(answer.normal) && is_finite(answer.point_a) && is_finite(answer.point_b) &&
                         std::isfinite(answer.signed_distance) && length.high > 0.0;
  const Vec3d start = is_usable ? answer.normal : Vec3d{0.3, -0.5, 0.7};

  const DifferenceBody difference(a_, b_, a_from_b);
  const DoubleDouble unit = 1.0 / difference.scale();  // a power of two
  const DoubleDouble balls = DoubleDouble(a_.ball_radius) + b_.ball_radius, doubt = unit * kDoubt;
  const Bounds cores = exact::signed_distance_of_cores(difference, widened(start));
  DoubleDouble lower = unit * cores.lower - balls - doubt;
  const DoubleDouble upper = unit * cores.upper - balls + doubt;
  DoubleDouble along_normal;  // how far the bodies are apart along it: a bound, too
  if (is_usable) {
    const Vec3dd n{normal.x / length, normal.y / length, normal.z / length};
    along_normal = -(unit * dot(difference.support_of_cores(n).approximately, n)) - balls;
    lower = larger(lower, along_normal - doubt);
  }
  result.lower = lower.value();
  result.upper = upper.value();
  result.size = radii_ + std::max(std::fabs(result.lower), std::fabs(result.upper));
  result.is_known = (upper - lower).value() <= 0.1 * accuracy * result.size;
  result.width = (answer.upper - answer.lower) / result.size;
  // Of ever so many shortest ways out no search finds the shortest: the answer's bounds tell how well it is known.
  if (!result.is_known) accuracy = std::max(accuracy, result.width);
  Findings findings(result, accuracy);

  findings.refuse(!is_usable || !answer.has_witnesses, "there is no answer, or one that is not finite");
  const double above = (DoubleDouble(answer.lower) - upper).value(), below = (lower - answer.upper).value();
  result.bounds_hold = above <= 0.0 && below <= 0.0;
  findings.refuse(!(above <= 0.0), "the lower bound is above the truth", above / result.size);
  findings.refuse(!(below <= 0.0), "the upper bound is below the truth", below / result.size);
  findings.refuse(!(answer.lower <= answer.signed_distance && answer.signed_distance <= answer.upper),
                  "the value is not between its bounds");
  findings.refuse(!(result.width <= accuracy), "the bounds are farther from each other than asked", result.width);
  const DoubleDouble value = answer.signed_distance;
  const double error = std::max({0.0, (value - upper).value(), (lower - value).value()});
  result.error = error / result.size;
  findings.refuse_beyond(error, "the signed distance is off");

  const Outcome outcome = answer.verdict.outcome;
  const double sign = outcome == Outcome::disjoint ? 1.0 : -1.0;
  if (outcome == Outcome::undecided) {
    const double decided = kAlwaysDecided * result.size;
    findings.refuse(is_rounded_polytope_ || result.lower > decided || result.upper < -decided, "it is undecided",
                    result.lower / result.size);
  } else {
    findings.refuse(sign > 0.0 ? upper.value() < 0.0 : lower.value() > 0.0, "the verdict is wrong");
    findings.refuse(sign * answer.signed_distance < 0.0, "verdict and sign differ", answer.signed_distance);
  }
  if (!is_usable) return result;

  const double beyond_one = (length - 1.0).value();
  findings.refuse(!(std::fabs(beyond_one) <= kLengthOfNormal), "the normal is not of length 1", beyond_one);
  findings.refuse_beyond((along_normal - value).value(), "along the normal the bodies are another distance apart");
  const ExactForm point_a = point_form(answer.point_a), point_b = point_form(answer.point_b);
  const double off_a = off_body({a_, point_a, {}}, start, a_.ball_radius);
  const double off_b = off_body({point_b, b_, a_from_b}, start, b_.ball_radius);
  findings.refuse_beyond(std::max(off_a, 0.0), "point_a is not of A");
  findings.refuse_beyond(std::max(off_b, 0.0), "point_b is not of B");
  const Vec3dd between = widened(answer.point_b) - widened(answer.point_a) - value * normal;
  const double aside = norm(between).value();
  findings.refuse_beyond(aside, "the points are not where the normal leads");
  result.points_off = std::max({off_a, off_b, aside, 0.0}) / result.size;
  return result;
}

}  // namespace vex
