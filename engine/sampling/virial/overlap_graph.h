// Which of a few bodies overlap, and the sums over graphs of which virial coefficients of hard bodies are made.
//
// Mayer's function f is -1 where two bodies overlap and 0 where they do not, so a sum over graphs of products of f is a
// whole number that hangs on the overlaps alone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace vex {

/// Bodies of the largest cluster.
inline constexpr int kMostClusterBodies = 8;

/// Of n bodies, 1 <= n <= kMostClusterBodies; without an overlap to begin with.
class OverlapGraph {
 public:
  explicit OverlapGraph(int n_bodies);

  int n_bodies() const { return n_; }
  unsigned all() const { return (1u << n_) - 1u; }
  /// i and j are unlike.
  void join(int i, int j) {
    neighbours_[static_cast<std::size_t>(i)] |= 1u << j;
    neighbours_[static_cast<std::size_t>(j)] |= 1u << i;
  }
  void part(int i, int j) {
    neighbours_[static_cast<std::size_t>(i)] &= ~(1u << j);
    neighbours_[static_cast<std::size_t>(j)] &= ~(1u << i);
  }
  bool overlaps(int i, int j) const { return (neighbours(i) >> j & 1u) != 0; }
  /// One bit for each body that overlaps this one.
  unsigned neighbours(int i) const { return neighbours_[static_cast<std::size_t>(i)]; }

 private:
  int n_;
  std::array<unsigned, kMostClusterBodies> neighbours_{};
};

/// Whether the bodies are in one piece, and stay so whichever of them is taken away. Of two bodies: whether they
/// overlap.
bool is_biconnected(const OverlapGraph& graph);

/// The sum over all biconnected graphs of the bodies of the products of f: of every set of overlaps that makes the
/// bodies biconnected +1 where their number is even, -1 where it is odd.
///
/// Recursion over sets of bodies, of which every sum of connected and of biconnected graphs is made (R. J. Wheatley,
/// Phys. Rev. Lett. 110, 200601, 2013): n 3^(n-1) / 2 steps at most. Each sum is one of +-1 over some of the 2^28
/// graphs of eight bodies or fewer, of two sums that are multiplied with no pair of bodies in common, and at most 2^7
/// products are added: no number exceeds 2^35.
std::int64_t biconnected_sum(const OverlapGraph& graph);

/// Ways through all bodies, from each to one that it overlaps; a way and its reverse are one. At most 8! / 2.
std::int64_t n_hamiltonian_paths(const OverlapGraph& graph);

/// Trees that join all bodies, of overlaps (G. Kirchhoff, Ann. Phys. 148, 497, 1847). At most 8^6 (A. Cayley, 1889).
std::int64_t n_spanning_trees(const OverlapGraph& graph);

/// A way through all bodies over overlaps, if there is one: its first n_bodies() places.
using HamiltonianPath = std::array<std::uint8_t, kMostClusterBodies>;
std::optional<HamiltonianPath> hamiltonian_path(const OverlapGraph& graph);

}  // namespace vex
