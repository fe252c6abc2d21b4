// Bodies on one axis have ever so many shortest ways out of each other. The polytope of a depth spent its points on all
// of them and ended with a value that was off by as much as its bounds are apart: 8.3e-6 for a depth of 1e-9, a cone's
// tip on a needle. One of them followed to its end (search/way_out.h) has all digits.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/query/separation_certificate.h"
#include "shapes/any_shape.h"

namespace vex {
namespace {

void expect_depth(const char* a_text, const char* b_text, double height, double depth) {
  const ConvexBody a = parse_shape(a_text).body, b = parse_shape(b_text).body;
  const Transformd pose{.translation = {0.0, 0.0, height}};
  for (const Separation& found : {signed_distance(a, b, pose), penetration_depth(a, b, pose)}) {
    EXPECT_NEAR(-found.signed_distance, depth, 1e-12) << a_text << " " << b_text;
    EXPECT_LE(found.lower, -depth);
    EXPECT_GE(found.upper, -depth);
    EXPECT_LT(found.n_support_calls, 1000);
    const CertificateCheck check = check_certificate(a, b, pose, found, certify(a, b, pose, found));
    EXPECT_TRUE(check.is_proven) << a_text << " " << b_text << ": " << check.fault;
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

}  // namespace
}  // namespace vex
