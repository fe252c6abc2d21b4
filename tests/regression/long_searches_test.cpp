// Found 2026-11 by timing: queries of more than a millisecond, of curved bodies that touch to within rounding and of
// motions that are given up.
//
// Cause. Bodies that touch were searched for a proof three times over, some 100 calls in twice the precision each, or
// 500 where portals creep, though the first search had shown that there is none. And an advance of an impact was looked
// for by some four trials, each as dear as a separation, from a length that knew nothing of the last advance; bodies
// many sizes apart were asked for their nearest points each time.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "engine/query/contact_certificate.h"
#include "engine/query/overlap.h"
#include "engine/query/overlap_backend.h"
#include "shapes/any_shape.h"
#include "tests/referees/query_strata.h"

namespace vex {
namespace {

TEST(LongSearches, OfCurvedBodiesThatTouchEndOnceNothingCanBeProven) {
  struct Touch {
    const char *a, *b;
    Vec3d at;
    int n_calls_before;
  };
  for (const auto& [a, b, at, n_calls_before] : {Touch{"ellipsoid:1,1,2", "ellipsoid:1,1,2", {0, 0, 4}, 505},
                                                 Touch{"ellipsoid:1,2,3", "ellipsoid:1,2,3", {0, 0, 6}, 544},
                                                 Touch{"ellipsoid:1,1,1", "ellipsoid:1,1,2", {2, 0, 0}, 509}}) {
    const OverlapAnswer touching =
        overlap_answer(parse_shape(a).body, parse_shape(b).body, Transformd{.translation = at});
    EXPECT_EQ(touching.verdict.outcome, Outcome::undecided) << a << " " << b;
    EXPECT_LT(touching.n_support_calls, 3 * n_calls_before / 4) << a << " " << b;
    // By next to nothing it is decided.
    for (const double apart : {1.0 - 0x1p-52, 1.0 + 0x1p-52}) {
      const OverlapAnswer near =
          overlap_answer(parse_shape(a).body, parse_shape(b).body, Transformd{.translation = apart * at});
      EXPECT_EQ(near.verdict.outcome, apart < 1.0 ? Outcome::overlap : Outcome::disjoint) << a << " " << b;
    }
  }
}

// Of 300 motions of bodies far from their frames' origins fewer are given up; and what is found is proven.
TEST(LongSearches, OfImpactsTakeNoMoreThanTheyMay) {
  for (const QueryStratum& stratum : query_strata()) {
    if (stratum.name != "displaced" && stratum.name != "far") continue;
    const std::string text = stratum.name + " impact 1";
    std::seed_seq seeds(text.begin(), text.end());
    std::mt19937_64 random(seeds);
    for (int k = 0; k < 200; ++k) {
      const QueryScene scene = stratum.scene(random, k);
      const RigidMotion of_b{scene.motion.velocity + scene.motion_a.velocity, scene.motion.angular_velocity};
      const FirstContact found = time_of_impact(scene.a, scene.b, scene.pose, scene.motion_a, of_b, scene.until);
      EXPECT_LT(found.n_support_calls, 6144 + 512) << scene.text();
      // The 198th of those displaced was given up after 8194 calls.
      if (k == 197 && stratum.name == "displaced") {
        EXPECT_EQ(found.verdict.outcome, Outcome::disjoint);
      }
      if (k < 190 && k % 10 != 0) continue;
      const CertificateCheck check = check_certificate(
          scene.a, scene.b, scene.pose, scene.motion_a, of_b, found,
          certify(scene.a, scene.b, scene.pose, scene.motion_a, of_b, found, scene.until), scene.until);
      EXPECT_TRUE(check.is_proven) << check.fault << " " << scene.text();
    }
  }
}

}  // namespace
}  // namespace vex
