#include "engine/sampling/radial/radial_packets.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "engine/sampling/radial/radial_function.h"
#include "engine/sampling/radial/radial_steps.h"
#include "engine/sampling/radial/ray_columns.h"
#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"
#include "tests/referees/polytopes.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

struct Rays {
  std::unique_ptr<RayColumns> columns = std::make_unique<RayColumns>();
  std::size_t n = 0;

  RayTable table() const { return columns->table(n); }
};

/// Behind the first comes the first again, where `repeats`.
Rays random_rays(const RadialMap& map, std::size_t n, std::uint64_t seed, bool repeats = false) {
  std::mt19937_64 random(seed);
  Rays rays;
  rays.n = n;
  for (auto& column : rays.columns->coordinates) {
    for (std::size_t k = 0; k < n; ++k) column[k] = repeats && k > 0 ? column[0] : random_in_unit_interval(random);
  }
  ray_maker(InstructionSet::scalar)(map, n, *rays.columns);
  return rays;
}

std::vector<double> cubes_of(PacketRays& packets, const Rays& rays) {
  const auto answers = std::make_unique<RadialAnswers>();
  packets.find(rays.table(), *answers);
  for (std::size_t k = 0; k < rays.n; ++k) {
    EXPECT_TRUE(std::isnan(answers->cube[k]) || answers->outer[k] == 0.0) << "answered or left open";
    EXPECT_LE(answers->inner[k], answers->outer[k]);
  }
  return {answers->cube, answers->cube + rays.n};
}

void expect_cubes(const ConvexBody& a, const ConvexBody& b) {
  const RadialMap map(a, b, {});
  // Also such numbers as leave a register half empty.
  for (const std::size_t n : {std::size_t{1}, std::size_t{7}, PacketRays::kMostRays}) {
    const Rays rays = random_rays(map, n, 17 + n);
    std::vector<double> first;
    for (const InstructionSet set : instruction_sets()) {
      SCOPED_TRACE(name_of(set));
      const auto packets = make_packet_rays(ray_kernel(set), a, b, map.points());
      ASSERT_NE(packets, nullptr);
      const std::vector<double> cubes = cubes_of(*packets, rays);
      std::size_t n_open = 0;
      for (std::size_t k = 0; k < n; ++k) {
        if (std::isnan(cubes[k])) {
          ++n_open;
          continue;
        }
        const RadialBounds truth = radial_function(a, b, map.points(), rays.table().rotation(k), rays.table().dir(k));
        // Between the cubes of bounds that are within kRadialGap of each other and hold the truth.
        EXPECT_GE(std::cbrt(cubes[k]), truth.lower * (1.0 - kRadialGap)) << k;
        EXPECT_LE(std::cbrt(cubes[k]), truth.upper * (1.0 + 2.0 * kRadialGap)) << k;
      }
      EXPECT_LE(n_open, 1 + n / 16);
      if (first.empty()) first = cubes;
      for (std::size_t k = 0; k < n; ++k) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(cubes[k]), std::bit_cast<std::uint64_t>(first[k])) << k;
      }
    }
  }
}

class CubesOfPairs : public testing::TestWithParam<NamedPair> {};

TEST_P(CubesOfPairs, AreThoseOfTheRadialFunctionAndTheSameBitsForEverySet) {
  expect_cubes(parse_shape(GetParam().a).body, parse_shape(GetParam().b).body);
}

INSTANTIATE_TEST_SUITE_P(Pairs, CubesOfPairs, testing::ValuesIn(unordered_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });

TEST(CubesOfTables, AreTheSame) {
  const ConvexBody hull = test_point_hull(300, {3, 2, 1}, 5).body;
  expect_cubes(hull, hull);
  expect_cubes(hull, parse_shape("rounded:0.2,box:1,1,1").body);
}

// Threads cut a run into other batches. Of vertices that tie, the table's two ways (lists that are read together, and
// long ones, read one after the other) must find the same, for a ray's neighbours decide which way is gone.
TEST(CubesOfTables, HangOnNoOtherRay) {
  std::vector<Vec3d> prism;
  for (int k = 0; k < 128; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 128;
    for (const double z : {-0.5, 0.5}) prism.push_back({std::cos(angle), std::sin(angle), z});
  }
  const ConvexBody body = Polytope(prism, {}, 0.4);
  const RadialMap map(body, body, {});
  const Rays rays = random_rays(map, PacketRays::kMostRays, 5);
  for (const InstructionSet set : instruction_sets()) {
    SCOPED_TRACE(name_of(set));
    const auto packets = make_packet_rays(ray_kernel(set), body, body, map.points());
    ASSERT_NE(packets, nullptr);
    const std::vector<double> together = cubes_of(*packets, rays);
    for (std::size_t k = 0; k < PacketRays::kMostRays; ++k) {
      const RayTable one{rays.table().columns + k, rays.table().stride, 1};
      RadialAnswers answers;
      packets->find(one, answers);
      EXPECT_EQ(std::bit_cast<std::uint64_t>(together[k]), std::bit_cast<std::uint64_t>(answers.cube[0])) << k;
    }
  }
}

