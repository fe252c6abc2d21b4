// What a cluster drawn by chains and trees of overlapping bodies counts for, and which pairs of its bodies need not be
// asked because it counts for nothing whatever they are.
//
// B_n = (1 - n) / n! * integral of the sum over biconnected graphs (biconnected_sum), over all places and orientations
// but the first body's. A chain 1-2-...-n whose neighbours are drawn from all poses at which they overlap has the
// density 1 / (2 B2)^(n-1) wherever its neighbours overlap. With each of the n! / 2 chains, or each of the n^(n-2)
// trees, as likely as any other, a cluster has the density
//   p = (share of chains * 2 Hamiltonian paths / n! + share of trees * spanning trees / n^(n-2)) / (2 B2)^(n-1),
// so B_n / B2^(n-1) is the mean of the weight (1 - n) 2^(n-1) / n! * sum / (p (2 B2)^(n-1)). Of three bodies it is 4/3
// where all overlap, of four 2 where all do and -3 for a ring without diagonals, as they should be.
//
// Chains are enough for up to five bodies. From six on there are biconnected graphs without a Hamiltonian path, such as
// two bodies apart that overlap each of four others, which are apart: no chain is ever such a cluster, and its part of
// B_n would be missing. So some of the clusters are trees.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/sampling/virial/overlap_graph.h"

namespace vex {

struct BodyPair {
  int i, j;
};

/// Of one order. Shared by threads: what is made on the way (tables) changes no bit of any answer.
class ClusterWeights {
 public:
  using GraphSum = std::int64_t (*)(const OverlapGraph&);

  static constexpr int kLeastOrder = 3, kMostOrder = kMostClusterBodies;

  /// Of `order` bodies, kLeastOrder to kMostOrder; any other is a UsageError. Another sum than that over the
  /// biconnected graphs is for tests, which have to find that it is wrong; it has to be 0 where the graph is not
  /// biconnected.
  explicit ClusterWeights(int order, GraphSum sum = biconnected_sum);

  int order() const { return order_; }
  /// Clusters are drawn in rounds of as many each, the first of them trees, the others chains: as many rounds of trees
  /// as the weights count with. Few rounds for small orders, of which clusters with common neighbours are too much
  /// alike.
  static int n_rounds(int order) { return order > 5 ? 8 : 4; }
  int n_rounds_of_trees() const { return order_ > 5 ? 1 : 0; }
  double share_of_trees() const { return static_cast<double>(n_rounds_of_trees()) / n_rounds(order_); }

  /// In units of B2^(n-1).
  double weight(const OverlapGraph& graph) const;
  /// No weight is larger, up or down: the sum over biconnected graphs is at most the number of spanning trees. (So it
  /// is for each graph of up to seven bodies, which was looked at; of eight for a million of random ones.)
  double largest_weight() const;

  /// Of the chain 0-1-2-...: all pairs but the neighbours, in the order in which they are asked.
  std::span<const BodyPair> pairs() const { return pairs_; }
  /// By the answers to all of them: bit k is set where pair k overlaps.
  double weight_of_chain(std::uint32_t answers) const;
  /// The same as `weight`, to the last bit: bodies in the order of a path through them are a chain, and the weight
  /// hangs on no order. Of a graph without such a path it is computed.
  double weight_by_chain(const OverlapGraph& graph) const;
  /// Whether a weight is possible, the first n_asked pairs being answered. Where not, it is not; of chains that are
  /// still to be asked many pairs it may say so although there is none.
  bool may_count(int n_asked, std::uint32_t answers) const;

 private:
  OverlapGraph chain(int n_asked, std::uint32_t answers) const;

  int order_;
  GraphSum sum_;
  double factor_, of_paths_, of_trees_;
  std::vector<BodyPair> pairs_;
  // By answers, NaN where not asked yet; and by 2^n_asked + answers: 0 where not asked yet, 1 no, 2 yes. Threads that
  // come to one entry at once write the same.
  std::unique_ptr<std::atomic<double>[]> weights_;
  std::unique_ptr<std::atomic<std::uint8_t>[]> may_count_;
};

}  // namespace vex
