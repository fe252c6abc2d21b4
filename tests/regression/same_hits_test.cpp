// Verdicts are proven, so the hits of a run are one number, however the filter was compiled. A compiler may fuse a*b+c
// into one operation with one rounding: support points, directions and determinants then differ in their last bits, and
// with them what the filter can prove, but never what is true.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "engine/query/overlap.h"
#include "tests/referees/exact_truth.h"
#include "tests/referees/random_poses.h"
#include "tests/regression/same_hits_bodies.h"

namespace vex {
namespace {

bool has_fused_operations() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("fma") != 0;
#else
  return true;
#endif
}

struct Pair {
  SameHitsBody a, b;
};
constexpr Pair kPairs[] = {{SameHitsBody::cube, SameHitsBody::cube},
                           {SameHitsBody::slab, SameHitsBody::plate},
                           {SameHitsBody::ellipsoid, SameHitsBody::ellipsoid},
                           {SameHitsBody::cylinder, SameHitsBody::slab},
                           {SameHitsBody::capsule, SameHitsBody::cube}};

class Comparison {
 public:
  explicit Comparison(const Pair& pair)
      : a_(same_hits_body(pair.a)),
        b_(same_hits_body(pair.b)),
        fused_a_(fused_body(pair.a)),
        fused_b_(fused_body(pair.b)) {}

  const ConvexBody& a() const { return a_; }
  const ConvexBody& b() const { return b_; }

  void compare(const Transformd& pose) {
    ++n_trials;
    const FilterResult plain = filter_overlap(a_, b_, pose, kMaxSupportCalls);
    const FilterResult fused = fused_filter_overlap(fused_a_, fused_b_, pose, kMaxSupportCalls);
    const Vec3d off = plain.separating_dir - fused.separating_dir;
    n_different += norm_1(off) > 0.0 || plain.n_support_calls != fused.n_support_calls ? 1 : 0;
    const Outcome verdict = overlap(a_, b_, pose).outcome;
    Outcome with_fused = fused.verdict.outcome;
    if (with_fused == Outcome::undecided) {
      ++n_escalated;
      with_fused = verdict;  // the stages behind the filter are the same
    } else if (verdict == Outcome::undecided) {
      return;  // within its rounding a curved pair may be open to one and not to the other
    }
    ASSERT_EQ(with_fused, verdict);
    n_hits += verdict == Outcome::overlap ? 1 : 0;
    n_fused_hits += with_fused == Outcome::overlap ? 1 : 0;
  }

  int n_trials = 0, n_different = 0, n_escalated = 0, n_hits = 0, n_fused_hits = 0;

 private:
  ConvexBody a_, b_, fused_a_, fused_b_;
};

TEST(SameHits, OfRandomPosesWithAndWithoutFusedOperations) {
  if (!has_fused_operations()) GTEST_SKIP() << "this processor has no fused multiply-add";
  std::mt19937_64 random(1);
  for (const Pair& pair : kPairs) {
    Comparison comparison(pair);
    const Domain domain = ball_domain(comparison.a(), comparison.b());
    for (int k = 0; k < 20000; ++k) {
      ASSERT_NO_FATAL_FAILURE(comparison.compare(random_pose(random, domain, comparison.b())));
    }
    EXPECT_EQ(comparison.n_fused_hits, comparison.n_hits);
    EXPECT_GT(comparison.n_hits, comparison.n_trials / 10) << "the sample must hold both";
    EXPECT_LT(comparison.n_hits, comparison.n_trials * 9 / 10);
    EXPECT_GT(comparison.n_different, comparison.n_trials / 100) << "the filter is fused indeed";
  }
}

TEST(SameHits, OfPosesNearContactWithAndWithoutFusedOperations) {
  if (!has_fused_operations()) GTEST_SKIP() << "this processor has no fused multiply-add";
  std::mt19937_64 random(2);
  for (const Pair& pair : kPairs) {
    Comparison comparison(pair);
    for (int k = 0; k < 200; ++k) {
      Transformd pose = random_rotation(random);
      const Vec3d dir = random_direction(random);
      const double contact = contact_along(comparison.a(), comparison.b(), pose, dir);
      for (int j = 0; j < 100; ++j) {
        // Off contact by 2^-10 to 2^-53 of the distance, on both sides.
        const double size = std::ldexp(1.0 + random_in_unit_interval(random), -11 - static_cast<int>(random() % 43));
        pose.translation = (contact * (j % 2 == 0 ? 1.0 + size : 1.0 - size)) * dir;
        ASSERT_NO_FATAL_FAILURE(comparison.compare(pose));
      }
    }
    EXPECT_EQ(comparison.n_fused_hits, comparison.n_hits);
    EXPECT_GT(comparison.n_hits, comparison.n_trials * 3 / 10) << "the sample must hold both";
    EXPECT_LT(comparison.n_hits, comparison.n_trials * 7 / 10);
    EXPECT_GT(comparison.n_escalated, comparison.n_trials / 20) << "and what the filter leaves open";
    EXPECT_GT(comparison.n_different, comparison.n_trials / 20) << "the filter is fused indeed";
  }
}

}  // namespace
}  // namespace vex
