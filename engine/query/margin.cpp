#include "engine/query/margin.h"

#include <algorithm>

#include "engine/numeric/double_double.h"
#include "engine/numeric/interval.h"
#include "engine/query/overlap.h"
#include "engine/query/separation.h"

namespace vex {
namespace {

WidenedPair widened(const ConvexBody& a, const ConvexBody& b, bool is_a, double margin) {
  WidenedPair pair{a, b, margin, margin};
  ConvexBody& wider = is_a ? pair.a : pair.b;
  const double low = two_sum(wider.ball_radius(), margin).low;
  wider = with_margin(wider, margin);
  if (low == 0.0) return pair;
  // A support mapping adds the margin to the ball's point, the exact stage to its radius, which then is off by -low.
  pair.least = next_below(margin - std::max(0.0, low));
  pair.most = next_above(margin - std::min(0.0, low));
  return pair;
}

}  // namespace

double margin_rounded_down(double radius, double margin) {
  const DoubleDouble sum = two_sum(radius, margin);
  if (sum.low >= 0.0) return margin;
  const double target = next_below(sum.high);
  double result = std::max(0.0, target - radius);
  while (radius + result > target) result = next_below(result);
  return std::min(result, margin);
}

double margin_rounded_up(double radius, double margin) {
  const DoubleDouble sum = two_sum(radius, margin);
  if (sum.low <= 0.0) return margin;
  const double target = next_above(sum.high);
  double result = target - radius;
  while (radius + result < target) result = next_above(result);
  return std::max(result, margin);
}

MarginPairs::MarginPairs(const ConvexBody& a, const ConvexBody& b, double margin) : narrow_{a, b, 0.0, 0.0} {
  const auto is_exact = [margin](const ConvexBody& body) { return two_sum(body.ball_radius(), margin).low == 0.0; };
  if (margin == 0.0) return;
  // On a body without a ball part nothing is added up.
  if (a.ball_radius() == 0.0 || b.ball_radius() == 0.0) {
    narrow_ = widened(a, b, a.ball_radius() == 0.0, margin);
  } else if (is_exact(a) || is_exact(b)) {
    narrow_ = widened(a, b, is_exact(a), margin);
  } else {
    // Of the smaller radius less is rounded.
    const bool is_a = a.ball_radius() <= b.ball_radius();
    const double radius = is_a ? a.ball_radius() : b.ball_radius();
    narrow_ = widened(a, b, is_a, margin_rounded_down(radius, margin));
    wide_ = widened(a, b, is_a, margin_rounded_up(radius, margin));
  }
}

Verdict within_margin(const MarginPairs& pairs, const Pose& pose) {
  const Verdict narrow = overlap(pairs.narrow().a, pairs.narrow().b, pose);
  if (!pairs.is_rounded() || narrow.outcome == Outcome::overlap) return narrow;
  const Verdict wide = overlap(pairs.wide().a, pairs.wide().b, pose);
  if (wide.outcome == Outcome::disjoint) return wide;
  return Verdict::undecided(wide.by, UndecidedReason::rounding);
}

}  // namespace vex
