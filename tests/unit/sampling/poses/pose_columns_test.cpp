#include "engine/sampling/poses/pose_columns.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/sampling/poses/pose_map.h"
#include "shapes/any_shape.h"
#include "shapes/box.h"
#include "shapes/ellipsoid.h"
#include "shapes/polytope.h"
#include "shapes/rounded.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

bool are_same_bits(const Transformd& x, const Transformd& y) { return std::memcmp(&x, &y, sizeof x) == 0; }

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
                    are_same_bits((PoseTable{columns->poses[0], PoseColumns::kStride, n}.pose(n_open)), trial.a_from_b))
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
          ASSERT_TRUE(are_same_bits(pose, trial.a_from_b)) << text_a << " " << text_b << " " << name_of(set);
          ++n_open;
        }
        ASSERT_EQ(columns->n_open, n_open);
      }
    }
  }
}

// Every trial of a fitted domain against the sampler's: the open ones' poses and shares, and the shares of the others.
void expect_fitted_trials_of_the_sampler(const ConvexBody& a, const ConvexBody& b, const OrientationLaw& law,
                                         bool with_quick_verdicts, std::uint64_t first, std::size_t n_batches) {
  const std::uint64_t seed = 0x123456789abcdef0;
  const Domain domain = fitted_domain(a, b);
  const PoseSampler sampler(a, b, seed, law, domain);
  const QuickVerdict verdicts(a, b, kDrawnRotationError);
  const QuickVerdict* const quick = with_quick_verdicts ? &verdicts : nullptr;
  for (const InstructionSet set : instruction_sets()) {
    if (set == InstructionSet::scalar) continue;
    FittedRecipe fitted(a, b, *sampler.fitted());
    const auto columns = std::make_unique<PoseColumns>();
    std::uint64_t index = first;
    for (std::size_t batch = 0; batch < n_batches; ++batch) {
      const std::array<std::size_t, 4> sizes = {PoseColumns::kMostTrials, 1, 7, 75};
      const std::size_t n = sizes[batch % sizes.size()];
      pose_kernel(set)({seed, &law, &domain, b.centre(), quick, &fitted}, index, n, *columns);
      std::size_t n_open = 0, n_disjoint = 0, n_overlap = 0;
      for (std::size_t k = 0; k < n; ++k) {
        const PosedTrial trial = sampler(index + k);
        if (quick != nullptr) {
          const QuickVerdict::Answer<double> answer = (*quick)(trial.a_from_b, trial.position);
          if (answer.disjoint) {
            ASSERT_EQ(columns->share_disjoint[n_disjoint++], trial.domain_share);
            continue;
          }
          if (answer.overlap) {
            ASSERT_EQ(columns->share_overlap[n_overlap++], trial.domain_share);
            continue;
          }
        }
        ASSERT_LT(n_open, columns->n_open);
        ASSERT_EQ(columns->row[n_open], k);
        ASSERT_EQ(columns->share[n_open], trial.domain_share) << law.name() << " " << name_of(set) << " " << index + k;
        ASSERT_TRUE(are_same_bits((PoseTable{columns->poses[0], PoseColumns::kStride, n}.pose(n_open)), trial.a_from_b))
            << law.name() << " " << name_of(set) << " " << index + k;
        ++n_open;
      }
      ASSERT_EQ(columns->n_open, n_open);
      ASSERT_EQ(columns->n_disjoint, n_disjoint);
      ASSERT_EQ(columns->n_overlap, n_overlap);
      index += n;
    }
  }
}

// Of each face as many vertices as a table's list should not have: of those that tie for its normal, any may be taken.
Polytope knobbly_cube(int n_across) {
  std::vector<Vec3d> points;
  for (int k = 0; k < n_across * n_across; ++k) {
    const double u = 2.0 * (k % n_across) / (n_across - 1) - 1.0, v = 2.0 * (k / n_across) / (n_across - 1) - 1.0;
    for (const double side : {-1.0, 1.0}) {
      for (const Vec3d& p : {Vec3d{side, u, v}, Vec3d{v, side, u}, Vec3d{u, v, side}}) points.push_back(p);
    }
  }
  return Polytope(points, {}, 1.0);
}

