// What a pair that is asked step by step must answer from what it remembers: what it answers from nothing. Along
// motions through contact and back, after jumps, and from memories that are another pair's or of no pair at all.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <type_traits>

#include "engine/numeric/quaternion.h"
#include "engine/query/separation.h"
#include "tests/referees/separation_kinds.h"
#include "tests/referees/separation_tally.h"

namespace vex {
namespace {

static_assert(std::is_trivially_copyable_v<WarmStart>);
static_assert(sizeof(WarmStart) <= 768);

/// Polytopes with and without generators, and with balls; curved ones with every kind of place where they reach least
/// far: smooth, an edge, a face.
constexpr std::array kPersistentKinds = {std::array{"box:1,1,1", "box:1,2,3"},
                                         std::array{"dodecahedron:0.5", "dodecahedron:0.5"},
                                         std::array{"hull:20", "hull:20"},
                                         std::array{"hull:100", "hull:100"},
                                         std::array{"hull:100", "box:1,1,1"},
                                         std::array{"rounded:0.1,box:1,1,1", "hull:20"},
                                         std::array{"ellipsoid:1,2,3", "ellipsoid:3,1,1"},
                                         std::array{"ellipsoid:1,1,1e-3", "ellipsoid:1,1,1e-3"},
                                         std::array{"cylinder:1,0.5", "cylinder:1,0.5"},
                                         std::array{"cone:1,0.5", "cone:1,0.5"},
                                         std::array{"cylinder:1,0.5", "box:1,1,1"},
                                         std::array{"cone:1,0.5", "ellipsoid:1,2,3"},
                                         std::array{"hull:20", "ellipsoid:1,2,3"},
                                         std::array{"capsule:1,0.25", "cylinder:1,0.5"},
                                         std::array{"disc:1", "hemisphere:1"}};

struct PersistentPair {
  ConvexBody a, b;
  explicit PersistentPair(const std::array<const char*, 2>& kind)
      : a(separation_body(kind[0])), b(separation_body(kind[1])) {}
  double size() const { return a.circumradius() + b.circumradius(); }
};

/// B turns about an axis while its centre goes to and fro along a line, from deep in A to apart.
class Swing {
 public:
  Swing(const PersistentPair& pair, std::mt19937_64& random)
      : pair_(pair), line_(random_contact_line(pair.a, pair.b, random)), axis_(random_direction(random)) {
    axis_ = (1.0 / norm(axis_)) * axis_;
  }
  Transformd at(int step) const {
    constexpr double kTurn = 0.5e-3 * std::numbers::pi, kSwing = 2e-3 * std::numbers::pi;
    const double half = kTurn * step;
    const Vec3d v = std::sin(half) * axis_;
    const Transformd turn = rotation_from_quaternion(std::cos(half), v.x, v.y, v.z);
    Transformd pose = line_.turn;
    const auto row = [&](const Vec3d& r) { return line_.turn.direction_to_b(r); };
    pose.row_x = row(turn.row_x);
    pose.row_y = row(turn.row_y);
    pose.row_z = row(turn.row_z);
    put_centres_apart(pair_.a, pair_.b, (0.75 + 0.45 * std::sin(kSwing * step)) * line_.contact * line_.unit_dir, pose);
    return pose;
  }

