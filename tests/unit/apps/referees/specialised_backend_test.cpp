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

// Which test of the pair the case is for.
std::unique_ptr<OverlapBackend> test_of(const ConvexBody& a, const ConvexBody& b) {
  return specialised_backend().make(a, b);
}

class SpecialisedTests : public testing::TestWithParam<Case> {
 protected:
  const ConvexBody a_ = parse_shape(GetParam().a).body, b_ = parse_shape(GetParam().b).body;
  const std::unique_ptr<OverlapBackend> test_ = test_of(a_, b_);
  std::mt19937_64 random_{5};
};

TEST_P(SpecialisedTests, AreRightOnRandomPoses) {
  // Positions in a ball of as much volume as to give about as many hits as misses.
  Held held;
  const double radius = 0.5 * (a_.inradius() + b_.inradius()) + 0.5 * (a_.circumradius() + b_.circumradius());
  double scale = 1.0;
  constexpr int n = 400;
  for (int k = 0; k < n; ++k) {
    Transformd pose = random_rotation(random_);
    const Vec3d dir = random_direction(random_);
    pose.translation = (scale * radius * std::cbrt(random_in_unit_interval(random_)) / norm(dir)) * dir;
    const int before = held.n_overlap;
    expect_right(*test_, a_, b_, pose, GetParam().band, held);
    scale *= held.n_overlap > before ? 1.02 : 1.0 / 1.02;  // towards one half
  }
  EXPECT_EQ(held.n_undecided, 0);
  EXPECT_GT(held.n_overlap, 3 * n / 10);
  EXPECT_LT(held.n_overlap, 7 * n / 10);
}

TEST_P(SpecialisedTests, AreRightNearContact) {
  Held held;
  for (int k = 0; k < 12; ++k) {
    const Transformd pose = random_rotation(random_);
    expect_right_near_contact(*test_, a_, b_, pose, random_direction(random_), GetParam().band, held);
  }
  EXPECT_GT(held.n_overlap, 12 * 8);
  EXPECT_GT(held.n_disjoint, 12 * 8);
  EXPECT_GT(held.n_undecided, 0) << "the sample must reach into the band";
}

TEST_P(SpecialisedTests, AreRightForParallelBodies) {
  // Parallel, turned by right angles, and nearly so; moved apart along an axis, a diagonal, and anywhere.
  Held held;
  const double right_angle = 0.5 * std::numbers::pi;
  for (const double angle : {0.0, right_angle, 1e-3, 1e-9, 1e-12, 1e-16, 1e-200}) {
    for (const Vec3d& axis : {Vec3d{0, 0, 1}, Vec3d{0, 1, 0}, Vec3d{1, 2, 3}}) {
      for (const Vec3d& step : {Vec3d{0, 0, 1}, Vec3d{1, 0, 0}, Vec3d{1, 1, 0}, Vec3d{0.3, -0.2, 0.9}}) {
        Transformd pose = rotation_about(axis, angle);
        const double contact = contact_factor(a_, b_, pose, step);
        for (const double shift : {-0.99, -0.5, -1e-3, -1e-9, -1e-15, 0.0, 1e-15, 1e-9, 1e-3, 0.5}) {
          pose.translation = (contact * (1.0 + shift)) * step;
          expect_right(*test_, a_, b_, pose, GetParam().band, held);
        }
      }
    }
  }
  EXPECT_GT(held.n_overlap, 84 * 4);
  EXPECT_GT(held.n_disjoint, 84 * 2);
}

TEST_P(SpecialisedTests, SeeOneBodyInsideTheOther) {
  Transformd pose = random_rotation(random_);
  EXPECT_EQ(decide_one(*test_, pose), Outcome::overlap) << "one centre";
  const Vec3d dir = random_direction(random_);
  pose.translation = (0.5 * std::max(a_.inradius(), b_.inradius()) / norm(dir)) * dir;
  EXPECT_EQ(decide_one(*test_, pose), Outcome::overlap);
  // A small copy of B, which is a body of its kind, in the middle of A, and the other way round.
  EXPECT_EQ(exact_outcome(a_, b_, pose), Outcome::overlap);
}