TEST(PoseColumnsFitted, AreTheSamplersTrialsBitForBit) {
  const ConvexBody a = parse_shape("box:1,0.3,0.01").body;
  const ConvexBody b = Polytope(std::vector<Vec3d>{{1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 1}}, {1.2, 0.2, 0.2}, 0.1);
  for (const OrientationLaw& law :
       {OrientationLaw::isotropic(), OrientationLaw::aligned(), OrientationLaw::fixed(1, 2, 3, 4),
        OrientationLaw::fixed(1, 1e-7, 0, 1e-200), OrientationLaw::cone(0), OrientationLaw::cone(30),
        OrientationLaw::onsager(5), OrientationLaw::onsager(1e-30)}) {
    for (const std::uint64_t first : {std::uint64_t{0}, std::uint64_t{0xfffffff0}, std::uint64_t{1} << 40}) {
      for (const bool with_quick_verdicts : {true, false}) {
        SCOPED_TRACE(law.name());
        expect_fitted_trials_of_the_sampler(a, b, law, with_quick_verdicts, first, 4);
        expect_fitted_trials_of_the_sampler(b, a, law, with_quick_verdicts, first, 4);
      }
    }
  }
}

TEST(PoseColumnsFitted, AreTheSamplersForEveryKindOfBody) {
  // Those that kernels know, symmetric or not, strips and needles among them; and those that are asked themselves.
  std::vector<std::pair<std::string, ConvexBody>> bodies;
  for (const char* text :
       {"box:1,2,3", "box:1,0.1,0.001", "plate:1,2", "needle:2", "sphere:0.6", "ellipsoid:4,1,2", "ellipsoid:1,1,1000",
        "capsule:2,0.001", "tetrahedron:1", "icosahedron:1", "cylinder:3,0.2", "cone:1,0.5", "frustum:1,2,0.3",
        "disc:1", "hemisphere:1", "rounded:0.1,tetrahedron:1", "rounded:0.2,capsule:1,0.1"}) {
    bodies.emplace_back(text, parse_shape(text).body);
  }
  bodies.emplace_back("rounded box", Rounded<Box>(Box(1, 2, 0.01), Box(1, 2, 0.01).measures(), 0.1));
  bodies.emplace_back("rounded ellipsoid", Rounded<Ellipsoid>(Ellipsoid(1, 2, 3), Ellipsoid(1, 2, 3).measures(), 0.1));
  bodies.emplace_back(
      "box of eight vertices elsewhere",
      Polytope(
          std::vector<Vec3d>{{3, 0, 0}, {4, 0, 0}, {3, 1, 0}, {4, 1, 0}, {3, 0, 2}, {4, 0, 2}, {3, 1, 2}, {4, 1, 2}},
          {3.5, 0.5, 1.0}, 0.5));
  bodies.emplace_back("cube with few vertices on its faces", knobbly_cube(4));
  bodies.emplace_back("cube with many", knobbly_cube(9));
  bodies.emplace_back("hull of 300 points", test_point_hull(300, {3, 2, 1}, 1).body);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (const std::size_t j : {i, std::size_t{0}, std::size_t{1}, bodies.size() - 1}) {
      for (const auto& [first, second] : {std::pair(i, j), std::pair(j, i)}) {
        const auto& [name_a, a] = bodies[first];
        const auto& [name_b, b] = bodies[second];
        SCOPED_TRACE(name_a + " and " + name_b);
        expect_fitted_trials_of_the_sampler(a, b, OrientationLaw::isotropic(), true, 0, 3);
        expect_fitted_trials_of_the_sampler(a, b, OrientationLaw::cone(0), true, 0, 2);
        if (HasFatalFailure()) return;
        if (i == j) break;
      }
    }
  }
}

}  // namespace
}  // namespace vex
