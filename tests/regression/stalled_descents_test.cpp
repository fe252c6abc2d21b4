// A descent ends where rounding allows no nearer point: lengths differ by less than their last place then, and the
// nearest point, seen from the origin, lies up to its square root aside. The normal of such a point showed 6.4e-9 less
// than the distance, and an earlier one that showed all of it was 8e-9 away from the points.
#include <gtest/gtest.h>

#include "engine/query/separation_certificate.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

TEST(StalledDescents, AreDescendedAgain) {
  const ConvexBody a = parse_shape("ellipsoid:1,2,3").body, b = parse_shape("box:0.2,1,3").body;
  const Transformd pose{.row_x = {-1, 0, 0},
                        .row_y = {0, 0, -1},
                        .row_z = {0, -1, 0},
                        .translation = {-0x1.c42a8b4bcce5ep+0, 0, 0}};
  const double truth = 0x1.c42a8b4bcce5ep+0 - 1.0 - 0.1;
  const Separation found = distance(a, b, pose);
  EXPECT_NEAR(found.signed_distance, truth, 1e-14);
  EXPECT_LE(norm(found.normal - Vec3d{-1, 0, 0}), 1e-9);
  EXPECT_LE(norm((found.point_b - found.point_a) - truth * Vec3d{-1, 0, 0}), 1e-9);
  const CertificateCheck check = check_certificate(a, b, pose, found, certify(a, b, pose, found));
  EXPECT_TRUE(check.is_proven) << check.fault;
}

}  // namespace
}  // namespace vex