TEST_P(SpecialisedTests, TakeRotationsThatAreNotQuiteOnes) {
  Held held;
  for (int k = 0; k < 6; ++k) {
    Transformd pose = random_rotation(random_);
    pose.row_x = 0.9999995 * pose.row_x;
    pose.row_y = pose.row_y + 4e-7 * pose.row_z;
    expect_right_near_contact(*test_, a_, b_, pose, random_direction(random_), GetParam().band, held);
  }
  EXPECT_GT(held.n_overlap, 6 * 8);
  EXPECT_GT(held.n_disjoint, 6 * 8);
}

INSTANTIATE_TEST_SUITE_P(
    Pairs, SpecialisedTests,
    testing::Values(Case{"box:1,1,1", "box:1,1,1", 100}, Case{"box:0.2,1,3", "box:1,2,0.5", 100},
                    Case{"box:100,0.01,1", "box:1,1,100", 100}, Case{"box:0.01,0.01,0.01", "box:3,2,1", 100},
                    Case{"ellipsoid:1,1,1", "ellipsoid:1,1,1", 300}, Case{"ellipsoid:1,2,3", "ellipsoid:0.5,0.5,1.5", 300},
                    Case{"ellipsoid:1,1,32", "ellipsoid:1,1,32", 300}, Case{"ellipsoid:32,32,1", "ellipsoid:32,32,1", 300},
                    Case{"ellipsoid:1,1,32", "ellipsoid:1,32,32", 300},
                    Case{"ellipsoid:1e-6,1,1", "ellipsoid:1e-6,1,1", 300},
                    Case{"ellipsoid:1e-6,1e-6,1", "ellipsoid:1e-6,1e-6,1", 300},
                    Case{"ellipsoid:1e-6,1e-3,1", "ellipsoid:1,1e-6,1e-2", 300},
                    Case{"capsule:1,0.25", "capsule:1,0.25", 100}, Case{"capsule:10,0.1", "capsule:1,0.5", 100},
                    Case{"capsule:1000,0.001", "capsule:1000,0.001", 100}, Case{"sphere:0.6", "sphere:1.1", 100},
                    Case{"sphere:0.6", "box:0.2,1,3", 100}, Case{"box:0.2,1,3", "sphere:0.6", 100},
                    Case{"sphere:0.001", "box:1,1,1", 100}, Case{"sphere:5", "box:1,1,1", 100},
                    Case{"sphere:0.6", "capsule:1,0.25", 100}, Case{"capsule:1,0.25", "sphere:0.6", 100},
                    Case{"sphere:0.6", "ellipsoid:1,2,3", 300}, Case{"ellipsoid:1,2,3", "sphere:0.6", 300},
                    Case{"sphere:1e-6", "ellipsoid:1,1e-3,1", 300}),
    [](const auto& test_case) {
      std::string name = test_case.param.a + "_" + test_case.param.b;
      for (char& c : name) c = c == ':' || c == ',' || c == '.' || c == '-' ? '_' : c;
      return name;
    });

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
  // Undecided also where an edge lies in a face, so nothing is asked of that.
  for (const auto& [text_a, text_b] : {std::pair{"box:1,1,1", "box:1,1,1"}, std::pair{"box:0.2,1,3", "box:2,2,0.1"}}) {
    const ConvexBody a = parse_shape(text_a).body, b = parse_shape(text_b).body;
    const auto edges = box_edges_backend().make(a, b);
    std::mt19937_64 random(8);
    Held held;
    for (int k = 0; k < 20; ++k) {
      expect_right_near_contact(*edges, a, b, random_rotation(random), random_direction(random), 200, held);
    }
    EXPECT_GT(held.n_overlap, 20 * 9);
    EXPECT_GT(held.n_disjoint, 20 * 9);
  }
}

}  // namespace
}  // namespace vex
