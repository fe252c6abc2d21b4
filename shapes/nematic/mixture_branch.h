// The equilibria of an isotropic and a nematic fluid of two kinds of bodies: a branch from the fluid of A alone to that
// of B alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "shapes/nematic/mixture_fluid.h"

namespace vex {

/// A share of B at which it changes nothing, to rounding: the fluid of A alone.
inline constexpr double kTraceOfB = 1e-7;

/// ln x / (1 - x) of the share of B, of which both shares follow with all their digits, however small one is.
double log_odds_of(double share_of_b);

/// One equilibrium of the branch.
struct BranchPoint {
  double log_n_isotropic = 0.0, log_n_nematic = 0.0;      // of both kinds, 1 / length^3
  double odds_of_isotropic = 0.0, odds_of_nematic = 0.0;  // log_odds_of B's share
  TwoSeries moments;                                      // of the nematic fluid's orientations
  MixturePhase isotropic{}, nematic{};
  double residual = 0.0;  // the largest relative difference of the pressures and of the chemical potentials
};

class MixtureBranch {
 public:
  enum class Held { isotropic_share, nematic_share };

  explicit MixtureBranch(const NematicMixture& mixture) : fluid_(mixture), isotropic_(fluid_.isotropic()) {}

  /// By Newton's method from `guess`, of which one fluid's share of B is kept.
  std::optional<BranchPoint> solve(BranchPoint guess, Held held) const;

  /// Its points in their order; at either end neither fluid has more of the other kind than kTraceOfB.
  struct Trace {
    std::vector<BranchPoint> points;
    std::string reason;  // why it does not end at B alone
  };
  /// Follows the branch step by step. Where two nematic fluids are in equilibrium with the isotropic one, its share of
  /// B turns back, and the nematic fluid's may.
  Trace trace(const Coexistence& of_a) const;

  /// The equilibria between two neighbours of a trace at this composition of the isotropic fluid.
  void find_between(const BranchPoint& low, const BranchPoint& high, double odds_of_isotropic,
                    std::vector<BranchPoint>* found, int depth = 0) const;

 private:
  bool set_phases(BranchPoint* point) const;
  std::optional<BranchPoint> begin(const Coexistence& of_a) const;

  MixtureFluid fluid_;
  BothDensities isotropic_;
};

}  // namespace vex