 private:
  const PersistentPair& pair_;
  ContactLine line_;
  Vec3d axis_;
};

// One truth, and no answer with less to say than the other.
void expect_as_cold(const PersistentPair& pair, const Transformd& pose, const Separation& warm,
                    const Separation& cold) {
  ASSERT_EQ(warm.verdict.outcome, cold.verdict.outcome) << pose_as_source(pose);
  ASSERT_LE(warm.lower, cold.upper) << pose_as_source(pose);
  ASSERT_GE(warm.upper, cold.lower) << pose_as_source(pose);
  ASSERT_LE(warm.lower, warm.signed_distance);
  ASSERT_GE(warm.upper, warm.signed_distance);
  if (cold.is_rough) return;  // of ever so many ways out
  ASSERT_FALSE(warm.is_rough) << pose_as_source(pose) << ": " << warm.lower << " " << warm.upper;
  const Vec3d off = (warm.point_b - warm.point_a) - warm.signed_distance * warm.normal;
  ASSERT_LE(norm(off), 2e-9 * pair.size()) << pose_as_source(pose);
  ASSERT_NEAR(norm(warm.normal), 1.0, 1e-14);
}

class PersistentPairs : public testing::TestWithParam<std::array<const char*, 2>> {
 protected:
  const PersistentPair pair_{GetParam()};
  std::mt19937_64 random_{11};
};

TEST_P(PersistentPairs, AnswerInMotionAsFromNothing) {
  double n_calls = 0.0, n_warm_calls = 0.0;
  int n_deep = 0, n_apart = 0;
  for (int walk = 0; walk < 2; ++walk) {
    const Swing swing(pair_, random_);
    WarmStart memory;
    for (int step = 0; step < 200; ++step) {
      const Transformd pose = swing.at(step);
      const Separation cold = signed_distance(pair_.a, pair_.b, pose);
      const Separation warm = signed_distance(pair_.a, pair_.b, pose, {}, &memory);
      ASSERT_NO_FATAL_FAILURE(expect_as_cold(pair_, pose, warm, cold)) << "step " << step;
      n_calls += cold.n_support_calls;
      n_warm_calls += warm.n_support_calls;
      ++(cold.verdict.outcome == Outcome::overlap ? n_deep : n_apart);
    }
  }
  EXPECT_GT(n_deep, 50);
  EXPECT_GT(n_apart, 50);
  if (pair_.a.is_rounded_polytope() && pair_.b.is_rounded_polytope()) {
    EXPECT_LT(n_warm_calls, 0.6 * n_calls);
  }
}

TEST_P(PersistentPairs, AnswerWithWhatIsAskedOfThem) {
  const Swing swing(pair_, random_);
  WarmStart memory;
  for (int step = 0; step < 60; ++step) {
    const Transformd pose = swing.at(6 * step);
    const Separation cold = signed_distance(pair_.a, pair_.b, pose);
    const double gap = step % 3 == 0 ? 1e-3 : step % 3 == 1 ? 0.1 : 1e-6;
    for (const Separation& warm : {signed_distance(pair_.a, pair_.b, pose, {.relative_gap = gap}, &memory),
                                   distance(pair_.a, pair_.b, pose, {.relative_gap = gap}, &memory),
                                   penetration_depth(pair_.a, pair_.b, pose, {.relative_gap = gap}, &memory)}) {
      ASSERT_EQ(warm.verdict.outcome, cold.verdict.outcome);
      ASSERT_LE(warm.lower, cold.upper);
      ASSERT_GE(warm.upper, cold.lower);
      if (!warm.has_witnesses || cold.is_rough) continue;
      const double value = std::max(std::fabs(warm.lower), std::fabs(warm.upper));
      ASSERT_LE(warm.upper - warm.lower, std::max(1.0001 * gap, 1e-9) * (pair_.size() + value));
    }
  }
}

TEST_P(PersistentPairs, AnswerAfterJumpsAsFromNothing) {
  WarmStart memory;
  const Domain domain = ball_domain(pair_.a, pair_.b);
  for (int step = 0; step < 100; ++step) {
    const Transformd pose =
        step % 4 == 0 ? near_contact_pose(pair_.a, pair_.b, random_, step) : random_pose(random_, domain, pair_.b);
    const Separation cold = signed_distance(pair_.a, pair_.b, pose);
    const Separation warm = signed_distance(pair_.a, pair_.b, pose, {}, &memory);
    ASSERT_NO_FATAL_FAILURE(expect_as_cold(pair_, pose, warm, cold)) << "step " << step;
  }
}

// Bytes that nobody has written as such: of a memory that was one, and of none.
TEST_P(PersistentPairs, AnswerFromAnyBytesAsFromNothing) {
  const Domain domain = ball_domain(pair_.a, pair_.b);
  WarmStart kept;
  for (int step = 0; step < 200; ++step) {
    Transformd pose = random_pose(random_, domain, pair_.b);
    pose.translation = 0.5 * pose.translation;
    const Separation cold = signed_distance(pair_.a, pair_.b, pose);
    signed_distance(pair_.a, pair_.b, pose, {}, &kept);
    std::array<unsigned char, sizeof(WarmStart)> bytes;
    std::memcpy(bytes.data(), &kept, sizeof kept);
    const std::size_t n_changed = step % 4 == 0 ? bytes.size() : std::size_t{1} << (step % 7);
    for (std::size_t k = 0; k < n_changed; ++k) {
      bytes[n_changed == bytes.size() ? k : random_() % bytes.size()] = static_cast<unsigned char>(random_());
    }
    WarmStart garbage;
    std::memcpy(&garbage, bytes.data(), sizeof garbage);
    const Separation warm = signed_distance(pair_.a, pair_.b, pose, {}, &garbage);
    ASSERT_NO_FATAL_FAILURE(expect_as_cold(pair_, pose, warm, cold)) << "step " << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, PersistentPairs, testing::ValuesIn(kPersistentKinds), [](const auto& kind) {
  return test_name({kind.param[0], kind.param[1]});
});

TEST(PersistentPairs, AnswerFromEachOthersMemories) {
  std::mt19937_64 random(12);
  std::vector<PersistentPair> pairs;
  for (const auto& kind : kPersistentKinds) pairs.emplace_back(kind);
  WarmStart memory;
  for (int step = 0; step < 600; ++step) {
    const PersistentPair& pair = pairs[random() % pairs.size()];
    const bool is_swapped = random() % 2 == 0;
    const ConvexBody &a = is_swapped ? pair.b : pair.a, &b = is_swapped ? pair.a : pair.b;
    Transformd pose = random_pose(random, ball_domain(a, b), b);
    pose.translation = 0.5 * pose.translation;
    const Separation cold = signed_distance(a, b, pose);
    const WarmStart copy = memory;
    const Separation warm = signed_distance(a, b, pose, {}, &memory);
    ASSERT_NO_FATAL_FAILURE(expect_as_cold(pair, pose, warm, cold)) << "step " << step;
    WarmStart again = copy;
    EXPECT_EQ(signed_distance(a, b, pose, {}, &again).lower, warm.lower) << "a copy is as good";
  }
}

}  // namespace
}  // namespace vex
