#include "engine/sampling/virial/cluster_tree.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <vector>

namespace vex {
namespace {

// By A. Cayley there are n^(n-2) trees, and Pruefer's codes are as many.
TEST(ClusterTree, EachTreeIsMadeByOneCode) {
  for (const int n : {3, 4, 5}) {
    int n_codes = 1;
    for (int k = 0; k + 2 < n; ++k) n_codes *= n;
    std::map<std::vector<unsigned>, int> seen;
    for (int code = 0; code < n_codes; ++code) {
      std::array<double, kMostClusterBodies> point{};
      int rest = code;
      for (int k = 0; k + 2 < n; ++k, rest /= n) point[static_cast<std::size_t>(k)] = (rest % n + 0.5) / n;
      const ClusterTree tree(n, point);
      std::vector<unsigned> neighbours;
      for (int k = 0; k < n; ++k) neighbours.push_back(tree.graph().neighbours(k));
      ++seen[neighbours];
      EXPECT_EQ(n_spanning_trees(tree.graph()), 1);
      // Every body is placed once, after its parent.
      ASSERT_EQ(tree.edges().size(), static_cast<std::size_t>(n) - 1);
      unsigned placed = 1u << tree.edges().front().parent;
      for (const ClusterTree::Edge& edge : tree.edges()) {
        EXPECT_NE(placed >> edge.parent & 1u, 0u);
        EXPECT_EQ(placed >> edge.leaf & 1u, 0u);
        EXPECT_TRUE(tree.graph().overlaps(edge.parent, edge.leaf));
        placed |= 1u << edge.leaf;
      }
      EXPECT_EQ(placed, tree.graph().all());
    }
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(n_codes));
  }
}

}  // namespace
}  // namespace vex
