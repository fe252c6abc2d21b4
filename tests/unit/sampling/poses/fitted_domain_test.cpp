#include "engine/sampling/poses/fitted_domain.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "engine/numeric/quaternion.h"
#include "engine/query/overlap.h"
#include "shapes/any_shape.h"
#include "shapes/polytope.h"
#include "tests/referees/bodies.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

Transformd about_z(double angle) {
  Transformd r;
  r.row_x = {std::cos(angle), -std::sin(angle), 0.0};
  r.row_y = {std::sin(angle), std::cos(angle), 0.0};
  return r;
}
Transformd about_x(double angle) {
  Transformd r;
  r.row_y = {0.0, std::cos(angle), -std::sin(angle)};
  r.row_z = {0.0, std::sin(angle), std::cos(angle)};
  return r;
}

// Coordinates of the unit cube of a translation: the inverse of position(), from the edges themselves.
Vec3d cube_coordinates(const Parallelepiped& set, const Vec3d& t) {
  const std::array<Vec3d, 3> edges = {set.width[0] * set.dual[0], set.width[1] * set.dual[1],
                                      set.width[2] * set.dual[2]};
  const double determinant = dot(edges[0], cross(edges[1], edges[2]));
  const Vec3d from_corner = t - set.position(0, 0, 0);
  return {dot(from_corner, cross(edges[1], edges[2])) / determinant,
          dot(from_corner, cross(edges[2], edges[0])) / determinant,
          dot(from_corner, cross(edges[0], edges[1])) / determinant};
}

double least(const Vec3d& v) { return std::min({v.x, v.y, v.z}); }
double greatest(const Vec3d& v) { return std::max({v.x, v.y, v.z}); }

// By the corners that position() gives, not by the normals.
double volume_of_corners(const Parallelepiped& set) {
  const Vec3d o = set.position(0, 0, 0);
  return std::fabs(dot(set.position(1, 0, 0) - o, cross(set.position(0, 1, 0) - o, set.position(0, 0, 1) - o)));
}

// Isotropic ones, and some that are nearly parallel or nearly antiparallel along every axis.
Transformd wild_rotation(std::mt19937_64& random, int k) {
  if (k % 3 != 0) return random_rotation(random);
  const double angle = std::exp2(-40.0 * random_in_unit_interval(random));
  const Vec3d axis = random_direction(random);
  const double w = k % 2 == 0 ? 1.0 : 0.0;
  if (w == 0.0) return rotation_from_quaternion(angle * axis.x, 1.0, angle * axis.y, angle * axis.z);
  return rotation_from_quaternion(1.0, angle * axis.x, angle * axis.y, angle * axis.z);
}

class EveryPair : public testing::TestWithParam<NamedPair> {};

TEST_P(EveryPair, TheSetHoldsEveryTranslationOfContactAndItsVolumeIsItsOwn) {
  const ConvexBody a = parse_shape(GetParam().a).body, b = parse_shape(GetParam().b).body;
  const FittedDomain fitted(a, b);
  const Domain domain = fitted_domain(a, b);
  EXPECT_EQ(domain.kind, Domain::Kind::fitted);
  const double largest = fitted.largest_volume();
  EXPECT_LE(largest, domain.volume * (1.0 + 1e-5));
  std::mt19937_64 random(1);
  double most_used = 0.0;
  for (int k = 0; k < 60; ++k) {
    const Transformd r = wild_rotation(random, k);
    const Parallelepiped set = fitted.at(r);
    ASSERT_GT(set.volume, 0.0);
    ASSERT_LE(set.volume, domain.volume);
    ASSERT_LE(set.volume, largest);
    ASSERT_NEAR(volume_of_corners(set), set.volume, 1e-4 * set.volume);  // cancellation in the corners of thin sets
    double low = 1.0, high = 0.0;
    const auto look_at = [&](const Vec3d& d) {
      const Vec3d contact = a.support(d) - r(b.support(r.direction_to_b(-d)));
      const Vec3d where = cube_coordinates(set, contact);
      low = std::min(low, least(where));
      high = std::max(high, greatest(where));
    };
    for (int n = 0; n < 60; ++n) look_at(random_direction(random));
    // Where the set is tightest: along its own normals.
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d normal = cross(set.dual[(i + 1) % 3], set.dual[(i + 2) % 3]);
      look_at(normal);
      look_at(-normal);
    }
    ASSERT_GE(low, 0.0 - 1e-13) << GetParam().a << " and " << GetParam().b;
    ASSERT_LE(high, 1.0 + 1e-13) << GetParam().a << " and " << GetParam().b;
    most_used = std::max(most_used, high - low);
  }
  EXPECT_GT(most_used, 0.999) << "the set is not wider than it need be";
}

