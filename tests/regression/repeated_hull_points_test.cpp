// Found 2026-11 by independent referees: signed distances of thin boxes and plates that touch took 16 400 support calls
// and up to 13 seconds, for bounds as far apart as the bodies are thick.
//
// Cause. The hull of a thin difference is not convex but by rounding: a vertex taken in hides another one, which is the
// next to be taken in again, and so on to the cap; and what had reached its cap was not asked in twice the precision.
// Now a hull that takes in a corner of its nearest face, or some of its last points again and again, has stalled.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "engine/numeric/number_text.h"
#include "engine/query/separation.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

ConvexBody hull_body(const std::string& text) { return parse_shape(text, 1.0, kQueriedSizes).body; }

TEST(RepeatedHullPoints, OfTheReport) {
  const ConvexBody bar = hull_body("box:2.0728320725302815e-09,2.0728320725302815e-09,1");
  const Separation of_bars =
      signed_distance(bar, bar, Transformd{.translation = {-0x1.23dee9e35ce83p-30, -0x1.23dee9e35ce83p-30, 0x1p+0}});
  const Separation of_plates = signed_distance(hull_body("box:1,1,1.1118237850410151e-10"), hull_body("plate:1,2"),
                                               Transformd{.translation = {-0x1p+0, -0x1.8p+0, -0x1.e8fc3ac712835p-35}});
  for (const Separation& found : {of_bars, of_plates}) {  // they touch at a corner
    EXPECT_EQ(found.verdict.outcome, Outcome::overlap);
    EXPECT_EQ(found.upper, 0.0);
    EXPECT_GE(found.lower, -1e-20);
    EXPECT_LT(found.n_support_calls, 400);
  }
}

// Corner on corner, edge on edge and face on face of boxes whose edges are powers of two: what they touch by is exact.
TEST(RepeatedHullPoints, OfTouchingThinBoxes) {
  std::mt19937_64 random(11);
  int most_calls = 0;
  for (int k = 0; k < 3000; ++k) {
    const auto size = [&random] { return std::ldexp(1.0, -static_cast<int>(random() % 40)); };
    const Vec3d a{size(), size(), size()}, b{size(), size(), size()};
    const auto box = [](const Vec3d& e) {
      return hull_body("box:" + shortest_number(e.x) + "," + shortest_number(e.y) + "," + shortest_number(e.z));
    };
    const auto sign = [&random] { return random() % 2 == 0 ? 1.0 : -1.0; };
    const auto touching = [&](double x, double y, bool touch) {
      return sign() * (0.5 * (x + y)) * (touch ? 1.0 : 0.5);
    };
    const bool in_y = random() % 2 == 0, in_z = random() % 2 == 0;
    const Vec3d at{touching(a.x, b.x, true), touching(a.y, b.y, in_y), touching(a.z, b.z, in_z)};
    const Separation found = signed_distance(box(a), box(b), Transformd{.translation = at});
    ASSERT_EQ(found.verdict.outcome, Outcome::overlap) << k;
    ASSERT_LE(found.lower, 0.0);
    ASSERT_GE(found.lower, -1e-13) << k;
    most_calls = std::max(most_calls, found.n_support_calls);
  }
  EXPECT_LT(most_calls, 400);
}

}  // namespace
}  // namespace vex
