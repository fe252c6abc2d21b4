// A tree of the bodies of a cluster, each of the n^(n-2) trees as likely as any other.
#pragma once

#include <array>
#include <span>

#include "engine/sampling/virial/overlap_graph.h"

namespace vex {

class ClusterTree {
 public:
  struct Edge {
    int parent, leaf;
  };

  /// Of n bodies, 3 or more, by n - 2 coordinates of the unit cube.
  ClusterTree(int n, std::span<const double> point);

  /// Parents come before their leaves: the first edge's is the root.
  std::span<const Edge> edges() const { return {edges_.data(), n_edges_}; }
  /// The edges as overlaps.
  const OverlapGraph& graph() const { return graph_; }

 private:
  std::array<Edge, kMostClusterBodies> edges_{};
  std::size_t n_edges_;
  OverlapGraph graph_;
};

}  // namespace vex
