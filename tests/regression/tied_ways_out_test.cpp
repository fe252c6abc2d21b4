// Bodies on one axis have ever so many shortest ways out of each other. The polytope of a depth spent its points on all
// of them and ended with a value that was off by as much as its bounds are apart: 8.3e-6 for a depth of 1e-9, a cone's
// tip on a needle. One of them followed to its end (search/way_out.h) has all digits.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/query/separation_certificate.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

void expect_proven(const ConvexBody& a, const ConvexBody& b, const Transformd& pose, const Separation& found) {
  const CertificateCheck check = check_certificate(a, b, pose, found, certify(a, b, pose, found));
  EXPECT_TRUE(check.is_proven) << check.fault;
}

void expect_depth(const char* a_text, const char* b_text, double height, double depth) {
  SCOPED_TRACE(std::string(a_text) + " " + b_text);
  const ConvexBody a = parse_shape(a_text).body, b = parse_shape(b_text).body;
  const Transformd pose{.translation = {0.0, 0.0, height}};
  for (const Separation& found : {signed_distance(a, b, pose), penetration_depth(a, b, pose)}) {
    EXPECT_NEAR(-found.signed_distance, depth, 1e-12);
    EXPECT_LE(found.lower, -depth);
    EXPECT_GE(found.upper, -depth);
    EXPECT_LT(found.n_support_calls, 1000);
    expect_proven(a, b, pose, found);
  }
}

TEST(TiedWaysOut, AreFollowedToTheirEnd) {
  // The needle's end is 1e-9 below the cone's tip, on its axis: out through the slope, which is steep.
  const double tip = 0.1, down = 1.0 / std::hypot(0.2, 1.0);
  expect_depth("cone:0.2,1", "needle:2", tip + 1.0 - 1e-9, 1e-9 * down);
  expect_depth("cone:0.2,1", "needle:2", tip + 1.0 - 0.1, 0.1 * down);
  expect_depth("cylinder:1,0.5", "sphere:0.1", 0.0, 0.6);
  expect_depth("disc:0.7", "needle:2", 0.3, 0.7);
  expect_depth("ellipsoid:0.5,0.5,1.5", "sphere:0.6", 0.0, 1.1);
}

// The points were where balls along the plane's normal have them, and not those in which the ray along the way out
// leaves: 2.7e-8 and 4.2e-5 beside it.
TEST(TiedWaysOut, HavePointsAlongTheNormal) {
  const auto expect_together = [](const char* a_text, const char* b_text, const Vec3d& translation) {
    SCOPED_TRACE(std::string(a_text) + " " + b_text);
    const ConvexBody a = parse_shape(a_text).body, b = parse_shape(b_text).body;
    const Transformd pose{.translation = translation};
    const Separation found = penetration_depth(a, b, pose);
    const Vec3d across = cross(found.point_b - found.point_a, found.normal);
    EXPECT_LE(norm(across), 1e-12);
    expect_proven(a, b, pose, found);
  };
  expect_together("capsule:1,0.25", "cone:0.2,1", {0x1p-15, 0.0, -0x1.28e77ef81e77ep-3});
  expect_together("capsule:1,0.25", "hemisphere:0.8", {0x1p-23, 0.0, -0x1.0b738315ff062p-1});
}

// Its shortest ways out end on a whole circle, in a band that takes a hull of some 50 000 points to come so near.
TEST(TiedWaysOut, AreProvenByHullsOfManyPoints) {
  const ConvexBody a = parse_shape("sphere:0.6").body, b = parse_shape("ellipsoid:0.5,0.5,1.5").body;
  const Transformd pose{.translation = {0x1p-44, 0.0, 0x1.55128ef18b486p+0}};
  expect_proven(a, b, pose, penetration_depth(a, b, pose));
}

}  // namespace
}  // namespace vex
