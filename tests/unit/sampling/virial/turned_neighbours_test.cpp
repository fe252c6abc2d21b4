#include "engine/sampling/virial/turned_neighbours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "shapes/box.h"
#include "shapes/ellipsoid.h"

namespace vex {
namespace {

struct Mean {
  double value, error;
};

template <class Value>
Mean mean_over(std::size_t n, const Value& value) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double x = value(k);
    sum += x;
    squares += x * x;
  }
  const auto count = static_cast<double>(n);
  const double mean = sum / count;
  return {mean, std::sqrt((squares / count - mean * mean) / count)};
}

// Of one orientation, many times.
struct Drawn {
  std::vector<Transformd> poses;
  std::vector<double> factors;
  PairQuestions questions;

  Drawn(const ConvexBody& a, const ConvexBody& b, const Transformd& rotation, double excluded_volume)
      : poses(40'000, rotation), factors(poses.size()) {
    TurnedNeighbours(a, b, excluded_volume, best_instruction_set())
        .draw(2, 100, Outcome::disjoint, poses, factors, questions);
  }
  Mean of_factors() const {
    return mean_over(poses.size(), [this](std::size_t k) { return factors[k]; });
  }
};

Transformd about_z(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}, {}};
}

// Two squares at an angle have the excluded area 2 + 2 (sin + cos).
TEST(TurnedNeighbours, FactorsAreTheExcludedVolumeOnAverage) {
  const ConvexBody cube = Box(1.0, 1.0, 1.0), ellipsoid = Ellipsoid(0.5, 1.0, 2.0);
  for (const double angle : {0.1, 0.5, 0.78}) {
    const Mean mean = Drawn(cube, cube, about_z(angle), 4.0).of_factors();
    const double known = 2.0 * (2.0 + 2.0 * (std::sin(angle) + std::cos(angle))) / 4.0;
    EXPECT_LT(std::fabs(mean.value - known), 4.0 * mean.error) << angle;
    EXPECT_LT(mean.error, 0.01);
  }
  const Mean mean = Drawn(ellipsoid, ellipsoid, {}, 32.0 / 3.0 * std::numbers::pi).of_factors();
  EXPECT_LT(std::fabs(mean.value - 1.0), 4.0 * mean.error);
}

// Parallel balls: the mean of (r/R)^2 over the places, each counting for its factor, is 3/5.
TEST(TurnedNeighbours, PlacesAreUniformAndOverlap) {
  const ConvexBody ball = Ellipsoid(0.5, 0.5, 0.5);
  const Drawn drawn(ball, ball, {}, 4.0 / 3.0 * std::numbers::pi);
  std::size_t n_none = 0;
  for (std::size_t k = 0; k < drawn.poses.size(); ++k) {
    if (drawn.factors[k] == 0.0) {
      ++n_none;
    } else {
      ASSERT_LE(dot(drawn.poses[k].translation, drawn.poses[k].translation), 1.0);
    }
  }
  // (1 - pi/6)^kPlaces of them.
  const double none = std::pow(1.0 - std::numbers::pi / 6.0, static_cast<double>(TurnedNeighbours::kPlaces));
  EXPECT_NEAR(static_cast<double>(n_none) / static_cast<double>(drawn.poses.size()), none, 0.006);
  const Mean mean = mean_over(drawn.poses.size(), [&drawn](std::size_t k) {
    return drawn.factors[k] * dot(drawn.poses[k].translation, drawn.poses[k].translation);
  });
  EXPECT_LT(std::fabs(mean.value - 0.6), 4.0 * mean.error);
  EXPECT_LT(mean.error, 0.01);
}

// A place that is not the first hit, or a factor that hangs on the place, would tell itself in the octants.
TEST(TurnedNeighbours, NoPlaceIsPreferred) {
  const ConvexBody box = Box(1.0, 2.0, 0.5), ellipsoid = Ellipsoid(0.5, 1.0, 2.0);
  const Drawn drawn(box, ellipsoid, about_z(0.3), 20.0);
  for (const Vec3d& along : {Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, 0.0, 1.0}}) {
    const Mean mean = mean_over(
        drawn.poses.size(), [&](std::size_t k) { return drawn.factors[k] * dot(drawn.poses[k].translation, along); });
    EXPECT_LT(std::fabs(mean.value), 4.0 * mean.error);
  }
}

TEST(TurnedNeighbours, OfParallelBoxesEveryPlaceOverlaps) {
  const ConvexBody box = Box(1.0, 2.0, 3.0);
  const Drawn drawn(box, box, {}, 48.0);
  for (const double factor : drawn.factors) ASSERT_NEAR(factor, 1.0, 1e-12);
  EXPECT_EQ(drawn.questions.n_by_balls + drawn.questions.n_searched, drawn.poses.size() * TurnedNeighbours::kPlaces);
}

}  // namespace
}  // namespace vex
