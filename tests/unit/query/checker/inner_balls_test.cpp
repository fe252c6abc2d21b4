#include "engine/query/checker/inner_balls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "engine/query/separation_certificate.h"
#include "shapes/any_shape.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

ConvexBody body_of(const std::string& text) { return parse_shape(text).body; }

bool come_as_near_as(const char* a, const char* b, const Transformd& pose, double upper) {
  return checker::balls_come_as_near_as(*body_of(a).exact_form(), *body_of(b).exact_form(), pose, whole::Dyadic(upper));
}

TEST(InnerBalls, BoundTheDistanceFromAboveToTheLastDigit) {
  const Transformd pose{.translation = {0.25, 0.0, 0.0}}, apart{.translation = {0.0, 4.0, 0.0}};
  for (const char* ball : {"ellipsoid:1,1,1", "sphere:1", "ellipsoid:1,2,3"}) {
    EXPECT_TRUE(come_as_near_as(ball, "ellipsoid:0.5,0.5,0.5", pose, -1.25)) << ball;
    EXPECT_FALSE(come_as_near_as(ball, "ellipsoid:0.5,0.5,0.5", pose, std::nextafter(-1.25, -2.0))) << ball;
    EXPECT_TRUE(come_as_near_as(ball, "sphere:0.5", apart, 2.5)) << ball;
    EXPECT_FALSE(come_as_near_as(ball, "sphere:0.5", apart, std::nextafter(2.5, 0.0))) << ball;
  }
}

TEST(InnerBalls, OfHalvesAndOfFlatBodiesArePoints) {
  const Transformd pose{.translation = {0.0, 0.0, 0.25}};
  for (const char* b : {"hemisphere:1", "disc:1", "plate:1,1", "needle:2"}) {
    EXPECT_TRUE(come_as_near_as("ellipsoid:1,1,1", b, pose, -0.75)) << b;
    EXPECT_FALSE(come_as_near_as("ellipsoid:1,1,1", b, pose, std::nextafter(-0.75, -1.0))) << b;
  }
}

TEST(InnerBalls, OfAFormOfNothingProveNothing) {
  const ExactForm nothing, point{{{0.0, 0.0, 0.0}}, {}, 0.0};
  for (const auto& [a, b] : {std::pair{&nothing, &point}, {&point, &nothing}, {&nothing, &nothing}}) {
    EXPECT_FALSE(checker::balls_come_as_near_as(*a, *b, Transformd{}, whole::Dyadic(1.0)));
  }
  EXPECT_TRUE(checker::balls_come_as_near_as(point, point, Transformd{}, whole::Dyadic(0.0)));
}

// A pose is a rotation to within 1e-6, and B is what it makes of the body.
TEST(InnerBalls, ShrinkWithThePose) {
  Transformd pose;
  pose.row_x.x = 1.0 - 0x1p-22;
  EXPECT_FALSE(come_as_near_as("ellipsoid:1,1,1", "ellipsoid:1,1,1", pose, -2.0));
  EXPECT_TRUE(come_as_near_as("ellipsoid:1,1,1", "ellipsoid:1,1,1", pose, -2.0 + 0x1p-20));
}

TEST(InnerBalls, ProveTheDepthOfConcentricSpheresGivenAsEllipsoids) {
  std::mt19937_64 random(1);
  for (const char* a : {"ellipsoid:1,1,1", "sphere:1"}) {
    for (const char* b : {"ellipsoid:0.5,0.5,0.5", "ellipsoid:1,1,1", "needle:2"}) {
      for (int k = 0; k < 4; ++k) {
        Transformd pose = k % 2 == 0 ? Transformd{} : random_rotation(random);
        if (k > 1) pose.translation = {1e-3, 0.0, 0.0};
        const ConvexBody body_a = body_of(a), body_b = body_of(b);
        Separation found = penetration_depth(body_a, body_b, pose);
        const SeparationCertificate certificate = certify(body_a, body_b, pose, found);
        const CertificateCheck check = check_certificate(body_a, body_b, pose, found, certificate);
        EXPECT_TRUE(check.is_proven) << check.fault << " " << a << " " << b << " " << k;
        found.upper = found.lower;
        found.signed_distance = found.lower;
        EXPECT_FALSE(check_certificate(body_a, body_b, pose, found, certificate).is_proven) << a << " " << b;
      }
    }
  }
}

}  // namespace
}  // namespace vex
