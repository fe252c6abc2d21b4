// The exact referee against cases that can be settled by hand.
#include "apps/referees/exact_referee.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/query/overlap.h"
#include "tests/unit/apps/referees/pairs.h"

namespace vex {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

ConvexBody body(const char* text) { return parse_shape(text).body; }

Transformd at(double x, double y, double z, Transformd turn = {}) {
  turn.translation = {x, y, z};
  return turn;
}

// x to y to z to x.
Transformd third_of_a_turn() { return {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {}}; }

// At `distance` along a coordinate axis the bodies touch; one bit farther they do not.
void expect_contact(const char* a, const char* b, double distance, const Vec3d& unit_dir, const Transformd& turn = {}) {
  for (const double sign : {1.0, -1.0}) {
    const auto outcome = [&](double d) {
      Transformd pose = turn;
      pose.translation = (sign * d) * unit_dir;
      return exact_outcome(body(a), body(b), pose);
    };
    EXPECT_EQ(outcome(distance), Outcome::overlap) << a << " " << b;
    EXPECT_EQ(outcome(std::nextafter(distance, 0.0)), Outcome::overlap) << a << " " << b;
    EXPECT_EQ(outcome(std::nextafter(distance, kInfinity)), Outcome::disjoint) << a << " " << b;
  }
}

TEST(ExactReferee, BodiesThatTouchOverlap) {
  const Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  expect_contact("sphere:0.5", "sphere:0.75", 1.25, x);
  expect_contact("box:1,2,3", "box:3,1,2", 1.5, y);
  expect_contact("box:1,2,3", "box:1,2,3", 2.0, x, third_of_a_turn());  // its z is along x: (1 + 3) / 2
  expect_contact("capsule:1,0.25", "capsule:2,0.5", 0.75, x);
  expect_contact("capsule:1,0.25", "capsule:2,0.5", 2.25, z);
  expect_contact("capsule:1,0.25", "capsule:2,0.5", 1.75, x, {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}, {}});
  expect_contact("ellipsoid:1,2,3", "ellipsoid:0.5,0.25,4", 1.5, x);
  expect_contact("ellipsoid:1,2,3", "ellipsoid:0.5,0.25,4", 2.25, y);
  expect_contact("ellipsoid:1,2,3", "ellipsoid:0.5,0.25,4", 7.0, z);
  expect_contact("ellipsoid:1,2,3", "ellipsoid:0.5,0.25,4", 5.0, x, third_of_a_turn());  // its z is along x
  expect_contact("sphere:0.5", "ellipsoid:1,2,3", 3.5, z);
  expect_contact("ellipsoid:1,2,3", "sphere:0.5", 2.5, y);
  expect_contact("sphere:0.5", "box:1,2,3", 2.0, z);
  expect_contact("box:1,2,3", "sphere:0.5", 1.5, y);
  expect_contact("sphere:0.5", "capsule:1,0.25", 1.25, z);
  expect_contact("capsule:1,0.25", "sphere:0.5", 0.75, x);
}

TEST(ExactReferee, PythagorasHolds) {
  // A sphere's centre 3 and 4 beyond an edge; 2, 3 and 6 beyond a corner.
  EXPECT_EQ(exact_outcome(body("box:2,2,2"), body("sphere:5"), at(4, 5, 0)), Outcome::overlap);
  EXPECT_EQ(exact_outcome(body("box:2,2,2"), body("sphere:5"), at(4, 5.0000000000000009, 0)), Outcome::disjoint);
  EXPECT_EQ(exact_outcome(body("sphere:7"), body("box:2,2,2"), at(3, 4, 7)), Outcome::overlap);
  EXPECT_EQ(exact_outcome(body("sphere:7"), body("box:2,2,2"), at(3, 4, 7.0000000000000009)), Outcome::disjoint);
  EXPECT_EQ(exact_outcome(body("capsule:2,2"), body("sphere:5"), at(2, 3, 7)),
            Outcome::overlap);  // 2, 3, 6 from its end
  EXPECT_EQ(exact_outcome(body("capsule:2,2"), body("sphere:5"), at(2, 3, 7.0000000000000009)), Outcome::disjoint);
}

