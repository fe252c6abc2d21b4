#include "engine/sampling/virial/cluster_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

OverlapGraph graph_by_bits(int n, unsigned bits) {
  OverlapGraph graph(n);
  for (int i = 0, k = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j, ++k) {
      if ((bits >> k & 1u) != 0) graph.join(i, j);
    }
  }
  return graph;
}

TEST(ClusterWeights, OfThreeAndFourBodiesTheyAreTheKnownOnes) {
  EXPECT_DOUBLE_EQ(ClusterWeights(3).weight_of_chain(1), 4.0 / 3.0);
  EXPECT_EQ(ClusterWeights(3).weight_of_chain(0), 0.0);
  const ClusterWeights of_four(4);
  ASSERT_EQ(of_four.pairs().size(), 3u);
  std::uint32_t ring = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const BodyPair pair = of_four.pairs()[k];
    if (pair.i == 0 && pair.j == 3) ring = 1u << k;
  }
  for (std::uint32_t answers = 0; answers < 8; ++answers) {
    EXPECT_DOUBLE_EQ(of_four.weight_of_chain(answers), answers == 7 ? 2.0 : answers == ring ? -3.0 : 0.0);
  }
}

// A cluster that no chain and no tree is ever would be missing from the mean.
TEST(ClusterWeights, EveryClusterThatCountsIsDrawn) {
  for (int n = 3; n <= 6; ++n) {
    const ClusterWeights weights(n);
    const unsigned n_graphs = 1u << (n * (n - 1) / 2);
    int n_without_path = 0;
    for (unsigned bits = 0; bits < n_graphs; ++bits) {
      const OverlapGraph graph = graph_by_bits(n, bits);
      const std::int64_t sum = biconnected_sum(graph);
      if (sum == 0) continue;
      n_without_path += n_hamiltonian_paths(graph) == 0 ? 1 : 0;
      ASSERT_TRUE(std::isfinite(weights.weight(graph))) << n << " bodies, overlaps " << bits;
      ASSERT_LE(std::fabs(weights.weight(graph)), weights.largest_weight());
      ASSERT_LE(std::abs(sum), n_spanning_trees(graph));
    }
    EXPECT_EQ(n_without_path, n < 6 ? 0 : 15) << "two bodies that each of four others overlaps, and no other pair does";
  }
}

TEST(ClusterWeights, ByAChainTheyAreTheSameBits) {
  std::mt19937_64 random(8);
  int n_without_path = 0;
  for (int n = 3; n <= 8; ++n) {
    const ClusterWeights weights(n);
    const int n_pairs = n * (n - 1) / 2;
    for (unsigned k = 0; k < (n < 6 ? 1u << n_pairs : 500u); ++k) {
      const auto bits = static_cast<unsigned>(n < 6 ? k : (random() | random()) & ((1u << n_pairs) - 1u));
      const OverlapGraph graph = graph_by_bits(n, bits);
      const std::optional<HamiltonianPath> path = hamiltonian_path(graph);
      ASSERT_EQ(path.has_value(), n_hamiltonian_paths(graph) > 0) << n << " bodies, overlaps " << bits;
      n_without_path += path ? 0 : 1;
      for (std::size_t at = 1; path && at < static_cast<std::size_t>(n); ++at) {
        ASSERT_TRUE(graph.overlaps((*path)[at - 1], (*path)[at]));
      }
      ASSERT_EQ(weights.weight_by_chain(graph), weights.weight(graph)) << n << " bodies, overlaps " << bits;
    }
  }
  EXPECT_GT(n_without_path, 100);
}

