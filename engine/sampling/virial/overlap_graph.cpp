#include "engine/sampling/virial/overlap_graph.h"

#include <bit>
#include <string>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

constexpr std::size_t kMostSets = std::size_t{1} << kMostClusterBodies;

// Whether the bodies of the set are in one piece.
bool is_connected(const OverlapGraph& graph, unsigned set) {
  unsigned reached = set & -set, from = reached;
  while (from != 0) {
    const unsigned next = graph.neighbours(std::countr_zero(from)) & set & ~reached;
    reached |= next;
    from = (from & (from - 1)) | next;
  }
  return reached == set;
}

// Calls `of_part` with every part of the set but the set itself.
template <class OfPart>
void for_proper_parts(unsigned set, const OfPart& of_part) {
  if (set == 0) return;
  for (unsigned part = (set - 1) & set;; part = (part - 1) & set) {
    of_part(part);
    if (part == 0) return;
  }
}

// Whether two bodies that overlap part the others: nothing goes from some of these to the rest. Then the sum over
// biconnected graphs is 0. Take such a graph, and the overlap of the two in or out of it: the graph stays biconnected,
// for on either side of the two there is another way from one to the other. So graphs come in pairs of opposite signs.
bool is_parted_by_an_overlap(const OverlapGraph& graph) {
  for (int i = 0; i < graph.n_bodies(); ++i) {
    for (unsigned later = graph.neighbours(i) >> i >> 1 << i << 1; later != 0; later &= later - 1) {
      const unsigned rest = graph.all() & ~(1u << i) & ~(later & -later);
      if (rest != 0 && !is_connected(graph, rest)) return true;
    }
  }
  return false;
}

using SumsOfSets = std::array<std::int64_t, kMostSets>;

// Of every set of bodies the sum over its connected graphs: of all graphs, which is 1 if no two of them overlap and 0
// otherwise, less those in which the set's first body is connected with a part of the set alone.
void sum_connected(const OverlapGraph& graph, SumsOfSets& connected) {
  std::array<bool, kMostSets> is_apart{};
  is_apart[0] = true;
  connected[0] = 0;
  for (unsigned set = 1; set <= graph.all(); ++set) {
    const unsigned first = set & -set, rest = set ^ first;
    is_apart[set] = is_apart[rest] && (graph.neighbours(std::countr_zero(first)) & rest) == 0;
    std::int64_t sum = is_apart[set] ? 1 : 0;
    for_proper_parts(rest, [&](unsigned part) {
      if (is_apart[rest ^ part]) sum -= connected[first | part];
    });
    connected[set] = sum;
  }
}

}  // namespace

OverlapGraph::OverlapGraph(int n_bodies) : n_(n_bodies) {
  if (n_bodies < 1 || n_bodies > kMostClusterBodies) {
    throw UsageError("no overlap graph has so many bodies (" + std::to_string(n_bodies) + ") - give 1 to " +
                     std::to_string(kMostClusterBodies));
  }
}

bool is_biconnected(const OverlapGraph& graph) {
  const unsigned all = graph.all();
  if (!is_connected(graph, all)) return false;
  if (graph.n_bodies() <= 2) return true;
  for (int body = 0; body < graph.n_bodies(); ++body) {
    if (!is_connected(graph, all & ~(1u << body))) return false;
  }
  return true;
}

std::int64_t biconnected_sum(const OverlapGraph& graph) {
  if (!is_biconnected(graph) || is_parted_by_an_overlap(graph)) return 0;
  SumsOfSets before, after;
  sum_connected(graph, before);
  // Body after body: `before` is of the graphs whose bodies up to this one join no pieces that would fall apart without
  // them, `after` counts this one in. A connected graph of the first kind is, where this body joins pieces, one of the
  // second kind around the set's first other body, and any one of the first kind of the rest.
  for (int body = 0; body < graph.n_bodies(); ++body) {
    const unsigned bit = 1u << body;
    after = before;
    for (unsigned set = bit; set <= graph.all(); ++set) {
      const unsigned others = set ^ bit;
      if ((set & bit) == 0 || others == 0) continue;
      const unsigned first = others & -others, rest = others ^ first;
      std::int64_t sum = before[set];
      for_proper_parts(rest, [&](unsigned part) { sum -= after[bit | first | part] * before[bit | (rest ^ part)]; });
      after[set] = sum;
    }
    before = after;
  }
  return before[graph.all()];
}

