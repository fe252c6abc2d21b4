// The integrand of a virial coefficient: clusters of overlapping bodies, drawn directly, and what they count for.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/sampling/integrand.h"
#include "engine/sampling/virial/cluster_drawer.h"
#include "engine/sampling/virial/cluster_weights.h"
#include "engine/sampling/virial/distance_control.h"
#include "engine/sampling/virial/overlapping_pairs.h"
#include "engine/sampling/virial/virial_pairs.h"

namespace vex {

/// Its mean over the unit square is B_n / B2^(n-1), of any sign, without a unit: what the driver calls a length^3 is 1.
///
/// A point is a key: it tells the stream that a bunch of clusters is drawn from (cluster_drawer.h), so both its
/// coordinates have to be random and the points no net. The value is the mean over the bunch; the standard error is
/// from unlike bunches, which are independent.
class VirialIntegrand final : public Integrand {
 public:
  static std::size_t n_clusters(int order) { return ClusterDrawer::n_clusters(order); }

  /// Of like bodies. `known` is asked for where chains do not factorise: a UsageError is thrown where it is not known.
  /// One instance serves one thread; weights are shared.
  VirialIntegrand(const ConvexBody& body, const OrientationLaw& law, std::shared_ptr<const ClusterWeights> weights,
                  InstructionSet set = best_instruction_set(), std::shared_ptr<const VirialControl> control = nullptr,
                  const KnownExcludedVolume& known = {});

  /// A control variate for the same body, law and order, by some hundred bunches that are no part of any run: the same
  /// for every set and machine. Null where none is to be had (DistanceControl).
  static std::shared_ptr<const VirialControl> control_of(const ConvexBody& body, const OrientationLaw& law,
                                                         const std::shared_ptr<const ClusterWeights>& weights,
                                                         const KnownExcludedVolume& known,
                                                         InstructionSet set = best_instruction_set());
  /// Of a mixture, order 3: the mean is B_ijk / (B_ij B_jk) for the bodies i, j, k in this order; `known` is of ij and
  /// jk.
  VirialIntegrand(const std::array<ConvexBody, 3>& bodies, const OrientationLaw& law,
                  std::shared_ptr<const ClusterWeights> weights, InstructionSet set = best_instruction_set(),
                  const std::array<KnownExcludedVolume, 2>& known = {});
  ~VirialIntegrand() override;

  int dimension() const override { return 2; }
  bool may_be_negative() const override { return true; }
  double scale() const override { return 1.0; }
  double relative_rounding() const override { return 0x1p-45 + drawer_.relative_rounding(); }
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
                  std::shared_ptr<const VirialControl> control, std::span<const KnownExcludedVolume> known);
  double bunch(std::uint64_t seed, std::uint64_t first, Outcome undecided, std::uint64_t& n_undecided);
  double pilot_bunch(std::size_t k);
  double largest_value() const;
  void begin_clusters();
  void ask(Outcome undecided, PairQuestions& questions);
  void take(Cluster& cluster, std::size_t k, Outcome outcome) const;
  double weight(std::size_t cluster) const;

  std::vector<ConvexBody> bodies_;  // one, or three
  std::shared_ptr<const ClusterWeights> weights_;
  std::shared_ptr<const VirialControl> control_;
  VirialPairs counts_;
  std::size_t n_pairs_;  // that are no neighbours
  ClusterDrawer drawer_;
  PairDecider decider_;
  double mean_factor_ = 1.0;
  std::vector<Cluster> clusters_;
  std::vector<Vec3d> centres_;  // of the bodies, in the world, cluster after cluster
  // Of one pair of each cluster that may count: whose it is, the answer; and what is searched.
  std::vector<std::size_t> asked_, open_;
  std::vector<Outcome> outcomes_;
  std::vector<double> table_;
  std::size_t stride_;
};

}  // namespace vex
