#include "engine/sampling/virial/cluster_weights.h"

#include <cmath>
#include <limits>
#include <string>

#include "engine/numeric/errors.h"

namespace vex {

ClusterWeights::ClusterWeights(int order, GraphSum sum) : order_(order), sum_(sum) {
  if (order < kLeastOrder || order > kMostOrder) {
    throw UsageError("no virial coefficients of this order (" + std::to_string(order) + ") - give one from " +
                     std::to_string(kLeastOrder) + " to " + std::to_string(kMostOrder));
  }
  double factorial = 1.0, trees = 1.0, power = 1.0;
  for (int k = 2; k <= order; ++k) {
    factorial *= k;
    power *= 2.0;
    if (k < order) trees *= order;
  }
  factor_ = (1 - order) * power / factorial;
  of_paths_ = (1.0 - share_of_trees()) * 2.0 / factorial;
  of_trees_ = share_of_trees() / trees;
  // Those of one end come first, then those of the other: half of all chains end here.
  for (int j = 2; j < order; ++j) pairs_.push_back({0, j});
  for (int i = order - 3; i > 0; --i) pairs_.push_back({i, order - 1});
  for (int i = 1; i < order - 1; ++i) {
    for (int j = i + 2; j < order - 1; ++j) pairs_.push_back({i, j});
  }
  const std::size_t n_answers = std::size_t{1} << pairs_.size();
  weights_ = std::make_unique<std::atomic<double>[]>(n_answers);
  for (std::size_t k = 0; k < n_answers; ++k) {
    weights_[k].store(std::numeric_limits<double>::quiet_NaN(), std::memory_order_relaxed);
  }
  may_count_ = std::make_unique<std::atomic<std::uint8_t>[]>(2 * n_answers);
}

double ClusterWeights::weight(const OverlapGraph& graph) const {
  const auto sum = static_cast<double>(sum_(graph));
  if (sum == 0.0) return 0.0;
  double density = of_paths_ * static_cast<double>(n_hamiltonian_paths(graph));
  if (of_trees_ > 0.0) density += of_trees_ * static_cast<double>(n_spanning_trees(graph));
  return factor_ * sum / density;
}

double ClusterWeights::largest_weight() const {
  if (of_trees_ > 0.0) return std::fabs(factor_) / of_trees_;
  double largest = 0.0;
  for (std::uint32_t answers = 0; answers < 1u << pairs_.size(); ++answers) {
    largest = std::fmax(largest, std::fabs(weight_of_chain(answers)));
  }
  return largest;
}

// With pairs that are not asked yet taken for overlaps.
OverlapGraph ClusterWeights::chain(int n_asked, std::uint32_t answers) const {
  OverlapGraph graph(order_);
  for (int k = 1; k < order_; ++k) graph.join(k - 1, k);
  for (int k = 0; k < static_cast<int>(pairs_.size()); ++k) {
    const BodyPair& pair = pairs_[static_cast<std::size_t>(k)];
    if (k >= n_asked || (answers >> k & 1u) != 0) graph.join(pair.i, pair.j);
  }
  return graph;
}

double ClusterWeights::weight_of_chain(std::uint32_t answers) const {
  std::atomic<double>& entry = weights_[answers];
  double found = entry.load(std::memory_order_relaxed);
  if (!std::isnan(found)) return found;
  found = weight(chain(static_cast<int>(pairs_.size()), answers));
  entry.store(found, std::memory_order_relaxed);
  return found;
}

double ClusterWeights::weight_by_chain(const OverlapGraph& graph) const {
  const std::optional<HamiltonianPath> path = hamiltonian_path(graph);
  if (!path) return weight(graph);
  std::uint32_t answers = 0;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const int i = (*path)[static_cast<std::size_t>(pairs_[k].i)], j = (*path)[static_cast<std::size_t>(pairs_[k].j)];
    answers |= (graph.overlaps(i, j) ? 1u : 0u) << k;
  }
  return weight_of_chain(answers);
}

bool ClusterWeights::may_count(int n_asked, std::uint32_t answers) const {
  std::atomic<std::uint8_t>& entry = may_count_[(std::size_t{1} << n_asked) | answers];
  const std::uint8_t known = entry.load(std::memory_order_relaxed);
  if (known != 0) return known == 2;
  // So few that all their answers are looked at; of more, whether the graph can become biconnected.
  constexpr int kFew = 4;
  const int n_left = static_cast<int>(pairs_.size()) - n_asked;
  bool may = false;
  if (n_left == 0) {
    may = weight_of_chain(answers) != 0.0;
  } else if (n_left <= kFew) {
    may = may_count(n_asked + 1, answers) || may_count(n_asked + 1, answers | 1u << n_asked);
  } else {
    may = is_biconnected(chain(n_asked, answers));
  }
  entry.store(may ? 2 : 1, std::memory_order_relaxed);
  return may;
}

}  // namespace vex
