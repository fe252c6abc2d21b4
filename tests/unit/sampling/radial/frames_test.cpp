#include "engine/sampling/radial/frames.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace vex {
namespace {

using Poles = Turns::Poles;

std::vector<Turns> all_turns() {
  return {{1, Poles::one}, {3, Poles::one}, {1, Poles::two}, {4, Poles::two},
          {5, Poles::two}, {2, Poles::six}, {4, Poles::six}};
}
int n_parts(const Turns& turns) {
  return turns.n_sectors * (turns.poles == Poles::one ? 1 : turns.poles == Poles::two ? 2 : 6);
}

// take(frame) at the middles of n times n cells of the coordinates, in each part.
template <class Take>
void at_middles(const Turns& turns, int n, const Take& take) {
  for (int part = 0; part < n_parts(turns); ++part) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        double pick = (part + 0.25) / n_parts(turns);
        const Frame<double> f = frame_of_body(turns, (i + 0.5) / n, (j + 0.5) / n, pick);
        EXPECT_NEAR(pick, 0.25, 1e-12) << "what is left of it is a pick again";
        take(f);
      }
    }
  }
}

TEST(FrameOfBody, IsRightHanded) {
  for (const Turns& turns : all_turns()) {
    at_middles(turns, 20, [](const Frame<double>& f) {
      EXPECT_NEAR(norm(f.axis), 1.0, 1e-14);
      EXPECT_NEAR(norm(f.across_1), 1.0, 1e-14);
      EXPECT_LT(norm(cross(f.across_1, f.across_2) - f.axis), 1e-14);
    });
  }
}

// Also where parts meet: a scaled pick that was a whole number left a pick of 1, of which the next part was none.
TEST(FrameOfBody, IsOneAndLeavesAPickWherePartsMeet) {
  const double last = 1.0 - 0x1p-53;
  for (const Turns& turns : all_turns()) {
    for (int n = 1; n <= 60; ++n) {
      for (int k = 0; k <= n; ++k) {
        const double at = static_cast<double>(k) / n;
        for (const double near : {std::nextafter(at, 0.0), at, std::nextafter(at, 1.0)}) {
          for (const double u : {0.0, 0x1p-53, 0.3, last}) {
            double pick = std::fmin(near, last);
            const Frame<double> f = frame_of_body(turns, u, last - u, pick);
            EXPECT_NEAR(norm(f.axis), 1.0, 1e-14);
            EXPECT_LT(norm(cross(f.across_1, f.across_2) - f.axis), 1e-14);
            EXPECT_GE(pick, 0.0);
            EXPECT_LT(pick, 1.0);
          }
        }
      }
    }
  }
}

// Of caps about directions that no turn knows: the shares that are their areas.
TEST(FrameOfBody, HasAUniformAxis) {
  constexpr int kN = 120;
  const std::array<Vec3d, 3> middles = {Vec3d{0.0, 0.6, 0.8}, Vec3d{0.48, -0.6, 0.64}, Vec3d{-0.36, 0.48, -0.8}};
  for (const Turns& turns : all_turns()) {
    for (const Vec3d& middle : middles) {
      for (const double height : {0.9, 0.6, 0.1}) {
        double n_inside = 0.0;
        at_middles(turns, kN, [&](const Frame<double>& f) { n_inside += dot(f.axis, middle) > height ? 1.0 : 0.0; });
        // Cells that the rim passes are a fiftieth or so of all, half of them counted on either side.
        EXPECT_NEAR(n_inside / (kN * kN * n_parts(turns)), 0.5 * (1.0 - height), 1e-3);
      }
    }
  }
}

// Each part of the pick is a part of the sphere: one that the turns take to the others, and not into itself.
TEST(FrameOfBody, OfOnePickIsInOnePart) {
  constexpr int kN = 50;
  for (int i = 0; i < kN; ++i) {
    for (int j = 0; j < kN; ++j) {
      const double u = (i + 0.5) / kN, v = (j + 0.5) / kN;
      double pick = 0.01;
      EXPECT_GT(frame_of_body({1, Poles::two}, u, v, pick).axis.z, 0.0);
      pick = 0.001;
      const Vec3d axis = frame_of_body({4, Poles::six}, u, v, pick).axis;
      EXPECT_GE(axis.z, std::fabs(axis.x));
      EXPECT_GE(axis.z, std::fabs(axis.y));
      EXPECT_GE(axis.x, std::fabs(axis.y)) << "of the first quarter, whose middle is x";
    }
  }
}

}  // namespace
}  // namespace vex
