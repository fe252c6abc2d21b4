// Found 2026-11 by independent referees: 679 of 80 000 casts of plates, discs and boxes at most 1e-15 thick, and some
// rays, were hits, "proven", of bodies that are disjoint at the start and move apart.
//
// Cause. A portal proves that the line of the motion is in A - B at some t <= upper. Where no plane was found behind
// which the bodies come from (lower = 0), that t may be before the start; `upper >= 0` was taken for a contact at
// t >= 0 all the same. Now a point of A - B at a t >= 0 is proven, too, or all of them are; and of polytopes what
// double precision leaves open is decided in whole numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "engine/numeric/number_text.h"
#include "engine/query/first_contact.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

ConvexBody cast_body(const std::string& text) { return parse_shape(text, 1.0, kQueriedSizes).body; }

FirstContact cast(const char* a, const char* b, const Vec3d& from, const Vec3d& motion) {
  return linear_cast(cast_body(a), cast_body(b), Transformd{.translation = from}, motion);
}

TEST(LeavingCasts, OfTheReport) {
  EXPECT_NE(cast("plate:1,1", "plate:1,1", {0.1, 0.05, 1e-15}, {0, 0, 1}).verdict.outcome, Outcome::overlap);
  EXPECT_NE(time_of_impact(cast_body("plate:1,1"), cast_body("plate:1,1"),
                           Transformd{.translation = {0.1, 0.05, 1e-15}}, {{0, 0, 1}, {}})
                .verdict.outcome,
            Outcome::overlap);
  EXPECT_NE(cast_ray(cast_body("plate:1000,1000"), {3, 5, 3e-12}, {0.1, 0.05, 1}).verdict.outcome, Outcome::overlap);
  EXPECT_NE(cast_ray(cast_body("plate:1000,1000"), {-3, 5, -3e-12}, {0.1, 0.05, -1}).verdict.outcome, Outcome::overlap);
}

// Above or below A by a gap of any size: away from it is a miss, or left open, towards it a hit at gap / speed, or left
// open where it is within rounding.
TEST(LeavingCasts, OfFlatAndThinBodiesAreNeverHits) {
  std::mt19937_64 random(7);
  const auto between = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int n_misses = 0, n_hits = 0, n_open = 0;
  bool is_polytope = true;
  for (int k = 0; k < 20000; ++k) {
    const auto flat = [&](double& half) -> ConvexBody {
      const int kind = static_cast<int>(random() % 4);
      half = kind < 2 ? 0.0 : 0.5 * std::exp2(between(-60, -48));
      const std::string size = shortest_number(between(0.5, 2.0));
      is_polytope = is_polytope && kind % 2 == 0;
      if (kind == 0) return cast_body("plate:" + size + ",1");
      if (kind == 1) return cast_body("disc:" + size);
      if (kind == 2) return cast_body("box:1," + size + "," + shortest_number(2.0 * half));
      return cast_body("cylinder:" + shortest_number(2.0 * half) + ",1");
    };
    double half_a = 0.0, half_b = 0.0;
    is_polytope = true;
    const ConvexBody a = flat(half_a), b = flat(half_b);
    const double gap = std::exp2(between(-60, -5)), side = random() % 2 == 0 ? 1.0 : -1.0;
    // The sum may round: what it leaves of the gap is exact.
    const double height = half_a + half_b + gap, left = (height - half_a) - half_b;
    if (!(left > 0.25 * gap)) continue;
    const Vec3d from{between(-0.3, 0.3), between(-0.3, 0.3), side * height};
    const double speed = std::exp2(between(-20, 20));
    const Vec3d across{between(-1, 1), between(-1, 1), 0.0};
    for (const double sense : {1.0, -1.0}) {
      const Vec3d motion = speed * (across + Vec3d{0.0, 0.0, sense * side});
      const FirstContact found = linear_cast(a, b, Transformd{.translation = from}, motion);
      if (found.verdict.outcome == Outcome::undecided) {
        ++n_open;
        EXPECT_LT(gap, 1e-11) << "a gap that no rounding hides";
        EXPECT_FALSE(is_polytope) << "these are always decided";
      } else if (sense > 0.0) {
        ++n_misses;
        ASSERT_EQ(found.verdict.outcome, Outcome::disjoint) << k << " " << gap;
      } else {
        ++n_hits;
        // The bodies' middles are within 0.3 of each other, and each reaches 0.25 at least, with 2^-5 to go.
        ASSERT_EQ(found.verdict.outcome, Outcome::overlap) << k << " " << gap;
        ASSERT_LE(found.lower, left / speed * (1.0 + 1e-12)) << k << " " << gap;
        ASSERT_GE(found.upper, left / speed * (1.0 - 1e-12)) << k << " " << gap;
      }
    }
  }
  EXPECT_GT(n_misses, 10000);
  EXPECT_GT(n_hits, 10000);
  RecordProperty("undecided", n_open);
}

// Thick bodies that touch, or nearly, go into each other: still hits, for the far side of A - B tells.
TEST(LeavingCasts, IntoEachOtherAreHitsFromTouchingStarts) {
  for (const char* const text : {"box:1,1,1", "sphere:0.5", "cylinder:1,0.5", "cone:1,0.5", "ellipsoid:0.4,0.3,0.5"}) {
    const ConvexBody a = cast_body("box:4,4,1"), b = cast_body(text);
    const double below = -b.support({0, 0, -1}).z;
    for (const double gap : {0.0, 1e-17, 3e-16, 1e-15, 1e-13}) {
      const Vec3d from{0.1, 0.2, 0.5 + below + gap};
      const FirstContact into = linear_cast(a, b, Transformd{.translation = from}, {0.05, 0.02, -1});
      EXPECT_EQ(into.verdict.outcome, Outcome::overlap) << text << " " << gap;
      EXPECT_LE(into.upper, gap + 1e-12);
      const FirstContact out = linear_cast(a, b, Transformd{.translation = from}, {0.05, 0.02, 1});
      if (out.verdict.outcome == Outcome::overlap) {
        EXPECT_EQ(out.upper, 0.0) << "they touch at the start";
      }
    }
  }
}

}  // namespace
}  // namespace vex
