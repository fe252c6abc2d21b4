// Laws of the overlap query that need no referee, for every pair of bodies of the list.
#include <gtest/gtest.h>

#include "engine/numeric/pose_algebra.h"
#include "engine/query/overlap.h"
#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

class OverlapLaws : public testing::TestWithParam<NamedPair> {
 protected:
  const ConvexBody a_ = parse_shape(GetParam().a).body;
  const ConvexBody b_ = parse_shape(GetParam().b).body;
  const Domain domain_ = ball_domain(a_, b_);
  std::mt19937_64 random_{23};

  /// B's centre so far from A's; R of the pose stays.
  void put_apart(Transformd& pose, const Vec3d& step) const {
    pose.translation = {};
    pose.translation = (a_.centre() - pose(b_.centre())) + step;
  }
};

TEST_P(OverlapLaws, OverlapIsMutual) {
  int n_overlap = 0;
  constexpr int n = 1000;
  for (int k = 0; k < n; ++k) {
    const Transformd pose = random_pose(random_, domain_, b_);
    const Outcome one = overlap(a_, b_, pose).outcome;
    ASSERT_EQ(one, overlap(b_, a_, inverse(pose)).outcome);
    ASSERT_NE(one, Outcome::undecided);
    n_overlap += one == Outcome::overlap ? 1 : 0;
  }
  EXPECT_GT(n_overlap, n / 50) << "the sample must hold hits";
}

TEST_P(OverlapLaws, AlongALineThereIsOneContact) {
  // Convexity: moving B outwards along a ray from A's centre, overlap ends once and never comes back.
  for (int k = 0; k < 60; ++k) {
    Transformd pose = random_rotation(random_);
    const Vec3d dir = random_direction(random_);
    const Vec3d unit_dir = (1.0 / norm(dir)) * dir;
    bool ended = false;
    for (int step = 0; step <= 100; ++step) {
      put_apart(pose, (0.0101 * step * domain_.radius) * unit_dir);
      const Outcome outcome = overlap(a_, b_, pose).outcome;
      if (outcome == Outcome::undecided) continue;
      if (outcome == Outcome::disjoint) ended = true;
      ASSERT_EQ(outcome, ended ? Outcome::disjoint : Outcome::overlap) << "step " << step;
    }
    ASSERT_TRUE(ended);
  }
}

TEST_P(OverlapLaws, TheBandOfUndecidedPosesIsNarrow) {
  // Bisection of the contact along a ray: what is undecided spans no more than 1e-12 of the bodies' reach.
  for (int k = 0; k < 40; ++k) {
    Transformd pose = random_rotation(random_);
    const Vec3d dir = random_direction(random_);
    const Vec3d unit_dir = (1.0 / norm(dir)) * dir;
    const auto outcome_at = [&](double distance) {
      put_apart(pose, distance * unit_dir);
      return overlap(a_, b_, pose).outcome;
    };
    const auto boundary = [&](Outcome below) {  // the last distance at which the outcome is `below`, or on that side
      double low = 0.0, high = 1.01 * domain_.radius;
      for (int step = 0; step < 100; ++step) {
        const double middle = 0.5 * (low + high);
        const Outcome outcome = outcome_at(middle);
        const bool is_below = below == Outcome::overlap ? outcome == Outcome::overlap : outcome != Outcome::disjoint;
        (is_below ? low : high) = middle;
      }
      return low;
    };
    const double last_overlap = boundary(Outcome::overlap);
    const double last_undecided = boundary(Outcome::undecided);
    ASSERT_LE(last_undecided - last_overlap, 1e-12 * (a_.reach() + b_.reach()));
  }
}

INSTANTIATE_TEST_SUITE_P(FormlessPairs, OverlapLaws, testing::ValuesIn(formless_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });
INSTANTIATE_TEST_SUITE_P(Pairs, OverlapLaws, testing::ValuesIn(unordered_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });

TEST(OverlapLawsOfPolytopes, PermutingVerticesChangesNoVerdict) {
  std::mt19937_64 random(29);
  TestPolytope hull = test_point_hull(50, {1, 2, 3}, 31);
  std::vector<Vec3d> shuffled = hull.vertices;
  std::shuffle(shuffled.begin(), shuffled.end(), random);
  const ConvexBody other = Polytope(shuffled, {}, 0.0);
  const Domain domain = ball_domain(hull.body, hull.body);
  for (int k = 0; k < 2000; ++k) {
    const Transformd pose = random_pose(random, domain, hull.body);
    ASSERT_EQ(overlap(hull.body, hull.body, pose).outcome, overlap(other, other, pose).outcome);
  }
}

}  // namespace
}  // namespace vex
