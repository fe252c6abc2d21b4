// What wrong overlap tests of boxes come to, and that the right ones come to the truth. Fixed seed, 4 standard errors.
#include "apps/referees/wrong_tests.h"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/referees/specialised_backend.h"
#include "engine/sampling/monte_carlo.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

VolumeEstimate two_unit_cubes(const BackendKind& backend) {
  const ConvexBody cube = parse_shape("box:1,1,1").body;
  MonteCarloSettings settings;
  settings.domain = ball_domain(cube, cube);
  settings.stop.trials = 1000000;
  settings.n_threads = 2;
  settings.backend = backend;
  const RunRecord record = run_hit_or_miss(cube, cube, settings);
  EXPECT_EQ(record.tally.n_undecided, 0u);
  return hit_or_miss_estimate(record.tally, settings.domain.volume);
}

double z_of(const VolumeEstimate& found, double expected) {
  return (found.excluded_volume - expected) / found.std_error;
}

TEST(WrongBoxTests, ComeToTheirOwnAverages) {
  const double expected[] = {10.569, 10.138, 9.661, 7.313, 12.116};
  const std::vector<BackendKind> kinds = wrong_box_backends();
  ASSERT_EQ(kinds.size(), std::size(expected));
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const VolumeEstimate found = two_unit_cubes(kinds[k]);
    EXPECT_LE(std::fabs(z_of(found, expected[k])), 4.0) << kinds[k].name << ": " << found.excluded_volume;
    EXPECT_GT(std::fabs(z_of(found, 11.0)), 4.0) << kinds[k].name << " would pass for right";
  }
}

TEST(RightBoxTests, ComeToEleven) {
  for (const BackendKind& kind : {specialised_backend(), box_edges_backend()}) {
    const VolumeEstimate found = two_unit_cubes(kind);
    EXPECT_LE(std::fabs(z_of(found, 11.0)), 4.0) << kind.name << ": " << found.excluded_volume;
  }
}

}  // namespace
}  // namespace vex
