// Found 2026-11 by an independent referee: of poses whose rotation is one to within 3e-7 alone, which a `Pose` takes,
// the point of a ball in its own frame was 3e-7 of the radius outside or inside of it, where 1e-12 is promised.
//
// Cause. The normal was turned into B's frame by the transpose, which is not the inverse then, and what came out was
// not one long.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/query/first_contact.h"
#include "engine/query/separation_certificate.h"
#include "shapes/any_shape.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

TEST(NearlyRotations, LeavePointsOnTheirOwnBodies) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  const ConvexBody a = parse_shape("box:1,1,1"), b = parse_shape("sphere:0.3");
  for (int k = 0; k < 100; ++k) {
    Transformd pose = random_rotation(random);
    const auto off = [&](const Vec3d& row) {
      return row + (k == 0 ? 3e-7 * row : 1e-7 * Vec3d{normal(random), normal(random), normal(random)});
    };
    pose = {off(pose.row_x), off(pose.row_y), off(pose.row_z), {2.0, 3.0, 4.0}};
    const Separation found = distance(a, b, Pose(pose));
    EXPECT_NEAR(norm(found.point_b_in_b), 0.3, 3e-13);
    const CertificateCheck check = check_certificate(a, b, Pose(pose), found, certify(a, b, Pose(pose), found));
    EXPECT_TRUE(check.is_proven) << check.fault;
    const FirstContact met = linear_cast(a, b, Pose(pose), {-2.0, -3.0, -4.0});
    EXPECT_NEAR(norm(met.point_b_in_b), 0.3, 3e-13);
    for (const char* const shape : {"capsule:1,0.3", "rounded:0.3,box:1,2,1"}) {
      const ConvexBody rounded = parse_shape(shape);
      const Separation of_rounded = distance(a, rounded, Pose(pose));
      const CertificateCheck checked =
          check_certificate(a, rounded, Pose(pose), of_rounded, certify(a, rounded, Pose(pose), of_rounded));
      EXPECT_TRUE(of_rounded.is_rough || of_rounded.signed_distance <= 0.0 || checked.is_proven) << checked.fault;
    }
  }
}

}  // namespace
}  // namespace vex
