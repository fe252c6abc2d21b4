#include "shapes/nematic/mixture.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"
#include "shapes/nematic/mixture_branch.h"

namespace vex {
namespace {

/// Neighbours of a trace between which the isotropic fluid's share of B does not turn back: from one index to another.
struct Limb {
  std::size_t begin, end;
};

std::vector<Limb> limbs_of(const std::vector<BranchPoint>& points) {
  std::vector<Limb> limbs;
  const auto rises = [&points](std::size_t k) { return points[k + 1].odds_of_isotropic > points[k].odds_of_isotropic; };
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    if (limbs.empty() || rises(k) != rises(limbs.back().begin)) limbs.push_back({k, k + 1});
    limbs.back().end = k + 1;
  }
  return limbs;
}

std::vector<BranchPoint> equilibria_at(const MixtureBranch& branch, const std::vector<BranchPoint>& points,
                                       const Limb& limb, double odds_of_isotropic) {
  std::vector<BranchPoint> found;
  for (std::size_t k = limb.begin; k < limb.end; ++k) {
    branch.find_between(points[k], points[k + 1], odds_of_isotropic, &found);
  }
  return found;
}

/// Where two limbs have the same isotropic fluid: with a bisection by the difference of its densities.
std::optional<ThreeFluids> three_fluids_of(const MixtureBranch& branch, const std::vector<BranchPoint>& points,
                                           const Limb& one, const Limb& other) {
  const auto at = [&points](std::size_t k) { return points[k].odds_of_isotropic; };
  double low = std::max(std::min(at(one.begin), at(one.end)), std::min(at(other.begin), at(other.end)));
  double high = std::min(std::max(at(one.begin), at(one.end)), std::max(at(other.begin), at(other.end)));
  std::vector<BranchPoint> of_one, of_other;
  // By how much the isotropic fluid of `one` is the denser; nothing where a limb has no single equilibrium.
  const auto difference = [&](double odds) -> std::optional<double> {
    of_one = equilibria_at(branch, points, one, odds);
    of_other = equilibria_at(branch, points, other, odds);
    if (of_one.size() != 1 || of_other.size() != 1) return std::nullopt;
    return of_one[0].log_n_isotropic - of_other[0].log_n_isotropic;
  };
  if (!(low < high)) return std::nullopt;
  // At the very ends a limb turns back, and Newton's method does not get there.
  const double margin = 1e-3 * (high - low);
  low += margin;
  high -= margin;
  const std::optional<double> of_low = difference(low), of_high = difference(high);
  if (!of_low || !of_high || (*of_low < 0.0) == (*of_high < 0.0)) return std::nullopt;
  for (int k = 0; k < 60 && high - low > 1e-14 * std::fabs(low); ++k) {
    const double middle = std::midpoint(low, high);
    const std::optional<double> of_middle = difference(middle);
    if (!of_middle) return std::nullopt;
    ((*of_middle < 0.0) == (*of_low < 0.0) ? low : high) = middle;
  }
  return ThreeFluids{of_one[0].isotropic, {of_one[0].nematic, of_other[0].nematic}};
}

MixtureCoexistence coexistence_of(const BranchPoint& point, double composition) {
  return {composition, point.isotropic, point.nematic, point.residual};
}

}  // namespace

std::optional<MixturePhase> mixture_phase(const NematicMixture& mixture, std::array<double, 2> number_densities,
                                          bool is_ordered) {
  const MixtureFluid fluid(mixture);
  if (!is_ordered) return fluid.phase(number_densities, fluid.isotropic());
  const BothDensities both = fluid.equilibrium(number_densities, {fluid.start_of_order(), fluid.start_of_order()});
  if (!both.converged) return std::nullopt;
  return fluid.phase(number_densities, both);
}

MixtureResult coexistence_of_mixture(const NematicMixture& mixture, const std::vector<double>& compositions) {
  double before = 0.0;
  for (const double composition : compositions) {
    if (!(composition >= before && composition <= 1.0)) {
      throw UsageError("shares of B that do not ascend from 0 to 1 (" + shortest_number(composition) + ") - sort them");
    }
    before = composition;
  }
  MixtureResult result;
  const MixtureBranch branch(mixture);
  NematicFluid of_a;
  of_a.series = mixture.aa.series;
  of_a.volume_by_b2 = 2.0 * mixture.volumes[0] / mixture.aa.excluded_volume;
  of_a.theory = mixture.theory;
  const CoexistenceResult pure = coexistence(of_a);
  if (!pure.found) {
    result.reason =
        "A alone has no such transition, from which the branch begins: " + pure.reason + "; let the other body be A";
    return result;
  }
  const MixtureBranch::Trace trace = branch.trace(*pure.found);
  result.reason = trace.reason;
  const std::vector<BranchPoint>& points = trace.points;
  if (points.empty()) return result;
  // Behind the end of a branch that was lost there may be equilibria of less dense fluids at any share but 0.
  if (!trace.reason.empty()) {
    if (!compositions.empty() && compositions.front() == 0.0) {
      result.found.push_back(coexistence_of(points.front(), 0.0));
    }
    return result;
  }
  const std::vector<Limb> limbs = limbs_of(points);
  for (const double composition : compositions) {
    // Of the two kinds alone.
    if (composition == 0.0 || composition == 1.0) {
      result.found.push_back(coexistence_of(composition == 0.0 ? points.front() : points.back(), composition));
      continue;
    }
    const double odds = log_odds_of(std::clamp(composition, kTraceOfB, 1.0 - kTraceOfB));
    std::vector<BranchPoint> all;
    for (const Limb& limb : limbs) {
      std::ranges::move(equilibria_at(branch, points, limb, odds), std::back_inserter(all));
    }
    // An isotropic fluid of this composition that grows denser is no longer stable from its first equilibrium on.
    const auto first = std::ranges::min_element(all, {}, &BranchPoint::log_n_isotropic);
    if (first == all.end()) {
      result.reason =
          "no equilibrium was found at a share of " + shortest_number(composition) + " of B in the isotropic fluid";
      break;
    }
    result.found.push_back(coexistence_of(*first, composition));
  }
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    for (std::size_t j = i + 2; j < limbs.size(); j += 2) {
      std::optional<ThreeFluids> three = three_fluids_of(branch, points, limbs[i], limbs[j]);
      if (three) result.three.push_back(std::move(*three));
    }
  }
  return result;
}

}  // namespace vex
