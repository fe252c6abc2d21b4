#include "engine/sampling/virial/cluster_tree.h"

namespace vex {

// By Pruefer's code, n - 2 numbers of a body, which each tree has just one of (H. Pruefer, Arch. Math. Phys. 27, 742,
// 1918). It cuts leaves; what it cuts last is placed first.
ClusterTree::ClusterTree(int n, std::span<const double> point) : n_edges_(static_cast<std::size_t>(n) - 1), graph_(n) {
  std::array<int, kMostClusterBodies> code{}, n_neighbours{};
  for (int k = 0; k < n; ++k) n_neighbours[static_cast<std::size_t>(k)] = 1;
  for (int k = 0; k + 2 < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    code[at] = static_cast<int>(point[at] * n);
    ++n_neighbours[static_cast<std::size_t>(code[at])];
  }
  std::size_t n_left = n_edges_;
  const auto cut = [&](int parent) {
    int leaf = 0;
    while (n_neighbours[static_cast<std::size_t>(leaf)] != 1 || leaf == parent) ++leaf;
    edges_[--n_left] = {parent, leaf};
    --n_neighbours[static_cast<std::size_t>(leaf)];
    --n_neighbours[static_cast<std::size_t>(parent)];
    graph_.join(leaf, parent);
  };
  for (int k = 0; k + 2 < n; ++k) cut(code[static_cast<std::size_t>(k)]);
  int last = n - 1;
  while (n_neighbours[static_cast<std::size_t>(last)] != 1) --last;
  cut(last);
}

}  // namespace vex
