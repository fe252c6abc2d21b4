#include "engine/support/lazy_direction_map.h"

#include <gtest/gtest.h>

#include <random>
#include <thread>
#include <vector>

#include "shapes/polytope.h"
#include "tests/referees/array_lanes.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

TEST(LazyDirectionMap, IsMadeByTheCallThatPays) {
  const std::vector<Vec3d> vertices = test_point_hull(200, {3, 2, 1}, 1).vertices;
  const Polytope body(vertices, {}, 0.0);
  const Polytope copy = body;
  for (std::size_t k = 0; k < LazyDirectionMap::kCallsThatPay; ++k) body.support(Vec3d{1.0, 0.0, 0.0});
  EXPECT_EQ(body.direction_map(), nullptr);
  copy.support(Vec3d{1.0, 0.0, 0.0});
  EXPECT_NE(body.direction_map(), nullptr);
  EXPECT_EQ(copy.direction_map(), body.direction_map()) << "copies share it";
}

TEST(LazyDirectionMap, BodiesOfFewVerticesHaveNone) {
  const Polytope body(test_point_hull(static_cast<int>(kMostScannedVertices), {3, 2, 1}, 1).vertices, {}, 0.0);
  for (std::size_t k = 0; k < 2 * LazyDirectionMap::kCallsThatPay; ++k) body.support(Vec3d{1.0, 0.0, 0.0});
  EXPECT_EQ(body.direction_map(), nullptr);
}

TEST(LazyDirectionMap, IsMadeAtOnceForWhoeverAsksForTheTable) {
  const std::vector<Vec3d> vertices = test_point_hull(200, {3, 2, 1}, 1).vertices;
  const Polytope body(vertices, {}, 0.0);
  std::vector<const DirectionTable::Vertex*> seen(4);
  std::vector<std::thread> threads;
  for (auto& one : seen) threads.emplace_back([&] { one = body.direction_table().value().vertices; });
  for (std::thread& thread : threads) thread.join();
  for (const auto* one : seen) EXPECT_EQ(one, seen[0]) << "there is one table";
  EXPECT_NE(body.direction_map(), nullptr);
}

TEST(LazyDirectionMap, NoAnswerDependsOnWhenItIsMade) {
  const std::vector<Vec3d> vertices = test_point_hull(500, {3, 2, 1}, 2).vertices;
  const Polytope asked(vertices, {}, 0.0);
  for (std::size_t k = 0; k <= LazyDirectionMap::kCallsThatPay; ++k) asked.support(Vec3d{1.0, 0.0, 0.0});
  ASSERT_NE(asked.direction_map(), nullptr);
  constexpr int kWidth = 4;
  std::mt19937_64 random(3);
  for (int k = 0; k < 1000; ++k) {
    const Polytope fresh(vertices, {}, 0.0);
    // In every second packet one direction is none that the table takes.
    Vec3<ArrayLanes<kWidth>> packet;
    std::vector<Vec3d> expected;
    for (std::size_t lane = 0; lane < std::size_t{kWidth}; ++lane) {
      Vec3d dir = random_direction(random);
      if (lane == 2 && k % 2 == 0) dir = k % 4 == 0 ? Vec3d{} : 1e-200 * dir;
      set_lane(packet, lane, dir);
      expected.push_back(fresh.support(dir));
      const Vec3d found = asked.support(dir);
      EXPECT_TRUE(found.x == expected.back().x && found.y == expected.back().y && found.z == expected.back().z);
    }
    const Vec3<ArrayLanes<kWidth>> found = asked.support(packet);
    for (std::size_t lane = 0; lane < std::size_t{kWidth}; ++lane) {
      EXPECT_TRUE(found.x.lane[lane] == expected[lane].x && found.y.lane[lane] == expected[lane].y &&
                  found.z.lane[lane] == expected[lane].z);
    }
  }
}

TEST(LazyDirectionMap, ThreadsMayAskOneBody) {
  const std::vector<Vec3d> vertices = test_point_hull(2000, {3, 2, 1}, 4).vertices;
  const Polytope shared(vertices, {}, 0.0);
  const std::size_t n_calls = 2 * LazyDirectionMap::kCallsThatPay;
  const auto sum_of_answers = [n_calls](const Polytope& body) {
    std::mt19937_64 random(5);
    double sum = 0.0;
    for (std::size_t k = 0; k < n_calls; ++k) sum += body.support(random_direction(random)).x;
    return sum;
  };
  std::vector<double> sums(4);
  std::vector<std::thread> threads;
  for (double& sum : sums) threads.emplace_back([&] { sum = sum_of_answers(shared); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_NE(shared.direction_map(), nullptr);
  const double expected = sum_of_answers(Polytope(vertices, {}, 0.0));
  for (const double sum : sums) EXPECT_EQ(sum, expected);
}

}  // namespace
}  // namespace vex