TEST(ExactReferee, OneBodyInsideTheOtherIsOverlap) {
  const char* const small[] = {"box:0.01,0.02,0.01", "ellipsoid:0.01,0.02,0.01", "capsule:0.01,0.01", "sphere:0.01"};
  const char* const large[] = {"box:1,2,3", "ellipsoid:1,2,3", "capsule:1,1", "sphere:1"};
  int n_pairs = 0;
  for (const char* a : small) {
    for (const char* b : large) {
      if (!has_exact_outcome(body(a), body(b))) continue;
      ++n_pairs;
      EXPECT_EQ(exact_outcome(body(a), body(b), at(0.1, -0.2, 0.15)), Outcome::overlap) << a << " " << b;
      EXPECT_EQ(exact_outcome(body(b), body(a), at(0.1, -0.2, 0.15)), Outcome::overlap) << b << " " << a;
      EXPECT_EQ(exact_outcome(body(b), body(a), at(0, 0, 0)), Outcome::overlap) << b << " " << a;
    }
  }
  EXPECT_EQ(n_pairs, 10);
}

TEST(ExactReferee, EllipsoidsTouchFromInsideToo) {
  EXPECT_EQ(exact_outcome(body("ellipsoid:2,2,2"), body("ellipsoid:1,1,1"), at(1, 0, 0)), Outcome::overlap);
  EXPECT_EQ(exact_outcome(body("ellipsoid:1,2,3"), body("ellipsoid:1,2,3"), {}), Outcome::overlap);
}

TEST(ExactReferee, SpheresAreEllipsoidsAndCapsulesWithoutLength) {
  std::mt19937_64 random(3);
  int n_overlap = 0;
  for (int k = 0; k < 200; ++k) {
    Transformd pose = random_rotation(random);
    pose.translation = 1.9 * random_direction(random);
    const Outcome two = exact_outcome(body("sphere:0.6"), body("sphere:0.7"), pose);
    n_overlap += two == Outcome::overlap ? 1 : 0;
    EXPECT_EQ(exact_outcome(body("sphere:0.6"), body("capsule:1e-40,0.7"), pose), two);
    EXPECT_EQ(exact_outcome(body("ellipsoid:0.6,0.6,0.6"), body("sphere:0.7"), pose), two);
  }
  EXPECT_GT(n_overlap, 60);
  EXPECT_LT(n_overlap, 140);
}

TEST(ExactReferee, AgreesWithTheEngineWhereThatDecides) {
  std::mt19937_64 random(4);
  const char* const pairs[][2] = {{"box:1,2,3", "box:1,1,2"},         {"ellipsoid:1,2,3", "ellipsoid:0.3,1,1"},
                                  {"capsule:2,0.3", "capsule:1,0.5"}, {"sphere:0.7", "box:1,2,3"},
                                  {"box:1,2,3", "sphere:0.7"},        {"sphere:0.7", "capsule:2,0.3"},
                                  {"ellipsoid:1,2,3", "sphere:0.7"},  {"sphere:0.7", "ellipsoid:1,2,3"},
                                  {"capsule:2,0.3", "sphere:0.7"}};
  for (const auto& [a, b] : pairs) {
    const ConvexBody body_a = body(a), body_b = body(b);
    const Domain domain = ball_domain(body_a, body_b);
    int n_overlap = 0;
    for (int k = 0; k < 150; ++k) {
      const Transformd pose = random_pose(random, domain, body_b);
      const Outcome found = overlap(body_a, body_b, pose).outcome;
      ASSERT_EQ(exact_outcome(body_a, body_b, pose), found) << a << " " << b;
      n_overlap += found == Outcome::overlap ? 1 : 0;
    }
    EXPECT_GT(n_overlap, 15) << a << " " << b;
    EXPECT_LT(n_overlap, 145) << a << " " << b;
  }
}

TEST(ExactReferee, TakesAnyInvertibleMatrix) {
  const Transformd stretch{{2, 0, 0}, {0, -0.5, 0}, {0, 0, 4}, {}};
  expect_contact("ellipsoid:1,1,1", "ellipsoid:1,1,1", 3.0, {1, 0, 0}, stretch);
  expect_contact("ellipsoid:1,1,1", "ellipsoid:1,1,1", 1.5, {0, 1, 0}, stretch);
  expect_contact("capsule:2,0.5", "capsule:2,0.5", 6.0, {0, 0, 1},
                 stretch);  // the axis is stretched, the balls are not
  expect_contact("sphere:1", "sphere:1", 2.0, {0, 0, 1}, stretch);
}

}  // namespace
}  // namespace vex
