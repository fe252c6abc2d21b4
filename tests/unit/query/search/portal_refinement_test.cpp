#include "engine/query/search/portal_refinement.h"

#include <gtest/gtest.h>

#include "engine/query/overlap.h"
#include "engine/support/combinators.h"
#include "shapes/capsule.h"
#include "shapes/ellipsoid.h"
#include "tests/referees/array_lanes.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

Vec3d random_point(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

// One source, any width; and the part that the ray passes is the one that it passes.
TEST(PortalSplit, FindsThePartThatTheRayPassesInEveryLane) {
  constexpr int W = 4;
  using L = ArrayLanes<W>;
  std::mt19937_64 random(1);
  std::array<int, 3> n_replaced{};
  for (int round = 0; round < 2000; ++round) {
    Vec3<L> lanes_1, lanes_2, lanes_3, lanes_w_v0;
    std::array<Vec3d, W> v0, w;
    std::array<std::array<Vec3d, 3>, W> v;
    for (std::size_t k = 0; k < W; ++k) {
      // A portal about the ray from v0 through the origin, counter-clockwise seen from v0; w beyond its plane.
      v0[k] = random_point(random);
      do {
        for (Vec3d& corner : v[k]) corner = random_point(random) - v0[k];
      } while (!(dot(cross(v[k][0], v[k][1]), v0[k]) < 0.0 && dot(cross(v[k][1], v[k][2]), v0[k]) < 0.0 &&
                 dot(cross(v[k][2], v[k][0]), v0[k]) < 0.0));
      w[k] = random_point(random) - 3.0 * v0[k];
      set_lane(lanes_1, k, v[k][0]);
      set_lane(lanes_2, k, v[k][1]);
      set_lane(lanes_3, k, v[k][2]);
      set_lane(lanes_w_v0, k, cross(w[k], v0[k]));
    }
    const PortalSplit<L> wide = split_portal(lanes_1, lanes_2, lanes_3, lanes_w_v0);
    const PortalPart<L> part = part_passed(wide, lanes_1, lanes_2, lanes_3);
    for (std::size_t k = 0; k < W; ++k) {
      const PortalSplit<double> one = split_portal(v[k][0], v[k][1], v[k][2], cross(w[k], v0[k]));
      ASSERT_EQ(wide.beside_12.on[k], one.beside_12);
      ASSERT_EQ(wide.beside_31.on[k], one.beside_31);
      ASSERT_EQ(bits_of(wide.past_2.lane[k]), bits_of(one.past_2));
      const PortalPart<double> of_one = part_passed(one, v[k][0], v[k][1], v[k][2]);
      ASSERT_EQ(bits_of(part.left.x.lane[k]), bits_of(of_one.left.x));
      ASSERT_EQ(bits_of(part.past_right.lane[k]), bits_of(of_one.past_right));
      ASSERT_FALSE(one.beside_12 && one.beside_31);
      // The ray passes the triangle (left, right, w), which turns as the portal does.
      ASSERT_LE(dot(cross(of_one.left, of_one.right), v0[k]), 0.0);
      ASSERT_LE(dot(cross(of_one.right, w[k]), v0[k]), 0.0);
      ASSERT_LE(dot(cross(w[k], of_one.left), v0[k]), 0.0);
      ++n_replaced[one.beside_12 ? 2 : one.beside_31 ? 1 : 0];
    }
  }
  for (const int n : n_replaced) EXPECT_GT(n, 1000);
}

// What it says is what the bodies' overlap is, and it answers nearly all random pairs.
template <class A, class B>
void expect_proofs(const A& a, const B& b, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const ConvexBody body_a(a), body_b(b);
  const Domain domain = ball_domain(body_a, body_b);
  int n_overlap = 0, n_disjoint = 0;
  for (int round = 0; round < 2000; ++round) {
    const Transformd pose = random_pose(random, domain, body_b);
    const Posed<B, double> placed(b, pose);
    const PortalResult<double> found =
        refine_portal(MinkowskiDifference(a, placed), Vec3d{0.01, 0.02, 0.03} - pose.translation,
                      query_error(body_a, body_b, pose), 200);
    ASSERT_FALSE(found.capped);
    const Outcome truth = overlap(body_a, body_b, pose).outcome;
    if (found.disjoint) {
      ASSERT_EQ(truth, Outcome::disjoint);
    }
    if (found.overlap) {
      ASSERT_EQ(truth, Outcome::overlap);
    }
    n_overlap += found.overlap ? 1 : 0;
    n_disjoint += found.disjoint ? 1 : 0;
  }
  EXPECT_GT(n_overlap, 300);
  EXPECT_GT(n_disjoint, 300);
  EXPECT_GT(n_overlap + n_disjoint, 1990);
}

TEST(PortalRefinement, ProvesWhatItSaysOfBoxes) { expect_proofs(Box(1, 1, 1), Box(1, 1, 1), 1); }
TEST(PortalRefinement, ProvesWhatItSaysOfEllipsoids) { expect_proofs(Ellipsoid(2, 1, 1), Ellipsoid(1, 2, 1.5), 2); }
TEST(PortalRefinement, ProvesWhatItSaysOfACapsuleAndABox) { expect_proofs(Capsule(1, 0.5), Box(1, 2, 1), 3); }

// A body that answers every direction with a point just in front of the last portal, so that no search can end.
struct Elusive {
  mutable double step = 1.0;
  Vec3d support(const Vec3d& dir) const {
    step *= 1.0625;
    const double length = norm(dir);
    return (step / length) * dir + Vec3d{0.3 * step, -0.2 * step, 0.0};
  }
};

TEST(PortalRefinement, AtTheCapAnswersNothingAndSaysSo) {
  const QueryError<double> error{1e200, 1e190};  // nothing is ever proven
  const PortalResult<double> result = refine_portal(Elusive{}, Vec3d{0.5, 0.4, 0.3}, error, 50);
  EXPECT_FALSE(result.disjoint);
  EXPECT_FALSE(result.overlap);
  EXPECT_LE(result.n_support_calls, 50);
}

TEST(PortalRefinement, WithACapOfOneSaysCapped) {
  const Box cube(1, 1, 1);
  const Transformd pose{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.2, 0.3}};
  const Posed<Box, double> placed(cube, pose);
  const ConvexBody body(cube);
  const PortalResult<double> result =
      refine_portal(MinkowskiDifference(cube, placed), -pose.translation, query_error(body, body, pose), 1);
  EXPECT_TRUE(result.capped);
  EXPECT_FALSE(result.overlap);
  EXPECT_FALSE(result.disjoint);
}

}  // namespace
}  // namespace vex
