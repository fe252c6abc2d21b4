#include "engine/query/portal_refinement.h"

#include <gtest/gtest.h>

#include "engine/support/combinators.h"
#include "shapes/capsule.h"
#include "shapes/ellipsoid.h"
#include "tests/referees/array_lanes.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

// One source, any width: four lanes, each with a pose of its own and ending in another round, must end as four single
// ones.
template <class A, class B>
void expect_lanes_to_agree(const A& a, const B& b, std::uint64_t seed) {
  constexpr int W = 4;
  using L = ArrayLanes<W>;
  std::mt19937_64 random(seed);
  const ConvexBody body_a(a), body_b(b);
  const Domain domain = ball_domain(body_a, body_b);
  int n_overlap = 0, n_disjoint = 0;
  for (int round = 0; round < 500; ++round) {
    std::array<Transformd, W> poses;
    Transform<L> pose;
    Vec3<L> inner;
    for (std::size_t k = 0; k < W; ++k) {
      poses[k] = random_pose(random, domain, body_b);
      set_lane(pose, k, poses[k]);
      set_lane(inner, k, Vec3d{0.01, 0.02, 0.03} - poses[k].translation);
    }
    const Posed<B, L> placed(b, pose);
    const PortalResult<L> wide =
        refine_portal(MinkowskiDifference(a, placed), inner, query_error(body_a, body_b, pose), 200);
    for (std::size_t k = 0; k < W; ++k) {
      const Posed<B, double> one_placed(b, poses[k]);
      const PortalResult<double> one =
          refine_portal(MinkowskiDifference(a, one_placed), Vec3d{0.01, 0.02, 0.03} - poses[k].translation,
                        query_error(body_a, body_b, poses[k]), 200);
      ASSERT_EQ(wide.disjoint.on[k], one.disjoint);
      ASSERT_EQ(wide.overlap.on[k], one.overlap);
      ASSERT_EQ(wide.capped.on[k], one.capped);
      if (one.disjoint) {
        ASSERT_EQ(bits_of(wide.separating_dir.x.lane[k]), bits_of(one.separating_dir.x));
      }
      if (one.overlap) {
        ASSERT_EQ(bits_of(wide.v3.z.lane[k]), bits_of(one.v3.z));
      }
      n_overlap += one.overlap ? 1 : 0;
      n_disjoint += one.disjoint ? 1 : 0;
    }
  }
  EXPECT_GT(n_overlap, 300);
  EXPECT_GT(n_disjoint, 300);
}

TEST(PortalRefinement, LanesAgreeWithOneLaneOnBoxes) { expect_lanes_to_agree(Box(1, 1, 1), Box(1, 1, 1), 1); }
TEST(PortalRefinement, LanesAgreeWithOneLaneOnEllipsoids) {
  expect_lanes_to_agree(Ellipsoid(2, 1, 1), Ellipsoid(1, 2, 1.5), 2);
}
TEST(PortalRefinement, LanesAgreeWithOneLaneOnACapsuleAndABox) {
  expect_lanes_to_agree(Capsule(1, 0.5), Box(1, 2, 1), 3);
}

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
