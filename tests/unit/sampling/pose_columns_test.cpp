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
        const QuickVerdict verdicts(a, b, kDrawnRotationError);
        for (const InstructionSet set : instruction_sets()) {
          const DrawPoses draw = pose_kernel(set);
          ASSERT_EQ(draw == nullptr, set == InstructionSet::scalar);
          if (draw == nullptr) continue;
          for (const QuickVerdict* quick : {&verdicts, static_cast<const QuickVerdict*>(nullptr)}) {
            // Numbers that fill no packet, too; and in columns that hold what other trials left there.
            const auto columns = std::make_unique<PoseColumns>();
            for (const std::size_t n : {PoseColumns::kMostTrials, std::size_t{1}, std::size_t{7}, std::size_t{75}}) {
              draw({seed, &law, &domain, b.centre(), quick}, first, n, *columns);
              std::size_t n_open = 0, n_disjoint = 0, n_overlap = 0;
              for (std::size_t k = 0; k < n; ++k) {
                const PosedTrial trial = sampler(first + k);
                if (quick != nullptr) {
                  const QuickVerdict::Answer<double> answer = (*quick)(trial.a_from_b, trial.position);
                  n_disjoint += answer.disjoint ? 1u : 0u;
                  n_overlap += answer.overlap ? 1u : 0u;
                  if (answer.disjoint || answer.overlap) continue;
                }
                ASSERT_LT(n_open, columns->n_open);
                ASSERT_EQ(columns->row[n_open], k);
                ASSERT_TRUE(
                    same_bits((PoseTable{columns->poses[0], PoseColumns::kStride, n}.pose(n_open)), trial.a_from_b))
                    << law.name() << " " << name_of(set) << " " << first + k;
                ++n_open;
              }
              ASSERT_EQ(columns->n_open, n_open);
              ASSERT_EQ(columns->n_disjoint, n_disjoint);
              ASSERT_EQ(columns->n_overlap, n_overlap);
            }
          }
        }
      }
    }
  }
}

TEST(PoseColumns, AreTheSamplersForEveryKindOfBound) {
  // Bodies that are bounds of themselves, and others; at their frames' origins, where no turned centre is taken off.
  const std::vector<const char*> texts = {"box:1,2,3",   "box:1e-6,1,1",  "ellipsoid:4,1,2", "sphere:0.6",
                                          "capsule:2,1", "tetrahedron:1", "cylinder:3,0.2",  "rounded:0.1,needle:2"};
  for (const char* text_a : texts) {
    for (const char* text_b : texts) {
      const ConvexBody a = parse_shape(text_a).body, b = parse_shape(text_b).body;
      const OrientationLaw law;
      const Domain domain = best_domain(a, b);
      const PoseSampler sampler(a, b, 3, law, domain);
      const QuickVerdict quick(a, b, kDrawnRotationError);
      for (const InstructionSet set : instruction_sets()) {
        if (set == InstructionSet::scalar) continue;
        const auto columns = std::make_unique<PoseColumns>();
        pose_kernel(set)({3, &law, &domain, b.centre(), &quick}, 0, PoseColumns::kMostTrials, *columns);
        std::size_t n_open = 0;
        for (std::size_t k = 0; k < PoseColumns::kMostTrials; ++k) {
          const PosedTrial trial = sampler(k);
          const QuickVerdict::Answer<double> answer = quick(trial.a_from_b, trial.position);
          if (answer.disjoint || answer.overlap) continue;
          ASSERT_EQ(columns->row[n_open], k) << text_a << " " << text_b << " " << name_of(set);
          const Transformd pose = PoseTable{columns->poses[0], PoseColumns::kStride, 256}.pose(n_open);
          ASSERT_TRUE(same_bits(pose, trial.a_from_b)) << text_a << " " << text_b << " " << name_of(set);
          ++n_open;
        }
        ASSERT_EQ(columns->n_open, n_open);
      }
    }
  }
}

}  // namespace
}  // namespace vex
