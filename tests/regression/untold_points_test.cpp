// Found 2026-11 by a hostile referee: an impact whose points had a coordinate of infinity, proven and all.
//
// Cause. Points are found where A's origin takes its frame along, and are moved by time times velocity in the end,
// which no double tells where both are large enough. Times of contact that no double tells were undecided before, and
// points are now.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/query/contact_certificate.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

TEST(UntoldPoints, OfContactsAreUndecided) {
  const ConvexBody a = parse_shape("box:1,1,1").body, b = parse_shape("box:4,0.1,0.1").body;
  const Transformd pose{.translation = {0.0, 1.5, 0.0}};
  int n_told = 0, n_untold = 0;
  for (const double speed : {1e100, 1e150, 1e200, 1e300, -1e300}) {
    for (const double spin : {1e-100, 1e-150, 1e-200, 1e-300}) {
      const RigidMotion of_a{{speed, 0.0, 0.0}, {}}, of_b{{speed, 0.0, 0.0}, {0.0, 0.0, spin}};
      const FirstContact found = time_of_impact(a, b, pose, of_a, of_b);
      for (const Vec3d& p : {found.point_a, found.point_b}) EXPECT_TRUE(is_finite(p)) << speed << " " << spin;
      const bool is_told = std::fabs(speed) / spin < 1e305;
      EXPECT_EQ(found.verdict.outcome, is_told ? Outcome::overlap : Outcome::undecided) << speed << " " << spin;
      ++(is_told ? n_told : n_untold);
      const CertificateCheck check =
          check_certificate(a, b, pose, of_a, of_b, found, certify(a, b, pose, of_a, of_b, found));
      EXPECT_TRUE(check.is_proven) << check.fault << " " << speed << " " << spin;
    }
  }
  EXPECT_GT(n_told, 5);
  EXPECT_GT(n_untold, 5);
}

}  // namespace
}  // namespace vex