TEST(ClusterWeights, WhatIsSkippedHasNoWeight) {
  for (int n = 3; n <= 6; ++n) {
    const ClusterWeights weights(n);
    const int n_pairs = static_cast<int>(weights.pairs().size());
    int n_skipped = 0;
    for (std::uint32_t answers = 0; answers < 1u << n_pairs; ++answers) {
      const bool counts = weights.weight_of_chain(answers) != 0.0;
      for (int n_asked = 0; n_asked <= n_pairs; ++n_asked) {
        const bool may = weights.may_count(n_asked, answers & ((1u << n_asked) - 1u));
        ASSERT_TRUE(may || !counts) << n << " bodies, answers " << answers << " of which " << n_asked;
        if (n_asked == n_pairs) {
          ASSERT_EQ(may, counts);
        }
        n_skipped += may ? 0 : 1;
      }
    }
    EXPECT_GT(n_skipped, 0);
  }
}

// Rods on a line, whose B_n / B2^(n-1) is 1 (L. Tonks, Phys. Rev. 50, 955, 1936): drawn here, by numbers of the
// standard library, from chains and, as often as the weights say, from stars and other trees.
double z_of_rods_on_a_line(const ClusterWeights& weights, int n_clusters) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const int n = weights.order();
  double sum = 0.0, sum_sq = 0.0;
  for (int c = 0; c < n_clusters; ++c) {
    std::array<double, kMostClusterBodies> x{};
    const auto at = [&x](int k) -> double& { return x[static_cast<std::size_t>(k)]; };
    if (unit(random) < weights.share_of_trees()) {
      // A random tree: the first one of a random walk through the complete graph to each body (A. Broder, FOCS 1989).
      unsigned seen = 1;
      for (int here = 0; seen + 1 != 1u << n;) {
        const int next = static_cast<int>(unit(random) * n);
        if (next == here) continue;
        if ((seen >> next & 1u) == 0) at(next) = at(here) + 2.0 * unit(random) - 1.0;
        seen |= 1u << next;
        here = next;
      }
    } else {
      for (int k = 1; k < n; ++k) at(k) = at(k - 1) + 2.0 * unit(random) - 1.0;
    }
    OverlapGraph graph(n);
    for (int i = 0; i < n; ++i) {
      for (int j = i + 1; j < n; ++j) {
        if (std::fabs(at(i) - at(j)) < 1.0) graph.join(i, j);
      }
    }
    const double weight = weights.weight(graph);
    sum += weight;
    sum_sq += weight * weight;
  }
  const double mean = sum / n_clusters;
  return (mean - 1.0) / std::sqrt((sum_sq / n_clusters - mean * mean) / n_clusters);
}

TEST(ClusterWeights, RodsOnALineHaveTheKnownCoefficients) {
  for (int n = 3; n <= 8; ++n) {
    EXPECT_LT(std::fabs(z_of_rods_on_a_line(ClusterWeights(n), n < 8 ? 40000 : 8000)), 4.5) << n;
  }
}

// What a slip would make of the sums: each has to be found out by the same test.
TEST(ClusterWeights, WrongSumsAreFoundOut) {
  const auto without_complete_graph = [](const OverlapGraph& graph) {
    bool is_complete = true;
    for (int i = 0; i < graph.n_bodies(); ++i)
      is_complete = is_complete && graph.neighbours(i) == (graph.all() & ~(1u << i));
    const int n_pairs = graph.n_bodies() * (graph.n_bodies() - 1) / 2;
    return biconnected_sum(graph) - (is_complete ? (n_pairs % 2 == 0 ? 1 : -1) : 0);
  };
  const auto too_large = [](const OverlapGraph& graph) { return 2 * biconnected_sum(graph); };
  for (int n = 4; n <= 6; ++n) {
    EXPECT_GT(std::fabs(z_of_rods_on_a_line(ClusterWeights(n, without_complete_graph), 80000)), 6.0) << n;
    EXPECT_GT(std::fabs(z_of_rods_on_a_line(ClusterWeights(n, too_large), 40000)), 6.0) << n;
  }
}

TEST(ClusterWeights, OfOtherOrdersThereAreNone) {
  EXPECT_THROW(ClusterWeights(2), UsageError);
  EXPECT_THROW(ClusterWeights(9), UsageError);
}

}  // namespace
}  // namespace vex
