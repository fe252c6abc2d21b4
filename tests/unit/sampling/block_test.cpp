#include "engine/sampling/block.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vex {
namespace {

// Midpoints of a grid of steps divisible by 12: no cell crosses an edge.
template <class Visit>
void visit_surface(const Block<double>& block, int n_steps, const Visit& visit) {
  for (int i = 0; i < n_steps; ++i) {
    for (int j = 0; j < n_steps; ++j) visit(block.surface_point((i + 0.5) / n_steps, (j + 0.5) / n_steps));
  }
}

TEST(Block, SurfacePointsAreUniformOnACube) {
  constexpr int kSteps = 240;
  const Block<double> cube{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 8.0};
  int n_of_face[3][2] = {};
  double sum_sq[3] = {}, sum_products[3] = {};
  visit_surface(cube, kSteps, [&](const Vec3d& p) {
    const double c[3] = {p.x, p.y, p.z};
    for (int k = 0; k < 3; ++k) {
      EXPECT_LE(std::fabs(c[k]), 1.0);
      if (std::fabs(c[k]) == 1.0) ++n_of_face[k][c[k] > 0.0];
      sum_sq[k] += c[k] * c[k];
      sum_products[k] += std::pow(c[k] * c[(k + 1) % 3], 2.0);
    }
  });
  constexpr double kPoints = kSteps * kSteps;
  for (int k = 0; k < 3; ++k) {
    for (const int n : n_of_face[k]) EXPECT_EQ(6 * n, kSteps * kSteps);
    EXPECT_NEAR(sum_sq[k] / kPoints, 5.0 / 9.0, 1e-4);         // of a face: 1, 1/3 and 1/3
    EXPECT_NEAR(sum_products[k] / kPoints, 7.0 / 27.0, 1e-4);  // 1/3, 1/3 and 1/9
  }
}

TEST(Block, SurfacePointsAreContinuous) {
  const Block<double> block{{3, 0, 0}, {1, 1, 0}, {0, 1, 2}, 48.0};
  constexpr double kStep = 0x1p-20;
  for (const double u : {0.1, 1.0 / 6.0, 0.5, 5.0 / 6.0, 0.9}) {
    for (const double v : {0.0, 0.125, 0.25, 0.3, 0.5, 0.75, 1.0 - kStep}) {
      const Vec3d there = block.surface_point(u, v);
      EXPECT_LE(norm(block.surface_point(u + kStep, v) - there), 64.0 * kStep);
      EXPECT_LE(norm(block.surface_point(u, v + kStep) - there), 64.0 * kStep);
    }
    EXPECT_LE(norm(block.surface_point(u, 0.0) - block.surface_point(u, 1.0)), 1e-12);
  }
}

}  // namespace
}  // namespace vex
