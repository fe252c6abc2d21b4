// Draws the clusters of a bunch: chains, and from six bodies on trees, of bodies each of which overlaps the one before.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/sampling/poses/orientation_law.h"
#include "engine/sampling/virial/cluster_tree.h"
#include "engine/sampling/virial/cluster_weights.h"
#include "engine/sampling/virial/distance_control.h"
#include "engine/sampling/virial/overlapping_pairs.h"
#include "engine/sampling/virial/turned_neighbours.h"

namespace vex {

/// Of isotropic and of aligned bodies a chain of n bodies is worth (2 B2)^(n-1): of other laws a body's neighbour on
/// one side tells how it is turned, and with it the room on the other.
bool chains_factorise(const OrientationLaw& law);

/// Throws UsageError for a law that is not about one body: `fixed`, `angle`, `each`, and one about two unlike axes.
void require_law_of_one_body(const OrientationLaw& law);

/// Of kPoses poses of overlapping neighbours, drawn independently, every cluster takes n - 1 unlike ones, and each pose
/// serves some clusters. That costs less than as many poses as clusters have neighbours, and clusters of a bunch hang
/// together only a little.
///
/// Where chains do not factorise, kPoses orientations are drawn, of which each cluster takes n unlike ones; neighbours
/// are those of a round (turned_neighbours.h), and a cluster counts for the product of their factors. Serves one
/// thread.
class ClusterDrawer {
 public:
  static constexpr std::size_t kPoses = 61;  // a prime
  /// Each pose begins a cluster of each round (ClusterWeights::n_rounds).
  static std::size_t n_clusters(int order) {
    return kPoses * static_cast<std::size_t>(ClusterWeights::n_rounds(order));
  }

  /// Bodies, one, or three of a mixture's third coefficient, must outlive it. `known` is of each pair of neighbours
  /// that are unlike another one; it is asked for where chains do not factorise: a UsageError is thrown where it is not
  /// known.
  ClusterDrawer(std::span<const ConvexBody> bodies, const OrientationLaw& law, const ClusterWeights& weights,
                std::span<const KnownExcludedVolume> known, InstructionSet set);

  /// Undecided neighbours are taken for `undecided`, and counted. `functions`, if there are any, are of the neighbours.
  void draw(std::uint64_t seed, std::uint64_t first, Outcome undecided, const DistanceControl* functions,
            PairQuestions& questions);

  std::size_t n_drawn() const { return factors_of_clusters_.size(); }
  /// Those of all clusters, one after another.
  std::span<const Transformd> world_from_bodies() const { return world_from_bodies_; }
  /// What the cluster counts for, besides its weight: 1 where chains factorise.
  double factor(std::size_t cluster) const { return factors_of_clusters_[cluster]; }
  /// The first ones are trees.
  std::size_t n_trees() const { return trees_.size(); }
  const ClusterTree& tree(std::size_t cluster) const { return trees_[cluster]; }
  /// The means of the functions.
  const DistanceControl::Values& means() const { return means_; }

  /// No factor is larger: of a neighbour, and of a cluster.
  double largest_of_neighbour() const { return largest_of_neighbour_; }
  double largest_of_cluster() const { return largest_of_cluster_; }
  bool has_factors() const { return !turned_.empty(); }
  /// What a cluster's factor is off by, relative to it: a bound.
  double relative_rounding() const { return relative_rounding_; }

 private:
  // What the poses of a cluster's neighbours are: every step-th from the first one on, round and round.
  struct Neighbours {
    std::span<const Transformd> poses, second_poses;  // of the second pair of a mixture
    std::span<const double> factors, second_factors;  // or none: all are 1
    std::size_t first, step;
  };

  void set_chain(std::size_t cluster, const Neighbours& neighbours);
  void set_tree(std::size_t cluster, const Neighbours& neighbours);
  void draw_alike(std::uint64_t seed, std::uint64_t first, Outcome undecided, PairQuestions& questions);
  void draw_by_law(std::uint64_t seed, std::uint64_t first, Outcome undecided, PairQuestions& questions);
  void draw_orientations(std::uint64_t seed, std::uint64_t first);
  void turn_neighbours_of_chains(std::size_t step);
  void turn_neighbours_of_trees(std::size_t first_cluster, std::size_t step);
  void note_neighbours(std::size_t n);
  std::span<Transformd> world_of(std::size_t cluster) {
    return std::span(world_from_bodies_).subspan(cluster * n_bodies_, n_bodies_);
  }

  std::span<const ConvexBody> bodies_;
  OrientationLaw law_;
  std::size_t n_bodies_, n_clusters_of_trees_;
  // Of each pair, in which way neighbours are drawn.
  std::vector<std::unique_ptr<OverlappingPairs>> alike_;
  std::vector<std::unique_ptr<TurnedNeighbours>> turned_;
  double largest_of_neighbour_ = 1.0, largest_of_cluster_ = 1.0, relative_rounding_ = 0.0;
  // kPoses of each pair; of trees by a law those of one tree after another.
  std::array<std::vector<Transformd>, 2> poses_;
  std::array<std::vector<double>, 2> factors_;
  std::array<std::vector<Transformd>, 3> orientations_;  // kPoses of each body of a mixture
  std::vector<ClusterTree> trees_;
  std::vector<Transformd> world_from_bodies_;
  std::vector<double> factors_of_clusters_;
  const DistanceControl* functions_ = nullptr;
  DistanceControl::Values means_{};
  std::size_t n_noted_ = 0;
};

}  // namespace vex
