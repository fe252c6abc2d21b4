#include "engine/sampling/points/random_stream.h"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace vex {
namespace {

TEST(RandomStream, PhiloxGivesTheKnownAnswers) {
  // Random123's own vectors (kat_vectors, philox4x32 10): counter, key, result.
  r123::Philox4x32 philox;
  const r123::Philox4x32::ctr_type zeros = philox({{0, 0, 0, 0}}, {{0, 0}});
  EXPECT_EQ(zeros[0], 0x6627e8d5u);
  EXPECT_EQ(zeros[1], 0xe169c58du);
  EXPECT_EQ(zeros[2], 0xbc57ac4cu);
  EXPECT_EQ(zeros[3], 0x9b00dbd8u);
  const r123::Philox4x32::ctr_type pi =
      philox({{0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}}, {{0xa4093822u, 0x299f31d0u}});
  EXPECT_EQ(pi[0], 0xd16cfe09u);
  EXPECT_EQ(pi[1], 0x94fdccebu);
  EXPECT_EQ(pi[2], 0x5001e420u);
  EXPECT_EQ(pi[3], 0x24126ea1u);
}

TEST(RandomStream, FirstCoordinateIsMadeOfTheFirstTwoWords) {
  double u = 0.0;
  draw_unit_cube(0, Stream::pose, 0, {&u, 1});
  const std::uint64_t words = (std::uint64_t{0xe169c58du} << 32) | 0x6627e8d5u;
  EXPECT_EQ(u, (static_cast<double>(words >> 12) + 0.5) * 0x1p-52);
}

TEST(RandomStream, IsAFunctionOfSeedAndIndexAlone) {
  std::vector<double> forward(6), again(6);
  draw_unit_cube(5, Stream::pose, 123456789012345ull, forward);
  draw_unit_cube(5, Stream::pose, 1, again);
  draw_unit_cube(5, Stream::pose, 123456789012345ull, again);
  EXPECT_EQ(forward, again);
  std::vector<double> longer(9);
  draw_unit_cube(5, Stream::pose, 123456789012345ull, longer);
  EXPECT_TRUE(std::equal(forward.begin(), forward.end(), longer.begin())) << "more coordinates do not change the first";
}

TEST(RandomStream, SeedsAndIndicesOfAllSixtyFourBitsMatter) {
  std::set<double> seen;
  for (const std::uint64_t x : {0ull, 1ull, 1ull << 31, 1ull << 32, 1ull << 63, ~0ull}) {
    double u = 0.0;
    draw_unit_cube(x, Stream::pose, 7, {&u, 1});
    seen.insert(u);
    draw_unit_cube(7, Stream::pose, x, {&u, 1});
    seen.insert(u);
  }
  EXPECT_EQ(seen.size(), 12u);
}

TEST(RandomStream, CoordinatesAreUniformAndUncorrelated) {
  constexpr int n = 200000, d = 6;
  std::array<double, d> sum{}, sum_sq{};
  std::array<double, d> with_next{};
  for (int i = 0; i < n; ++i) {
    std::array<double, d> u;
    draw_unit_cube(1, Stream::pose, static_cast<std::uint64_t>(i), u);
    for (std::size_t k = 0; k < d; ++k) {
      ASSERT_GT(u[k], 0.0);
      ASSERT_LT(u[k], 1.0);
      sum[k] += u[k];
      sum_sq[k] += u[k] * u[k];
      with_next[k] += (u[k] - 0.5) * (u[(k + 1) % d] - 0.5);
    }
  }
  // Standard errors of the mean of u, u^2 and of a product of two centred ones: sqrt(1/12), sqrt(4/45), 1/12.
  for (std::size_t k = 0; k < d; ++k) {
    EXPECT_NEAR(sum[k] / n, 0.5, 4.5 * std::sqrt(1.0 / 12 / n));
    EXPECT_NEAR(sum_sq[k] / n, 1.0 / 3, 4.5 * std::sqrt(4.0 / 45 / n));
    EXPECT_NEAR(with_next[k] / n, 0.0, 4.5 / 12 / std::sqrt(n));
  }
}

}  // namespace
}  // namespace vex