INSTANTIATE_TEST_SUITE_P(FittedDomain, EveryPair, testing::ValuesIn(ordered_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });

TEST(FittedDomain, NoSetIsLargerThanTheLargestWhichOfThinBodiesIsNear) {
  std::mt19937_64 random(4);
  for (const NamedPair& pair :
       {NamedPair{"box:1e3,1,1", "box:1e3,1,1"}, NamedPair{"ellipsoid:1,1,1e6", "ellipsoid:1,1,1e6"},
        NamedPair{"cylinder:1e5,0.5", "box:30,1e3,1"}, NamedPair{"cone:1e3,0.5", "capsule:7,0.01"},
        NamedPair{"box:1e4,30,1", "box:1e4,30,1"}, NamedPair{"box:1e3,1e3,1", "cylinder:1,400"}}) {
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    const FittedDomain fitted(a, b);
    const double largest = fitted.largest_volume();
    double sum = 0.0;
    constexpr int kRotations = 3000;
    for (int k = 0; k < kRotations; ++k) {
      const double volume = fitted.at(wild_rotation(random, k)).volume;
      ASSERT_LE(volume, largest) << pair.a << " and " << pair.b;
      if (k % 3 != 0) sum += volume * 1.5 / kRotations;  // of isotropic ones
    }
    EXPECT_GT(sum, 0.1 * largest) << pair.a << " and " << pair.b;
  }
}

TEST(FittedDomain, OutsideNothingOverlaps) {
  std::mt19937_64 random(2);
  int n_near = 0;
  for (const NamedPair& pair : unordered_pairs()) {
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    const FittedDomain fitted(a, b);
    for (int k = 0; k < 12; ++k) {
      Transformd pose = random_rotation(random);
      const Parallelepiped set = fitted.at(pose);
      std::array<double, 3> u = {random_in_unit_interval(random), random_in_unit_interval(random),
                                 random_in_unit_interval(random)};
      u[random() % 3] = random() % 2 == 0 ? -1e-9 : 1.0 + 1e-9;
      pose.translation = set.position(u[0], u[1], u[2]);
      ASSERT_NE(overlap(a, b, pose).outcome, Outcome::overlap);
      // And inside something does, half of the set at the least for bodies that fill their boxes: here only some.
      pose.translation = set.position(0.5, 0.5, 0.5);
      n_near += overlap(a, b, pose).outcome == Outcome::overlap ? 1 : 0;
    }
  }
  EXPECT_GT(n_near, 1000);
}

TEST(FittedDomain, PositionMapsTheCubeOntoTheSet) {
  const ConvexBody a = parse_shape("box:1,2,3").body, b = parse_shape("cylinder:4,0.3").body;
  std::mt19937_64 random(3);
  for (int k = 0; k < 300; ++k) {
    const Parallelepiped set = FittedDomain(a, b).at(random_rotation(random));
    const double u = random_in_unit_interval(random), v = random_in_unit_interval(random);
    const double w = random_in_unit_interval(random);
    EXPECT_LE(norm(cube_coordinates(set, set.position(u, v, w)) - Vec3d{u, v, w}), 1e-12);
  }
}

