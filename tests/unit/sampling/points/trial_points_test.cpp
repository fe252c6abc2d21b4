#include "engine/sampling/points/trial_points.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "engine/sampling/points/random_stream.h"

namespace vex {
namespace {

std::vector<double> one(const TrialPoints& points, std::uint64_t index) {
  std::vector<double> point(static_cast<std::size_t>(points.dimension()));
  points.one(index, point);
  return point;
}

TEST(TrialPoints, OfARandomSequenceAreTheStreamsOwn) {
  const TrialPoints points(5, Sequence::random, 6);
  std::array<double, 6> drawn;
  draw_unit_cube(5, Stream::pose, 1234567, drawn);
  EXPECT_EQ(one(points, 1234567), std::vector<double>(drawn.begin(), drawn.end()));
  EXPECT_EQ(points.n_classes(), 1u);
}

// Bit for bit, for every set, from any trial on, for any number of them, across the blocks of the higher bits.
TEST(TrialPoints, OfManyTrialsAreThoseOneByOne) {
  for (const InstructionSet set : instruction_sets()) {
    for (const Sequence sequence : {Sequence::random, Sequence::sobol}) {
      for (const bool stratified : {false, true}) {
        for (const int dimension : {1, 2, 3, 6, 8}) {
          const std::optional<Strata> strata =
              stratified && dimension > 2 ? std::optional(Strata{2, 0.25}) : std::nullopt;
          const TrialPoints points(7, sequence, dimension, strata, set);
          for (const std::uint64_t first : {0ull, 5ull, 31ull, 32ull * 250ull, 32ull * ((1ull << 31) - 3ull) + 7ull}) {
            for (const std::size_t n : {1u, 3u, 24u, 255u, 300u}) {
              const std::size_t stride = n + TrialPoints::kSpare;
              std::vector<double> columns(static_cast<std::size_t>(dimension + 1) * stride);
              points.many(first, n, columns.data(), stride);
              for (std::size_t k = 0; k < n; ++k) {
                const std::vector<double> point = one(points, first + k * points.n_classes());
                for (std::size_t c = 0; c < point.size(); ++c) {
                  ASSERT_EQ(columns[c * stride + k], point[c])
                      << name_of(set) << " " << name_of(sequence) << ", trial " << first << " + " << k;
                }
              }
            }
          }
        }
      }
    }
  }
}

TEST(TrialPoints, OfEachClassHaveAScramblingOfTheirOwn) {
  const TrialPoints points(1, Sequence::sobol, 3);
  EXPECT_EQ(points.n_classes(), kClasses);
  const SobolPoints net(3);
  for (std::uint64_t index : {0ull, 1ull, 31ull, 32ull, 1000003ull}) {
    std::vector<double> point(3);
    net.scrambled(net.scrambling(1, index % kClasses), index / kClasses, point);
    EXPECT_EQ(one(points, index), point);
  }
}

TEST(TrialPoints, OfAStratumStayInIt) {
  const double from = 0.3;
  const TrialPoints strata(3, Sequence::random, 4, Strata{2, from}), between(3, Sequence::sobol, 4, Strata{2, from});
  double least = 1.0, most = 0.0;
  for (std::uint64_t index = 0; index < 3200; ++index) {
    const double share = (one(strata, index)[2] - from) / (1.0 - from) * static_cast<double>(kClasses);
    EXPECT_GE(share, static_cast<double>(index % kClasses) - 1e-12);
    EXPECT_LE(share, static_cast<double>(index % kClasses) + 1.0 + 1e-12);
    const double other = one(between, index)[2];
    least = std::min(least, other), most = std::max(most, other);
    EXPECT_EQ(one(strata, index)[1], one(TrialPoints(3, Sequence::random, 4), index)[1]) << "only one coordinate";
  }
  EXPECT_NEAR(least, from, 0.01);
  EXPECT_NEAR(most, 1.0, 0.01);
}

}  // namespace
}  // namespace vex