// Of one ray, over picks that are spread evenly: the mean is the cube, though each value may be off by 3/256 of it.
TEST(Cubes, HaveTheRightMeanOverThePicks) {
  constexpr std::size_t kPicks = PacketRays::kMostRays;
  for (const auto& [text_a, text_b] : {std::pair{"ellipsoid:1,2,3", "ellipsoid:3,0.5,1"},
                                       {"capsule:1,0.25", "cone:1,1"},
                                       {"cylinder:1,0.5", "sphere:0.3"}}) {
    const ConvexBody a = parse_shape(text_a).body, b = parse_shape(text_b).body;
    const RadialMap map(a, b, {});
    const auto packets = make_packet_rays(ray_kernel(instruction_sets().back()), a, b, map.points());
    int n_picked = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const Rays rays = random_rays(map, kPicks, seed, true);
      for (std::size_t k = 0; k < kPicks; ++k) {
        rays.columns->rays[RayTable::kPick][k] = (static_cast<double>(k) + 0.5) / kPicks;
      }
      const std::vector<double> cubes = cubes_of(*packets, rays);
      double sum = 0.0;
      for (const double cube : cubes) sum += cube;
      if (cubes.front() != cubes.back()) ++n_picked;
      const RadialBounds truth = radial_function(a, b, map.points(), rays.table().rotation(0), rays.table().dir(0));
      const double r = 0.5 * (truth.lower + truth.upper), gap = 3.0 * 1.01 * kRadialGap * r * r * r;
      EXPECT_NEAR(sum / kPicks, r * r * r, 0.51 * gap / kPicks + 4.0 * kRadialRounding * r * r * r);
    }
    EXPECT_GT(n_picked, 20) << "or nothing was tested";
  }
}

// A K so thin that the search is lost near the end, or not, as the pick has it: what was put in the place of the lost
// ones without asking for their pick had a mean that was off by 3e-4.
TEST(Cubes, HaveTheRightMeanAlsoWhereThePickDecidesWhetherTheSearchIsLost) {
  constexpr std::size_t kPicks = PacketRays::kMostRays;
  const ConvexBody a = parse_shape("ellipsoid:1,1e-5,1e-5").body, b = parse_shape("sphere:1e-6").body;
  const RadialMap map(a, b, {});
  const auto packets = make_packet_rays(ray_kernel(instruction_sets().back()), a, b, map.points());
  std::size_t n_lost = 0;
  double sum_of_deviations = 0.0;
  constexpr int kRays = 200;
  for (std::uint64_t seed = 0; seed < kRays; ++seed) {
    const Rays rays = random_rays(map, kPicks, seed, true);
    const auto answers = std::make_unique<RadialAnswers>();
    for (std::size_t k = 0; k < kPicks; ++k) {
      rays.columns->rays[RayTable::kPick][k] = (static_cast<double>(k) + 0.5) / kPicks;
    }
    packets->find(rays.table(), *answers);
    const RadialBounds truth = radial_function(a, b, map.points(), rays.table().rotation(0), rays.table().dir(0));
    const double r = 0.5 * (truth.lower + truth.upper), r_cubed = r * r * r;
    double sum = 0.0;
    for (std::size_t k = 0; k < kPicks; ++k) {
      const bool is_open = std::isnan(answers->cube[k]);
      if (is_open && answers->outer[k] > 0.0) ++n_lost;
      sum += is_open ? answers->cube_of(k, rays.columns->rays[RayTable::kPick][k], r_cubed) : answers->cube[k];
    }
    sum_of_deviations += sum / kPicks / r_cubed - 1.0;
  }
  EXPECT_GT(n_lost, 100u) << "or nothing was tested";
  EXPECT_NEAR(sum_of_deviations / kRays, 0.0, 1e-5);
}

TEST(Cubes, OfNumbersThatAreNoneAreLeftOpen) {
  const ConvexBody a = parse_shape("ellipsoid:1,2,3").body;
  const RadialMap map(a, a, {});
  const Rays rays = random_rays(map, 32, 3);
  for (std::size_t c = 0; c < RayTable::kColumns; ++c) {
    if (c != RayTable::kPick) rays.columns->rays[c][c] = c % 2 == 0 ? std::nan("") : HUGE_VAL;
  }
  for (const InstructionSet set : instruction_sets()) {
    const auto packets = make_packet_rays(ray_kernel(set), a, a, map.points());
    const std::vector<double> cubes = cubes_of(*packets, rays);
    for (std::size_t k = 0; k < 12; ++k) EXPECT_TRUE(std::isnan(cubes[k])) << k;
    for (std::size_t k = RayTable::kColumns; k < 32; ++k) EXPECT_FALSE(std::isnan(cubes[k])) << k;
  }
}

TEST(MakePacketRays, HasNoneForABodyThatIsTooLarge) {
  const ConvexBody a = parse_shape("box:1,1,1").body;
  const ConvexBody huge = parse_shape("box:1,1,1", 1e100, kQueriedSizes).body;
  EXPECT_EQ(make_packet_rays(ray_kernel(instruction_sets().front()), a, huge, {}), nullptr);
}

}  // namespace
}  // namespace vex