std::int64_t n_hamiltonian_paths(const OverlapGraph& graph) {
  if (graph.n_bodies() == 1) return 1;
  // Ways through the bodies of a set that end at one of them.
  std::array<std::array<std::int64_t, kMostClusterBodies>, kMostSets> ways{};
  for (int k = 0; k < graph.n_bodies(); ++k) ways[1u << k][static_cast<std::size_t>(k)] = 1;
  for (unsigned set = 1; set <= graph.all(); ++set) {
    for (int end = 0; end < graph.n_bodies(); ++end) {
      const std::int64_t n = ways[set][static_cast<std::size_t>(end)];
      if (n == 0) continue;
      for (unsigned next = graph.neighbours(end) & ~set; next != 0; next &= next - 1) {
        ways[set | (next & -next)][static_cast<std::size_t>(std::countr_zero(next))] += n;
      }
    }
  }
  std::int64_t sum = 0;
  for (const std::int64_t n : ways[graph.all()]) sum += n;
  return sum / 2;
}

namespace {

// Goes on from `at` through the bodies that are left; those with few neighbours among them first, which would be left
// over.
bool extend_path(const OverlapGraph& graph, unsigned left, HamiltonianPath& path, std::size_t length) {
  if (left == 0) return true;
  unsigned next = graph.neighbours(path[length - 1]) & left;
  while (next != 0) {
    int best = -1, fewest = kMostClusterBodies + 1;
    for (unsigned rest = next; rest != 0; rest &= rest - 1) {
      const int body = std::countr_zero(rest), n = std::popcount(graph.neighbours(body) & left);
      if (n < fewest) {
        fewest = n;
        best = body;
      }
    }
    path[length] = static_cast<std::uint8_t>(best);
    if (extend_path(graph, left & ~(1u << best), path, length + 1)) return true;
    next &= ~(1u << best);
  }
  return false;
}

}  // namespace

std::optional<HamiltonianPath> hamiltonian_path(const OverlapGraph& graph) {
  HamiltonianPath path{};
  for (int first = 0; first < graph.n_bodies(); ++first) {
    path[0] = static_cast<std::uint8_t>(first);
    if (extend_path(graph, graph.all() & ~(1u << first), path, 1)) return path;
  }
  return std::nullopt;
}

std::int64_t n_spanning_trees(const OverlapGraph& graph) {
  const int n = graph.n_bodies() - 1;
  std::array<std::array<std::int64_t, kMostClusterBodies>, kMostClusterBodies> matrix{};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const bool is_joined = i != j && graph.overlaps(i, j);
      matrix[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          i == j ? std::popcount(graph.neighbours(i)) : (is_joined ? -1 : 0);
    }
  }
  // The determinant without fractions (E. H. Bareiss, Math. Comp. 22, 565, 1968): what is left after each step are
  // minors, so every division is exact. A leading minor of this matrix counts forests: where it is 0 so is the result.
  std::int64_t last = 1;
  for (int k = 0; k + 1 < n; ++k) {
    const auto row = static_cast<std::size_t>(k);
    if (matrix[row][row] == 0) return 0;
    for (std::size_t i = row + 1; i < static_cast<std::size_t>(n); ++i) {
      for (std::size_t j = row + 1; j < static_cast<std::size_t>(n); ++j) {
        matrix[i][j] = (matrix[i][j] * matrix[row][row] - matrix[i][row] * matrix[row][j]) / last;
      }
    }
    last = matrix[row][row];
  }
  return n == 0 ? 1 : matrix[static_cast<std::size_t>(n - 1)][static_cast<std::size_t>(n - 1)];
}

}  // namespace vex
