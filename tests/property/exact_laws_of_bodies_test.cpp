// Laws that hold to the last bit for every pair of bodies of the list, curved ones too: powers of two, and which of two
// bodies is moved.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "engine/query/overlap.h"
#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/coordinate_sets.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

/// The last translation along `dir` at which the bodies are not proven disjoint.
double last_contact(const ConvexBody& a, const ConvexBody& b, Transformd pose, const Vec3d& dir) {
  double together = 0.0, apart = 4.0 * (a.reach() + b.reach()) / norm(dir);
  for (int k = 0; k < 70; ++k) {
    const double middle = 0.5 * (together + apart);
    pose.translation = middle * dir;
    (overlap(a, b, pose).outcome == Outcome::disjoint ? apart : together) = middle;
  }
  return together;
}

class LawsOfEveryBody : public testing::TestWithParam<NamedPair> {
 protected:
  std::mt19937_64 random_{311};
};

TEST_P(LawsOfEveryBody, PowersOfTwoChangeNoVerdict) {
  const ConvexBody a = parse_shape(GetParam().a).body, b = parse_shape(GetParam().b).body;
  Share share;
  for (int k = 0; k < 12; ++k) {
    Transformd pose = random_rotation(random_);
    const Vec3d dir = random_direction(random_);
    const double contact = last_contact(a, b, pose, dir);
    const int power_of_two = random_power_of_two(random_);
    const double factor = std::ldexp(1.0, power_of_two);
    const ConvexBody scaled_a = parse_shape(GetParam().a, factor).body,
                     scaled_b = parse_shape(GetParam().b, factor).body;
    for (int digits = 3; digits <= 16; ++digits) {
      for (const double side : {-1.0, 1.0}) {
        pose.translation = (contact * (1.0 + side * std::pow(10.0, -digits))) * dir;
        const Verdict verdict = overlap(a, b, pose);
        if (digits <= 9) share.count(verdict.outcome);
        Transformd scaled_pose = pose;
        scaled_pose.translation = factor * pose.translation;
        ASSERT_EQ(overlap(scaled_a, scaled_b, scaled_pose), verdict) << "times 2^" << power_of_two << ", " << digits;
      }
    }
  }
  share.expect_representative();
}

INSTANTIATE_TEST_SUITE_P(FormlessPairs, LawsOfEveryBody, testing::ValuesIn(formless_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });
INSTANTIATE_TEST_SUITE_P(Pairs, LawsOfEveryBody, testing::ValuesIn(unordered_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });

/// Not those of two bodies in planes z = 0, which without a rotation meet in their plane or not at all.
std::vector<NamedPair> pairs_that_meet_unturned() {
  const auto is_flat = [](const std::string& text) {
    const ConvexBody body = parse_shape(text).body;
    return body.support({0, 0, 1}).z == 0.0 && body.support({0, 0, -1}).z == 0.0;
  };
  std::vector<NamedPair> pairs;
  for (const NamedPair& pair : unordered_pairs()) {
    if (!is_flat(pair.a) || !is_flat(pair.b)) pairs.push_back(pair);
  }
  return pairs;
}

class LawsOfBodiesUnturned : public LawsOfEveryBody {};

TEST_P(LawsOfBodiesUnturned, OverlapIsMutualUnderATranslation) {
  // B moved by t in A's frame, or A by -t in B's: the same two sets, moved as one. Polytopes have coordinates on a
  // grid, so that the placed ones are exact.
  constexpr double grid = 0x1p-40;
  const auto on_grid = [](const std::string& text) -> ConvexBody {
    const ConvexBody body = parse_shape(text).body;
    const Points vertices = vertices_of(body);
    return vertices.empty() ? body : polytope(rounded_to_grid(vertices, grid));
  };
  const ConvexBody a = on_grid(GetParam().a), b = on_grid(GetParam().b);
  const Points vertices_a = vertices_of(a), vertices_b = vertices_of(b);
  const bool has_vertices = !vertices_a.empty() || !vertices_b.empty();
  Share share;
  for (int k = 0; k < 20; ++k) {
    const Vec3d dir = random_direction(random_);
    const double contact = last_contact(a, b, {}, dir);
    if (contact < 1e-6) continue;  // a flat face on the origin, moved outwards
    for (int digits = 3; digits <= (has_vertices ? 12 : 16); ++digits) {
      for (const double side : {-1.0, 1.0}) {
        Vec3d step = (contact * (1.0 + side * std::pow(10.0, -digits))) * dir;
        if (has_vertices) step = rounded_to_grid(step, grid);
        shifted(vertices_a, -step);  // checks that nothing is rounded
        shifted(vertices_b, step);
        Transformd there, back;
        there.translation = step;
        back.translation = -step;
        const Verdict one = overlap(a, b, there), other = overlap(b, a, back);
        if (digits <= 8) share.count(one.outcome);
        if (one.outcome != Outcome::undecided && other.outcome != Outcome::undecided) {
          ASSERT_EQ(one.outcome, other.outcome) << digits;
          continue;
        }
        // The two searches start from opposite ends and may give up within the rounding band, each on its own.
        ASSERT_FALSE(!vertices_a.empty() && !vertices_b.empty()) << "polytopes are always decided";
        ASSERT_GT(digits, 8);
        ASSERT_EQ((one.outcome == Outcome::undecided ? one : other).reason, UndecidedReason::rounding);
      }
    }
  }
  EXPECT_GT(share.n, 60);
  share.expect_representative();
}

INSTANTIATE_TEST_SUITE_P(Pairs, LawsOfBodiesUnturned, testing::ValuesIn(pairs_that_meet_unturned()),
                         [](const auto& pair) { return test_name(pair.param); });

}  // namespace
}  // namespace vex
