// The integrand of a virial coefficient: clusters of overlapping bodies, drawn directly, and what they count for.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/sampling/integrand.h"
#include "engine/sampling/virial/cluster_weights.h"
#include "engine/sampling/virial/overlapping_pairs.h"

namespace vex {

/// Of isotropic and of aligned bodies a chain of n bodies is worth (2 B2)^(n-1). Throws UsageError for other laws.
void require_factorising_law(const OrientationLaw& law);

/// What was asked by all threads of a run: pairs that are no neighbours of a chain or a tree.
struct VirialCounts {
  std::atomic<std::uint64_t> n_pairs = 0;       // of all clusters
  std::atomic<std::uint64_t> n_by_balls = 0;    // of these decided by circumscribed and inscribed balls
  std::atomic<std::uint64_t> n_searched = 0;    // and by a search; the rest was skipped
  std::atomic<std::uint64_t> n_undecided = 0;   // of those searched, and of the neighbours
  std::atomic<std::uint64_t> n_candidates = 0;  // poses that neighbours were drawn from
};

/// Its mean over the unit square is B_n / B2^(n-1), of any sign, without a unit: what the driver calls a length^3 is 1.
///
/// A point is a key: it tells the stream that the poses of a bunch of clusters are drawn from, so both its coordinates
/// have to be random and the points no net. The value is the mean over the bunch: of kPoses poses of overlapping
/// neighbours, drawn independently, every cluster takes n - 1 unlike ones, and each pose serves some clusters. That
/// costs less than as many poses as clusters have neighbours, and clusters of a bunch hang together only a little; the
/// standard error is from unlike bunches, which are independent.
class VirialIntegrand final : public Integrand {
 public:
  static constexpr std::size_t kPoses = 61;  // a prime
  /// Each pose begins a cluster of each round (ClusterWeights::n_rounds).
  static std::size_t n_clusters(const ClusterWeights& weights) {
    return kPoses * static_cast<std::size_t>(weights.n_rounds());
  }

  /// Of like bodies. `law` is isotropic or aligned: of others the chains' integrals are not powers of B2, and a
  /// UsageError is thrown. One instance serves one thread; weights and counts are shared.
  VirialIntegrand(const ConvexBody& body, const OrientationLaw& law, std::shared_ptr<const ClusterWeights> weights,
                  std::shared_ptr<VirialCounts> counts, InstructionSet set = best_instruction_set());
  /// Of a mixture, order 3: the mean is B_ijk / (B_ij B_jk) for the bodies i, j, k in this order.
  VirialIntegrand(const std::array<ConvexBody, 3>& bodies, const OrientationLaw& law,
                  std::shared_ptr<const ClusterWeights> weights, std::shared_ptr<VirialCounts> counts,
                  InstructionSet set = best_instruction_set());
  ~VirialIntegrand() override;

  int dimension() const override { return 2; }
  bool may_be_negative() const override { return true; }
  double scale() const override { return 1.0; }
  double relative_rounding() const override { return 0x1p-45; }
  /// A relative pose is off by less than 2^-44 of the bodies' reach by rounding, and an overlap wrong where they are as
  /// close to contact: of bodies not thinner than 1 / 16, 2^-40 of all poses for each pair.
  double absolute_rounding() const override;
  double cost() const override;

  Doubts evaluate(std::span<const double> points, std::span<double> values) override;

 private:
  struct Cluster;

  VirialIntegrand(std::vector<ConvexBody> bodies, const OrientationLaw& law,
                  std::shared_ptr<const ClusterWeights> weights, std::shared_ptr<VirialCounts> counts,
                  InstructionSet set);
  double bunch(std::uint64_t seed, std::uint64_t first, Outcome undecided, std::uint64_t& n_undecided);
  void set_chain(std::size_t cluster, std::size_t first, std::size_t step);
  void set_tree(std::size_t cluster, std::size_t first, std::size_t step, std::span<const double> point);
  void draw_clusters(std::uint64_t seed, std::uint64_t first);
  void ask(Outcome undecided, PairQuestions& questions);
  void take(Cluster& cluster, std::size_t k, Outcome outcome) const;
  std::span<Transformd> world_of(std::size_t cluster) {
    const auto n = static_cast<std::size_t>(weights_->order());
    return std::span(world_from_bodies_).subspan(cluster * n, n);
  }
  double weight(const Cluster& cluster) const;

  std::vector<ConvexBody> bodies_;  // one, or three
  std::shared_ptr<const ClusterWeights> weights_;
  std::shared_ptr<VirialCounts> counts_;
  std::size_t n_pairs_;  // that are no neighbours
  OverlappingPairs neighbours_;
  std::unique_ptr<OverlappingPairs> second_neighbours_;  // of three unlike bodies
  PairDecider decider_;
  std::array<Transformd, kPoses> poses_, second_poses_;
  std::vector<Cluster> clusters_;
  std::vector<Transformd> world_from_bodies_;  // cluster after cluster
  // Of one pair of each cluster that may count: whose it is, the answer; and what is searched.
  std::vector<std::size_t> asked_, open_;
  std::vector<Outcome> outcomes_;
  std::vector<double> table_;
  std::size_t stride_;
  std::vector<Verdict> verdicts_;
};

}  // namespace vex
