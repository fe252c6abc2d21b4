// Found 2026-11 while building the portal refinement: two balls in the ball domain without quick verdicts left 4 of
// 4 million trials undecided, a millionth of the radius inside contact, and needed 56 support calls a pair.
//
// Cause, twice. The search started at the difference of the centres, whose support point for two balls lies exactly
// behind the origin: the origin was on an edge of every simplex until that point was dropped. And the bound of the
// simplex test was taken from the largest possible face, W^2, so that small portals close to the surface could not
// prove what they showed.
#include <gtest/gtest.h>

#include "engine/query/overlap.h"
#include "engine/sampling/monte_carlo.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

TEST(CollinearStart, DoesNotKeepBallsFromBeingDecided) {
  const ConvexBody a = Sphere(1.0), b = Sphere(2.0);
  MonteCarloSettings settings;
  settings.domain = ball_domain(a, b);
  for (const std::uint64_t index : {440477ull, 1142340ull, 3063674ull, 3092604ull}) {
    OverlapCertificate proof;
    const Transformd pose = trial_pose(a, b, settings, index);
    EXPECT_EQ(overlap(a, b, pose, &proof).outcome, Outcome::overlap) << index;
  }
  std::int64_t n_support_calls = 0;
  constexpr std::uint64_t n = 20000;
  for (std::uint64_t k = 0; k < n; ++k) {
    OverlapCertificate proof;
    ASSERT_EQ(overlap(a, b, trial_pose(a, b, settings, k), &proof).outcome, Outcome::overlap);
    n_support_calls += proof.n_support_calls;
  }
  EXPECT_LT(static_cast<double>(n_support_calls) / n, 6.0);
}

}  // namespace
}  // namespace vex
