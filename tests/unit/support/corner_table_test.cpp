#include "engine/support/corner_table.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "engine/support/combinators.h"
#include "shapes/any_shape.h"
#include "tests/referees/polytopes.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

TEST(CornerTable, KnowsTheNumberOfEachCornerAndOfNoOtherPoint) {
  const std::vector<Vec3d> corners{{0.0, 1.0, 2.0}, {-0.0, 1.0, -2.0}, {3.0, 1.0, 2.0}};
  const CornerTable table(corners);
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(table.number_of({0.0, 1.0, -2.0}), 1);
  EXPECT_EQ(table.number_of({-0.0, 1.0, 2.0}), 0);
  EXPECT_EQ(table.number_of({3.0, 1.0, 2.0}), 2);
  EXPECT_FALSE(table.number_of({3.0, 1.0, 2.0000000000000004}));
  EXPECT_FALSE(table.number_of({3.0, 1.0, std::numeric_limits<double>::quiet_NaN()}));
  const std::vector<Vec3d> equal(2, {1.0, 0.0, 0.0});
  EXPECT_EQ(CornerTable(equal).number_of(equal[1]), 0) << "the first of equal ones";
}

TEST(CornerTable, IsEmptyOfBodiesWithoutCornersAndOfTooMany) {
  EXPECT_EQ(CornerTable({}).size(), 0u);
  EXPECT_FALSE(CornerTable({}).number_of({}));
  const std::vector<Vec3d> most(CornerTable::kMost), too_many(CornerTable::kMost + 1);
  EXPECT_EQ(CornerTable(most).size(), CornerTable::kMost);
  EXPECT_EQ(CornerTable(too_many).size(), 0u);
  EXPECT_EQ(parse_shape("cylinder:1,0.5").body.corners().size(), 0u);
}

TEST(CornerTable, HasWhatTheSupportMappingOfACoreAnswers) {
  std::mt19937_64 random(3);
  for (const char* const name :
       {"box:1,2,3", "dodecahedron:0.5", "rounded:0.1,box:1,1,1", "plate:1,2", "capsule:1,0.25"}) {
    const ConvexBody body = parse_shape(name).body;
    for (int k = 0; k < 100; ++k) {
      const Vec3d corner = body.core_support(random_direction(random));
      const std::optional<std::uint16_t> number = body.corners().number_of(corner);
      ASSERT_TRUE(number) << name;
      EXPECT_EQ(norm_1(body.corners()[*number] - corner), 0.0) << name;
    }
  }
}

TEST(CornerTable, IsMadeOnceForSeveralThreads) {
  const ConvexBody body = test_point_hull(1000, {3, 2, 1}, 1).body, copy = body;
  std::vector<const CornerTable*> seen(4);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    threads.emplace_back([&, k] { seen[k] = &(k % 2 == 0 ? body : copy).corners(); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const CornerTable* one : seen) EXPECT_EQ(one, seen[0]);
}

}  // namespace
}  // namespace vex
