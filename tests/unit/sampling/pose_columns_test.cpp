#include "engine/sampling/pose_columns.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <memory>
#include <vector>

#include "engine/sampling/pose_map.h"
#include "shapes/any_shape.h"
#include "shapes/polytope.h"

namespace vex {
namespace {

bool same_bits(const Transformd& x, const Transformd& y) { return std::memcmp(&x, &y, sizeof x) == 0; }

TEST(PoseColumns, AreTheSamplersPosesBitForBit) {
  const ConvexBody a = parse_shape("box:1,2,3").body;
  const ConvexBody b = Polytope(std::vector<Vec3d>{{1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 1}}, {1.2, 0.2, 0.2}, 0.1);
  for (const OrientationLaw& law :
       {OrientationLaw::isotropic(), OrientationLaw::aligned(), OrientationLaw::fixed(1, 2, 3, 4),
        OrientationLaw::cone(30), OrientationLaw::onsager(5), OrientationLaw::onsager(1e-30)}) {
    for (const Domain& domain : {ball_domain(a, b), box_domain(a, b)}) {
      // An index that needs more than 32 bits, and a seed whose words differ.
      for (const std::uint64_t first : {std::uint64_t{0}, std::uint64_t{0xfffffff0}, std::uint64_t{1} << 40}) {
        const std::uint64_t seed = 0x123456789abcdef0;
        const PoseSampler sampler(a, b, seed, law, domain);
        const QuickVerdict quick(a, b, kDrawnRotationError);
        for (const InstructionSet set : instruction_sets()) {
          const DrawPoses draw = pose_kernel(set);
          ASSERT_EQ(draw == nullptr, set == InstructionSet::scalar);
          if (draw == nullptr) continue;
          for (const std::size_t n : {std::size_t{1}, std::size_t{7}, PacketOverlap::kMostTrials}) {
            const auto poses = std::make_unique<PoseColumns>();
            draw({seed, &law, &domain, b.centre(), &quick}, first, n, *poses);
            std::size_t n_open = 0;
            for (std::size_t k = 0; k < n; ++k) {
              const Transformd pose = sampler(first + k).a_from_b;
              ASSERT_TRUE(same_bits((PoseTable{poses->all[0], PoseColumns::kStride, n}.pose(k)), pose))
                  << law.name() << " " << name_of(set) << " " << first + k;
              const QuickVerdict::Answer<double> answer = quick(pose);
              ASSERT_EQ(poses->quick[k] == PacketAnswer::disjoint, answer.disjoint);
              ASSERT_EQ(poses->quick[k] == PacketAnswer::overlap, answer.overlap && !answer.disjoint);
              if (poses->quick[k] != PacketAnswer::open) continue;
              ASSERT_EQ(poses->open_index[n_open], static_cast<double>(k));
              ASSERT_TRUE(same_bits((PoseTable{poses->open[0], PoseColumns::kStride, n}.pose(n_open)), pose));
              ++n_open;
            }
            ASSERT_EQ(poses->n_open, n_open);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace vex
