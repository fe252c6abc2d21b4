#include "engine/sampling/virial/overlap_graph.h"

#include <gtest/gtest.h>

#include <bit>
#include <utility>
#include <vector>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

std::vector<std::pair<int, int>> pairs_of(int n) {
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) pairs.emplace_back(i, j);
  }
  return pairs;
}

OverlapGraph graph_of(int n, unsigned bits) {
  OverlapGraph graph(n);
  const auto pairs = pairs_of(n);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if ((bits >> k & 1u) != 0) graph.join(pairs[k].first, pairs[k].second);
  }
  return graph;
}

// By what the word says, with no algorithm of the library: every two bodies are in one piece, with all bodies and
// without any one.
bool is_in_one_piece(const OverlapGraph& graph, int without) {
  std::vector<int> piece(static_cast<std::size_t>(graph.n_bodies()));
  for (int i = 0; i < graph.n_bodies(); ++i) piece[static_cast<std::size_t>(i)] = i;
  for (int round = 0; round < graph.n_bodies(); ++round) {
    for (int i = 0; i < graph.n_bodies(); ++i) {
      for (int j = 0; j < graph.n_bodies(); ++j) {
        if (i == without || j == without || i == j || !graph.overlaps(i, j)) continue;
        const int least = std::min(piece[static_cast<std::size_t>(i)], piece[static_cast<std::size_t>(j)]);
        piece[static_cast<std::size_t>(i)] = piece[static_cast<std::size_t>(j)] = least;
      }
    }
  }
  int first = -1;
  for (int i = 0; i < graph.n_bodies(); ++i) {
    if (i == without) continue;
    if (first >= 0 && piece[static_cast<std::size_t>(i)] != first) return false;
    first = piece[static_cast<std::size_t>(i)];
  }
  return true;
}
bool is_biconnected_by_definition(const OverlapGraph& graph) {
  if (!is_in_one_piece(graph, -1)) return false;
  for (int body = 0; body < graph.n_bodies() && graph.n_bodies() > 2; ++body) {
    if (!is_in_one_piece(graph, body)) return false;
  }
  return true;
}

// Every set of overlaps of every graph looked at.
TEST(OverlapGraph, TheRecursionIsTheSumOverAllBiconnectedGraphs) {
  for (int n = 2; n <= 6; ++n) {
    const unsigned n_graphs = 1u << pairs_of(n).size();
    std::vector<char> is_good(n_graphs);
    for (unsigned bits = 0; bits < n_graphs; ++bits) is_good[bits] = is_biconnected_by_definition(graph_of(n, bits));
    for (unsigned bits = 0; bits < n_graphs; ++bits) {
      std::int64_t sum = 0;
      for (unsigned part = bits;; part = (part - 1) & bits) {
        if (is_good[part]) sum += std::popcount(part) % 2 == 0 ? 1 : -1;
        if (part == 0) break;
      }
      ASSERT_EQ(biconnected_sum(graph_of(n, bits)), sum) << n << " bodies, overlaps " << bits;
      ASSERT_EQ(is_biconnected(graph_of(n, bits)), is_good[bits] != 0) << n << " bodies, overlaps " << bits;
    }
  }
}

TEST(OverlapGraph, OfCompleteGraphsTheSumIsAFactorial) {
  std::int64_t factorial = 1;  // (n - 2)!
  for (int n = 2; n <= kMostClusterBodies; ++n) {
    factorial *= std::max(1, n - 2);
    const auto pairs = pairs_of(n);
    const OverlapGraph graph = graph_of(n, static_cast<unsigned>((std::uint64_t{1} << pairs.size()) - 1));
    EXPECT_EQ(std::abs(biconnected_sum(graph)), factorial) << n;
    if (n <= 4) {
      EXPECT_EQ(biconnected_sum(graph), n == 4 ? -2 : -1);
    }
    std::int64_t trees = 1, paths = 1;
    for (int k = 0; k < n - 2; ++k) trees *= n;
    for (int k = 3; k <= n; ++k) paths *= k;
    EXPECT_EQ(n_spanning_trees(graph), trees);
    EXPECT_EQ(n_hamiltonian_paths(graph), paths);
  }
}

// Of every graph of five bodies: each set of four overlaps that is a tree, and those in which no body has three.
TEST(OverlapGraph, TreesAndPathsAreCounted) {
  constexpr int kN = 5;
  const unsigned n_graphs = 1u << pairs_of(kN).size();
  for (unsigned bits = 0; bits < n_graphs; ++bits) {
    std::int64_t n_trees = 0, n_paths = 0;
    for (unsigned part = bits;; part = (part - 1) & bits) {
      if (std::popcount(part) == kN - 1) {
        const OverlapGraph tree = graph_of(kN, part);
        bool is_path = true;
        for (int i = 0; i < kN; ++i) is_path = is_path && std::popcount(tree.neighbours(i)) <= 2;
        const bool is_tree = is_in_one_piece(tree, -1);
        n_trees += is_tree ? 1 : 0;
        n_paths += is_tree && is_path ? 1 : 0;
      }
      if (part == 0) break;
    }
    ASSERT_EQ(n_spanning_trees(graph_of(kN, bits)), n_trees) << bits;
    ASSERT_EQ(n_hamiltonian_paths(graph_of(kN, bits)), n_paths) << bits;
  }
}

TEST(OverlapGraph, PartingUndoesJoining) {
  OverlapGraph graph(4);
  graph.join(3, 1);
  EXPECT_TRUE(graph.overlaps(1, 3));
  graph.part(1, 3);
  EXPECT_FALSE(graph.overlaps(3, 1));
  EXPECT_EQ(graph.neighbours(3), 0u);
}

TEST(OverlapGraph, OfNoBodiesOrTooManyThereIsNone) {
  EXPECT_THROW(OverlapGraph(0), UsageError);
  EXPECT_THROW(OverlapGraph(9), UsageError);
}

}  // namespace
}  // namespace vex