TEST(FittedDomain, OfAlignedBoxesIsTheirDifference) {
  const ConvexBody a = parse_shape("box:1,2,3").body, b = parse_shape("box:0.5,4,1").body;
  const Parallelepiped set = FittedDomain(a, b).at({});
  EXPECT_NEAR(set.volume, 1.5 * 6.0 * 4.0, 1e-10);
  EXPECT_GT(set.volume, 1.5 * 6.0 * 4.0) << "wider by its margin";
  EXPECT_NEAR(norm(set.position(0, 0, 0) - Vec3d{-0.75, -3.0, -2.0}), 0.0, 1e-11);
  EXPECT_NEAR(norm(set.position(1, 1, 1) - Vec3d{0.75, 3.0, 2.0}), 0.0, 1e-11);
}

TEST(FittedDomain, BodiesAwayFromTheirOriginsAreAllowedFor) {
  // Vertices far off the frame's origin, as meshes have: what is drawn is a translation, not a centre.
  const std::vector<Vec3d> corners = {{100, 0, 0}, {101, 0, 0}, {100, 1, 0}, {100, 0, 1}, {101, 1, 1}};
  std::vector<Vec3d> moved = corners;
  for (Vec3d& v : moved) v = v + Vec3d{-300, 50, 7};
  const ConvexBody a = Polytope(corners, {100.4, 0.4, 0.4}, 0.05), b = Polytope(moved, {-199.6, 50.4, 7.4}, 0.05);
  std::mt19937_64 random(4);
  for (int k = 0; k < 200; ++k) {
    const Transformd r = wild_rotation(random, k);
    const Parallelepiped set = FittedDomain(a, b).at(r);
    EXPECT_LT(set.volume, 60.0);
    for (const Vec3d& v : corners) {
      for (const Vec3d& w : moved) {
        const Vec3d where = cube_coordinates(set, v - r(w));
        ASSERT_GE(least(where), -1e-11);
        ASSERT_LE(greatest(where), 1.0 + 1e-11);
      }
    }
  }
}

// Two capsules: (32/3) pi r^3 + 8 pi L r^2 + 4 L^2 r sin(gamma).
double excluded_volume_of_capsules(double l, double r, double sine) {
  return (32.0 / 3.0) * std::numbers::pi * r * r * r + 8.0 * std::numbers::pi * l * r * r + 4.0 * l * l * r * sine;
}

TEST(FittedDomain, TendsToTheExcludedVolumeOfThinRods) {
  for (const double angle : {1.5707963, 1.0, 0.3, 0.05}) {
    double last = 1e9;
    for (const double radius : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
      const ConvexBody rod = parse_shape("capsule:1," + std::to_string(radius)).body;
      const double ratio =
          FittedDomain(rod, rod).at(about_x(angle)).volume / excluded_volume_of_capsules(1.0, radius, std::sin(angle));
      EXPECT_GE(ratio, 1.0 - 1e-9);
      EXPECT_LT(ratio, last);
      last = ratio;
    }
    EXPECT_LT(last, 1.001) << angle;
  }
}

TEST(FittedDomain, TendsToTheExcludedVolumeOfANeedleAndAThinRod) {
  // A needle's widths but one are nothing: its own axis is the long one all the same.
  const ConvexBody needle = parse_shape("needle:2").body;
  for (const double radius : {1e-3, 1e-6}) {
    const ConvexBody rod = parse_shape("capsule:1," + std::to_string(radius)).body;
    for (const double angle : {1.5, 0.5, 0.1}) {
      const double exact = (4.0 / 3.0) * std::numbers::pi * radius * radius * radius +
                           3.0 * std::numbers::pi * radius * radius + 4.0 * radius * std::sin(angle);
      EXPECT_NEAR(FittedDomain(needle, rod).at(about_x(angle)).volume, exact, 100 * radius * exact);
      EXPECT_NEAR(FittedDomain(rod, needle).at(about_x(angle)).volume, exact, 100 * radius * exact);
    }
  }
}

