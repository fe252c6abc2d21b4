#include "engine/sampling/pilot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "engine/numeric/elementary.h"
#include "engine/sampling/radial/radial_estimator.h"
#include "shapes/any_shape.h"
#include "shapes/polytope.h"

namespace vex {
namespace {

TEST(Pilot, TellsTimeAndErrorOfALongerRun) {
  const ConvexBody a = parse_shape("box:1,1,1").body;
  MonteCarloSettings settings;
  settings.domain = ball_domain(a, a);
  const PilotCost hits = pilot(a, a, settings);
  EXPECT_GT(hits.n_trials, 0u);
  EXPECT_GT(hits.seconds_per_trial, 0.0);
  EXPECT_EQ(hits.slope, -0.5);
  // Of p = .505: sqrt((1 - p) / (p n))
  EXPECT_NEAR(hits.relative_error * std::sqrt(static_cast<double>(hits.n_trials)), 0.99, 0.1);
  EXPECT_NEAR(hits.seconds_to(1e-6) / hits.seconds_to(1e-5), 100.0, 0.1);
  EXPECT_NEAR(hits.relative_error_after(hits.seconds_to(1e-5)), 1e-5, 1e-8);
  EXPECT_GT(hits.seconds_to(0.9), 1e-5) << "no run takes no time";

  settings.sequence = Sequence::sobol;
  settings.integrand = [&a] { return std::make_unique<RadialEstimator>(a, a, OrientationLaw()); };
  const PilotCost rays = pilot(a, a, settings);
  EXPECT_LT(rays.relative_error, hits.relative_error);
  EXPECT_LE(rays.slope, -0.5);
  EXPECT_GE(rays.slope, -1.0);
}

TEST(Pilot, OfAPairThatNeverHitsTellsNoTime) {
  const ConvexBody needle = parse_shape("capsule:1,1e-9").body;
  MonteCarloSettings settings;
  settings.domain = ball_domain(needle, needle);
  EXPECT_TRUE(std::isinf(pilot(needle, needle, settings).seconds_to(1e-3)));
}

// Its trials were priced as if none of their calls scanned a facet, and it took seconds.
TEST(Pilot, OfBodiesWithVeryLongFacetsIsShort) {
  std::vector<Vec3d> corners;
  for (int k = 0; k < 6000; ++k) {
    const SinCos<double> at = sincospi(k / 3000.0);
    for (const double z : {-0.5, 0.5}) corners.push_back({at.cos, at.sin, z});
  }
  const ConvexBody prism = Polytope(corners, {}, 0.4);
  MonteCarloSettings settings;
  settings.domain = ball_domain(prism, prism);
  const std::uint64_t n_of_prisms = pilot(prism, prism, settings).n_trials;
  const ConvexBody box = parse_shape("box:1,1,1").body;
  settings.domain = ball_domain(box, box);
  EXPECT_LE(8 * n_of_prisms, pilot(box, box, settings).n_trials);
}

}  // namespace
}  // namespace vex
