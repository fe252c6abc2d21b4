// The integrand of a virial coefficient: clusters of overlapping bodies, drawn directly, and what they count for.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/sampling/integrand.h"
#include "engine/sampling/virial/cluster_weights.h"
#include "engine/sampling/virial/distance_control.h"
#include "engine/sampling/virial/overlapping_pairs.h"
#include "engine/sampling/virial/virial_pairs.h"

namespace vex {

/// Of isotropic and of aligned bodies a chain of n bodies is worth (2 B2)^(n-1). Throws UsageError for other laws.
void require_factorising_law(const OrientationLaw& law);

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
  static std::size_t n_clusters(int order) {
    return kPoses * static_cast<std::size_t>(ClusterWeights::n_rounds(order));
  }

  /// Of like bodies. `law` is isotropic or aligned: of others the chains' integrals are not powers of B2, and a
  /// UsageError is thrown. One instance serves one thread; weights are shared.
  VirialIntegrand(const ConvexBody& body, const OrientationLaw& law, std::shared_ptr<const ClusterWeights> weights,
                  InstructionSet set = best_instruction_set(), std::shared_ptr<const VirialControl> control = nullptr);

  /// A control variate for the same body, law and order, by some hundred bunches that are no part of any run: the same
  /// for every set and machine. Null where none is to be had (DistanceControl).
  static std::shared_ptr<const VirialControl> control_of(const ConvexBody& body, const OrientationLaw& law,
                                                         const std::shared_ptr<const ClusterWeights>& weights,
                                                         double excluded_volume, double relative_error,
                                                         InstructionSet set = best_instruction_set());
  /// Of a mixture, order 3: the mean is B_ijk / (B_ij B_jk) for the bodies i, j, k in this order.
  VirialIntegrand(const std::array<ConvexBody, 3>& bodies, const OrientationLaw& law,
                  std::shared_ptr<const ClusterWeights> weights, InstructionSet set = best_instruction_set());
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
  void count(std::span<std::uint64_t> counted) override;

 private:
  struct Cluster;

  VirialIntegrand(std::vector<ConvexBody> bodies, const OrientationLaw& law,
                  std::shared_ptr<const ClusterWeights> weights, InstructionSet set,
                  std::shared_ptr<const VirialControl> control);
  DistanceControl::Values means_of(const DistanceControl& functions) const;
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
  std::shared_ptr<const VirialControl> control_;
  VirialPairs counts_;
  std::size_t n_pairs_;  // that are no neighbours
  OverlappingPairs neighbours_;
  std::unique_ptr<OverlappingPairs> second_neighbours_;  // of three unlike bodies
  PairDecider decider_;
  std::array<Transformd, kPoses> poses_, second_poses_;
  std::vector<Cluster> clusters_;
  std::vector<Transformd> world_from_bodies_;  // cluster after cluster
  std::vector<Vec3d> centres_;                 // of these bodies, in the world
  // Of one pair of each cluster that may count: whose it is, the answer; and what is searched.
  std::vector<std::size_t> asked_, open_;
  std::vector<Outcome> outcomes_;
  std::vector<double> table_;
  std::size_t stride_;
  std::vector<Verdict> verdicts_;
};

}  // namespace vex