TEST(FittedDomain, OfFlatPlatesIsBoundedByTheirSizes) {
  // Two thin square plates across each other at an angle: |A - B| = S_A sin(gamma) times the width along the
  // common edge direction, here (1 + 1) 1 sin(gamma) and what thickness adds.
  const ConvexBody plate = parse_shape("box:1,1,1e-6").body;
  std::mt19937_64 random(5);
  for (const double angle : {1.5, 0.7, 0.1, 1e-3}) {
    const double exact = 2.0 * std::sin(angle);
    EXPECT_NEAR(FittedDomain(plate, plate).at(about_x(angle)).volume, exact, 0.01 * exact + 3e-5) << angle;
  }
  const double largest = fitted_domain(plate, plate).volume;
  for (int k = 0; k < 500; ++k) {
    const Transformd r = random_rotation(random);
    const double sine = std::hypot(r.row_x.z, r.row_y.z);
    EXPECT_LE(FittedDomain(plate, plate).at(r).volume, std::min(largest, 6.0 * sine + 1e-4));
  }
}

TEST(FittedDomain, NearlyParallelAxesGiveFiniteSetsThatAreRight) {
  for (const char* text : {"capsule:1,0.001", "box:1,1,1e-6", "needle:2", "box:1,1,1", "rounded:0.1,tetrahedron:1"}) {
    const ConvexBody body = parse_shape(text).body;
    const FittedDomain fitted(body, body);
    const double parallel = fitted.at({}).volume;
    for (const double angle : {0.0, 1e-300, 1e-18, 1e-12, 1e-9, 9e-7, 1.1e-6, 1e-5}) {
      for (const Transformd& r : {about_x(angle), about_z(angle), about_x(std::numbers::pi - angle)}) {
        const Parallelepiped set = fitted.at(r);
        ASSERT_TRUE(std::isfinite(set.volume)) << text;
        ASSERT_NEAR(volume_of_corners(set), set.volume, 1e-2 * set.volume) << text << " " << angle;
        for (std::size_t i = 0; i < 3; ++i) ASSERT_LE(set.width[i] * norm(set.dual[i]), 0x1p23) << text << " " << angle;
        std::mt19937_64 random(6);
        for (int n = 0; n < 100; ++n) {
          const Vec3d d = random_direction(random);
          const Vec3d where = cube_coordinates(set, body.support(d) - r(body.support(r.direction_to_b(-d))));
          ASSERT_GE(least(where), -1e-9) << text << " " << angle;
          ASSERT_LE(greatest(where), 1.0 + 1e-9) << text << " " << angle;
        }
      }
      if (std::string(text) == "box:1,1,1") {
        EXPECT_NEAR(fitted.at(about_x(angle)).volume, parallel, 100 * angle + 1e-9);
      }
    }
  }
}

TEST(FittedDomain, IsNeverTheLargerOneOfItsChoices) {
  // Against the two simplest: the bounding boxes of A - R B along A's and along B's axes.
  std::mt19937_64 random(7);
  int n_better = 0, n = 0;
  for (const NamedPair& pair : unordered_pairs()) {
    const ConvexBody a = parse_shape(pair.a).body, b = parse_shape(pair.b).body;
    const FittedDomain fitted(a, b);
    for (int k = 0; k < 5; ++k, ++n) {
      const Transformd r = random_rotation(random);
      const auto width = [&](const Vec3d& d) {  // of A - R B
        const Vec3d d_b = r.direction_to_b(d);
        return dot(d, a.support(d)) + dot(-d, a.support(-d)) + dot(d_b, b.support(d_b)) + dot(-d_b, b.support(-d_b));
      };
      const double in_a = width({1, 0, 0}) * width({0, 1, 0}) * width({0, 0, 1});
      const double in_b = width(r({1, 0, 0})) * width(r({0, 1, 0})) * width(r({0, 0, 1}));
      const double volume = fitted.at(r).volume;
      ASSERT_LE(volume, std::min(in_a, in_b) * (1.0 + 1e-9));
      n_better += volume < 0.999 * std::min(in_a, in_b) ? 1 : 0;
    }
  }
  EXPECT_GT(n_better, n / 20) << "the other two choices are there for a reason";
}

}  // namespace
}  // namespace vex
