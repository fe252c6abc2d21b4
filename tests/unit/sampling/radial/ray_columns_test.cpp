#include "engine/sampling/radial/ray_columns.h"

#include <gtest/gtest.h>

#include <bit>
#include <memory>
#include <random>
#include <string>
#include <utility>

#include "shapes/any_shape.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

class RayColumnsOfPairs : public testing::TestWithParam<std::pair<const char*, const char*>> {};
INSTANTIATE_TEST_SUITE_P(Pairs, RayColumnsOfPairs,
                         testing::Values(std::pair{"cone:1,1", "box:64,1,0.5"}, std::pair{"box:1,1,1", "tetrahedron:1"},
                                         std::pair{"box:64,1,1", "capsule:4,0.5"}, std::pair{"disc:1", "box:9,1,1"},
                                         std::pair{"tetrahedron:1", "needle:1"}),
                         [](const auto& pair) { return "Pair" + std::to_string(pair.index); });

TEST_P(RayColumnsOfPairs, OfEverySetAreBitForBitTheRaysOfTheMap) {
  const ConvexBody a = parse_shape(GetParam().first).body, b = parse_shape(GetParam().second).body;
  const auto columns = std::make_unique<RayColumns>();
  for (const OrientationLaw& law :
       {OrientationLaw::isotropic(), OrientationLaw::aligned(), OrientationLaw::fixed(1, 2, 3, 4),
        OrientationLaw::cone(30.0), OrientationLaw::onsager(4.0)}) {
    const RadialMap map(a, b, law);
    const auto dimension = static_cast<std::size_t>(map.dimension());
    for (const InstructionSet set : instruction_sets()) {
      SCOPED_TRACE(law.name() + " " + std::string(name_of(set)));
      for (const std::size_t n : {std::size_t{1}, std::size_t{13}, PacketRays::kMostRays}) {
        std::mt19937_64 random(n);
        for (std::size_t c = 0; c < dimension; ++c) {
          for (std::size_t k = 0; k < n; ++k) columns->coordinates[c][k] = random_in_unit_interval(random);
        }
        ray_maker(set)(map, n, *columns);
        const RayTable table = columns->table(n);
        for (std::size_t k = 0; k < n; ++k) {
          std::array<double, RadialMap::kMaxDimension> point{};
          for (std::size_t c = 0; c < dimension; ++c) point[c] = columns->coordinates[c][k];
          const RadialRay<double> ray = map(std::span<const double>(point).first(dimension));
          const auto expect_same = [&](const Vec3d& found, const Vec3d& truth) {
            EXPECT_EQ(std::bit_cast<std::uint64_t>(found.x), std::bit_cast<std::uint64_t>(truth.x));
            EXPECT_EQ(std::bit_cast<std::uint64_t>(found.y), std::bit_cast<std::uint64_t>(truth.y));
            EXPECT_EQ(std::bit_cast<std::uint64_t>(found.z), std::bit_cast<std::uint64_t>(truth.z));
          };
          const Transformd rotation = table.rotation(k);
          expect_same(rotation.row_x, ray.rotation.row_x);
          expect_same(rotation.row_y, ray.rotation.row_y);
          expect_same(rotation.row_z, ray.rotation.row_z);
          expect_same(table.dir(k), ray.dir);
          for (std::size_t j = 0; j < 3; ++j) expect_same(table.at(RayTable::kNormals + 3 * j, k), ray.normals[j]);
          EXPECT_EQ(columns->rays[RayTable::kPick][k], ray.pick);
          EXPECT_EQ(columns->weights[k], ray.weight);
        }
      }
    }
  }
}

}  // namespace
}  // namespace vex
