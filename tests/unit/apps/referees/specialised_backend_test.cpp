#include "apps/referees/specialised_backend.h"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "engine/query/overlap.h"
#include "tests/unit/apps/referees/pairs.h"

namespace vex {
namespace {

struct Case {
  std::string a, b;
  double band;  // undecided within this many u of the reach
};

class SpecialisedTests : public testing::TestWithParam<Case> {
 protected:
  const ConvexBody a_ = parse_shape(GetParam().a).body, b_ = parse_shape(GetParam().b).body;
  const std::unique_ptr<OverlapBackend> test_ = specialised_backend().make(a_, b_);
  std::mt19937_64 random_{5};
};

TEST_P(SpecialisedTests, AreRightOnRandomPoses) {
  // Positions in a ball that is grown after a hit and shrunk after a miss, so that half of them hit.
  constexpr int n = 150, n_before = 500;
  double radius = a_.circumradius() + b_.circumradius();
  int n_overlap = 0;
  for (int k = 0; k < n_before + n; ++k) {
    Transformd pose = random_rotation(random_);
    const Vec3d dir = random_direction(random_);
    pose.translation = (radius * std::cbrt(random_in_unit_interval(random_)) / norm(dir)) * dir;
    const Outcome found = decide_one(*test_, pose);
    radius *= found == Outcome::overlap ? 1.05 : 1.0 / 1.05;
    if (k < n_before) continue;
    ASSERT_EQ(found, exact_outcome(a_, b_, pose));
    n_overlap += found == Outcome::overlap ? 1 : 0;
  }
  EXPECT_GT(n_overlap, 3 * n / 10);
  EXPECT_LT(n_overlap, 7 * n / 10);
}

TEST_P(SpecialisedTests, AreRightNearContact) {
  Held held;
  for (int k = 0; k < 6; ++k) {
    const Transformd turn = random_rotation(random_);
    Ray(a_, b_, turn, random_direction(random_)).expect_right_near_contact(*test_, GetParam().band, held);
  }
  EXPECT_GE(held.n_overlap, 6 * 2);
  EXPECT_GE(held.n_disjoint, 6 * 2);
  EXPECT_GT(held.n_undecided, 0) << "the sample must reach into the band";
}

TEST_P(SpecialisedTests, AreRightForParallelBodies) {
  // Parallel, turned by a right angle, and nearly so; moved apart along an axis, a diagonal, and anywhere.
  Held held;
  int n_rays = 0;
  for (const double angle_rad : {0.0, 0.5 * std::numbers::pi, 1e-9, 1e-16}) {
    for (const Vec3d& axis : {Vec3d{0, 0, 1}, Vec3d{1, 2, 3}}) {
      for (const Vec3d& step : {Vec3d{0, 0, 1}, Vec3d{1, 1, 0}, Vec3d{0.3, -0.2, 0.9}}) {
        const Ray ray(a_, b_, rotation_about(axis, angle_rad), step);
        ++n_rays;
        for (const double shift : {-0.99, -0.5, -1e-3, -1e-9, -1e-15, 0.0, 1e-15, 1e-9, 1e-3, 0.5}) {
          ray.expect_right(*test_, shift, GetParam().band, held);
        }
      }
    }
  }
  EXPECT_GE(held.n_overlap, n_rays * 3);
  EXPECT_GE(held.n_disjoint, n_rays * 2);
}

TEST_P(SpecialisedTests, AreRightWhereTheMatrixIsNotQuiteARotation) {
  Held held;
  for (int k = 0; k < 4; ++k) {
    Transformd turn = random_rotation(random_);
    turn.row_x = 0.9999995 * turn.row_x;
    turn.row_y = turn.row_y + 4e-7 * turn.row_z;
    Ray(a_, b_, turn, random_direction(random_)).expect_right_near_contact(*test_, GetParam().band, held);
  }
  EXPECT_GE(held.n_overlap, 4 * 2);
  EXPECT_GE(held.n_disjoint, 4 * 2);
}

TEST_P(SpecialisedTests, SeeOneBodyInsideTheOther) {
  for (int k = 0; k < 20; ++k) {
    Transformd pose = random_rotation(random_);
    EXPECT_EQ(decide_one(*test_, pose), Outcome::overlap) << "one centre";
    const Vec3d dir = random_direction(random_);
    pose.translation = (0.5 * std::max(a_.inradius(), b_.inradius()) / norm(dir)) * dir;
    EXPECT_EQ(decide_one(*test_, pose), Outcome::overlap) << "a centre inside";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Pairs, SpecialisedTests,
    testing::Values(
        Case{"box:1,1,1", "box:1,1,1", 100}, Case{"box:0.2,1,3", "box:1,2,0.5", 100},
        Case{"box:100,0.01,1", "box:1,1,100", 100}, Case{"box:0.01,0.01,0.01", "box:3,2,1", 100},
        Case{"ellipsoid:1,1,1", "ellipsoid:1,1,1", 300}, Case{"ellipsoid:1,2,3", "ellipsoid:0.5,0.5,1.5", 300},
        Case{"ellipsoid:1,1,32", "ellipsoid:1,1,32", 300}, Case{"ellipsoid:32,32,1", "ellipsoid:32,32,1", 300},
        Case{"ellipsoid:1,1,32", "ellipsoid:1,32,32", 300}, Case{"ellipsoid:1e-6,1,1", "ellipsoid:1e-6,1,1", 300},
        Case{"ellipsoid:1e-6,1e-6,1", "ellipsoid:1e-6,1e-6,1", 300},
        Case{"ellipsoid:1e-6,1e-3,1", "ellipsoid:1,1e-6,1e-2", 300}, Case{"capsule:1,0.25", "capsule:1,0.25", 100},
        Case{"capsule:10,0.1", "capsule:1,0.5", 100}, Case{"capsule:1000,0.001", "capsule:1000,0.001", 100},
        Case{"sphere:0.6", "sphere:1.1", 100}, Case{"sphere:0.6", "box:0.2,1,3", 100},
        Case{"box:0.2,1,3", "sphere:0.6", 100}, Case{"sphere:0.001", "box:1,1,1", 100},
        Case{"sphere:5", "box:1,1,1", 100}, Case{"sphere:0.6", "capsule:1,0.25", 100},
        Case{"capsule:1,0.25", "sphere:0.6", 100}, Case{"sphere:0.6", "ellipsoid:1,2,3", 300},
        Case{"ellipsoid:1,2,3", "sphere:0.6", 300}, Case{"sphere:1e-6", "ellipsoid:1,1e-3,1", 300}),
    [](const auto& test_case) {
      std::string name = test_case.param.a + "_" + test_case.param.b;
      for (char& c : name) c = c == ':' || c == ',' || c == '.' || c == '-' ? '_' : c;
      return name;
    });

TEST(SpecialisedTestsMutated, AreCaughtByTheReferee) {
  // Distances taken 1e-12 too short or too long: what the tests above look at must show it.
  for (const char* text : {"box:0.2,1,3", "ellipsoid:1,2,3", "capsule:1,0.25", "sphere:0.6"}) {
    const ConvexBody body = parse_shape(text).body;
    const auto test = specialised_backend().make(body, body);
    std::mt19937_64 random(11);
    const Transformd turn = random_rotation(random);
    const Ray ray(body, body, turn, random_direction(random));
    for (const double sign : {-1.0, 1.0}) {
      Transformd pose = ray.at(5e-13 * sign);
      EXPECT_EQ(decide_one(*test, pose), ray.exact_at(5e-13 * sign)) << text;
      pose.translation = (1.0 - 1e-12 * sign) * pose.translation;
      EXPECT_NE(decide_one(*test, pose), ray.exact_at(5e-13 * sign)) << text;
    }
  }
}

TEST(SpecialisedBackend, TakesPairsNotBodies) {
  const BackendKind kind = specialised_backend();
  const auto body = [](const char* text) { return parse_shape(text).body; };
  EXPECT_TRUE(kind.is_peer);
  EXPECT_EQ(kind.name, "specialised");
  EXPECT_TRUE(kind.takes(body("box:1,1,1"), body("box:1,2,3")));
  EXPECT_FALSE(kind.takes(body("box:1,1,1"), body("capsule:1,1")));
  EXPECT_FALSE(kind.takes(body("ellipsoid:1,1,2"), body("capsule:1,1")));
  EXPECT_FALSE(kind.takes(body("tetrahedron:1"), body("tetrahedron:1")));
  EXPECT_FALSE(kind.takes(body("rounded:0.1,plate:1,1"), body("sphere:1")));
  const char* const known[] = {"sphere:1", "box:1,1,1", "ellipsoid:1,1,2", "capsule:1,1", "cone:1,1"};
  for (const char* a : known) {
    for (const char* b : known) {
      EXPECT_EQ(kind.takes(body(a), body(b)), has_exact_outcome(body(a), body(b))) << a << " " << b;
      EXPECT_EQ(box_edges_backend().takes(body(a), body(b)), std::string(a) == "box:1,1,1" && a == b);
    }
  }
}

TEST(BoxTests, ByAxesAreRightWhereEdgesAreParallelButForAnUnderflow) {
  // The axis across two such edges is too short for its products: it is left out, and nothing is lost.
  const ConvexBody cube = parse_shape("box:1,1,1").body;
  const auto axes = specialised_backend().make(cube, cube);
  for (const double angle_rad : {1e-100, 1e-160, 1e-200, 1e-320}) {
    for (const Vec3d& axis : {Vec3d{0, 0, 1}, Vec3d{1, 2, 3}}) {
      Transformd pose = rotation_about(axis, angle_rad);
      pose.translation = {0.9, -0.9, 0.9};
      EXPECT_EQ(decide_one(*axes, pose), Outcome::overlap) << angle_rad;
      pose.translation = {0.9, -1.1, 0.9};
      EXPECT_EQ(decide_one(*axes, pose), Outcome::disjoint) << angle_rad;
    }
  }
}

TEST(BoxTests, EdgesBothWaysAxesAndEngineAgree) {
  for (const auto& [text_a, text_b] : {std::pair{"box:1,1,1", "box:1,1,1"}, std::pair{"box:0.2,1,3", "box:2,2,0.1"}}) {
    const ConvexBody a = parse_shape(text_a).body, b = parse_shape(text_b).body;
    const auto axes = specialised_backend().make(a, b), edges = box_edges_backend().make(a, b);
    const Domain domain = ball_domain(a, b);
    std::mt19937_64 random(7);
    int n_overlap = 0;
    for (int k = 0; k < 100000; ++k) {
      const Transformd pose = random_pose(random, domain, b);
      const Outcome by_axes = decide_one(*axes, pose);
      ASSERT_EQ(by_axes, decide_one(*edges, pose));
      ASSERT_EQ(by_axes, overlap(a, b, pose).outcome);
      n_overlap += by_axes == Outcome::overlap ? 1 : 0;
    }
    EXPECT_GT(n_overlap, 10000);
  }
}

TEST(BoxTests, ByEdgesAreRightNearContact) {
  for (const auto& [text_a, text_b] : {std::pair{"box:1,1,1", "box:1,1,1"}, std::pair{"box:0.2,1,3", "box:2,2,0.1"}}) {
    const ConvexBody a = parse_shape(text_a).body, b = parse_shape(text_b).body;
    const auto edges = box_edges_backend().make(a, b);
    std::mt19937_64 random(8);
    Held held;
    for (int k = 0; k < 4; ++k) {
      const Transformd turn = random_rotation(random);
      Ray(a, b, turn, random_direction(random)).expect_right_near_contact(*edges, 200, held);
    }
    EXPECT_GE(held.n_overlap, 4 * 4);
    EXPECT_GE(held.n_disjoint, 4 * 4);
  }
}

TEST(BoxTests, ByEdgesSeeABoxWhollyInsideTheOther) {
  const ConvexBody large = parse_shape("box:1,2,3").body, small = parse_shape("box:0.1,0.2,0.1").body;
  std::mt19937_64 random(9);
  for (int k = 0; k < 100; ++k) {
    Transformd pose = random_rotation(random);
    pose.translation = 0.3 * random_direction(random);
    EXPECT_EQ(decide_one(*box_edges_backend().make(large, small), pose), Outcome::overlap);
    EXPECT_EQ(decide_one(*box_edges_backend().make(small, large), pose), Outcome::overlap);
  }
}

// Faces of aligned cubes that share a plane: every edge lies in one, and only an edge within rounding of a face
// decides.
TEST(BoxTests, ByEdgesLeaveEdgesInFacesUndecidedAndTheAxesDoNot) {
  const ConvexBody cube = parse_shape("box:1,1,1").body;
  Transformd pose;
  pose.translation = {0.7, 0, 0};
  EXPECT_EQ(decide_one(*box_edges_backend().make(cube, cube), pose), Outcome::undecided);
  EXPECT_EQ(decide_one(*specialised_backend().make(cube, cube), pose), Outcome::overlap);
  pose.translation = {1.1, 0, 0};
  EXPECT_EQ(decide_one(*box_edges_backend().make(cube, cube), pose), Outcome::disjoint);
}

}  // namespace
}  // namespace vex
