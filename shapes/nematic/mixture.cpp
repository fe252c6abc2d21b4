#include "shapes/nematic/mixture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"

namespace vex {
namespace {

constexpr double kMomentTolerance = 1e-13;    // of moments
constexpr double kLeastOrderOfBranch = 0.02;  // below it a fluid is on its way to the isotropic one
constexpr double kLargestResidual = 1e-9;
constexpr int kMostRounds = 4000;
constexpr double kTraceOfB = 1e-7;  // a share at which B changes nothing, to rounding: the fluid of A alone

using Two = std::array<double, 2>;

/// Both densities of orientations.
struct BothDensities {
  std::array<OrientationDensity, 2> of;
  bool converged = false;
};

class MixtureFluid {
 public:
  explicit MixtureFluid(const NematicMixture& mixture) : mixture_(mixture), grid_(mixture.aa.series) {
    if (mixture.theory == NematicTheory::parsons_lee && !(mixture.volumes[0] > 0.0 && mixture.volumes[1] > 0.0)) {
      throw UsageError(
          "a flat body has no volume, which the scaling of Parsons and Lee is about - take Onsager's theory");
    }
    for (const NematicMixture::Pair* const pair : {&mixture.aa, &mixture.ab, &mixture.bb}) {
      if (!(pair->excluded_volume > 0.0) || pair->series.empty()) {
        throw UsageError("a pair of bodies excludes no volume - give others");
      }
    }
  }

  const EvenSeries& series(std::size_t i, std::size_t j) const { return pair(i, j).series; }
  /// <V_ex> / 2
  double b(std::size_t i, std::size_t j) const { return 0.5 * pair(i, j).excluded_volume; }

  /// The fixed point for these densities, by iteration from the moments of `start`, damped where it overshoots.
  BothDensities equilibrium(const Two& n, const std::array<EvenSeries, 2>& start) const {
    const double factor = scaling(n).factor;
    BothDensities both;
    std::array<EvenSeries, 2> moments = start;
    const std::size_t n_degrees = mixture_.aa.series.size();
    for (EvenSeries& of_kind : moments) of_kind.resize(n_degrees, 0.0);
    double mixing = 1.0, change_before = 2.0;
    for (int iteration = 0; iteration < kMostRounds; ++iteration) {
      double change = 0.0;
      for (std::size_t i = 0; i < 2; ++i) {
        EvenSeries field(n_degrees, 0.0);
        for (std::size_t j = 0; j < 2; ++j) {
          const EvenSeries& of_pair = series(i, j);
          for (std::size_t k = 1; k < std::min(n_degrees, of_pair.size()); ++k) {
            field[k] -= 2.0 * factor * n[j] * b(i, j) * of_pair[k] * moments[j][k];
          }
        }
        both.of[i] = grid_.in_field(field);
      }
      for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t k = 1; k < std::min(n_degrees, both.of[i].moments.size()); ++k) {
          const double step = both.of[i].moments[k] - moments[i][k];
          change = std::max(change, std::fabs(step));
          moments[i][k] += mixing * step;
        }
      }
      if (change <= kMomentTolerance) {
        both.converged = true;
        return both;
      }
      if (change > change_before && change > 1e-11) mixing = std::max(0.5 * mixing, 1.0 / 64.0);
      change_before = change;
    }
    return both;
  }

  MixturePhase phase(const Two& n, const BothDensities& both) const {
    const Scaling of = scaling(n);
    MixturePhase phase;
    phase.number_densities = n;
    double pairs = 0.0;  // sum of n_i n_j b_ij e_ij
    for (std::size_t i = 0; i < 2; ++i) {
      double met = 0.0;  // sum of n_j b_ij e_ij
      for (std::size_t j = 0; j < 2; ++j) met += n[j] * b(i, j) * interaction(both, i, j);
      pairs += n[i] * met;
      phase.chemical_potentials[i] = std::log(n[i] * b(0, 0)) + both.of[i].entropy + 2.0 * of.factor * met;
      phase.order_parameters[i] = both.of[i].order_parameter();
    }
    for (std::size_t i = 0; i < 2; ++i) phase.chemical_potentials[i] += pairs * of.slope * mixture_.volumes[i];
    phase.pressure = n[0] + n[1] + pairs * (of.factor + of.volume_fraction * of.slope);
    return phase;
  }

  BothDensities isotropic() const {
    BothDensities both;
    for (OrientationDensity& one : both.of) one = grid_.in_field({});
    both.converged = true;
    return both;
  }
  EvenSeries start_of_order() const { return grid_.trial(10.0).moments; }

 private:
  /// G, its slope by the volume fraction, and that.
  struct Scaling {
    double factor = 1.0, slope = 0.0, volume_fraction = 0.0;
  };
  Scaling scaling(const Two& n) const {
    if (mixture_.theory == NematicTheory::onsager) return {};
    const double eta = n[0] * mixture_.volumes[0] + n[1] * mixture_.volumes[1], rest = 1.0 - eta;
    return {(4.0 - 3.0 * eta) / (4.0 * rest * rest), (5.0 - 3.0 * eta) / (4.0 * rest * rest * rest), eta};
  }
  const NematicMixture::Pair& pair(std::size_t i, std::size_t j) const {
    return i != j ? mixture_.ab : (i == 0 ? mixture_.aa : mixture_.bb);
  }
  double interaction(const BothDensities& both, std::size_t i, std::size_t j) const {
    const EvenSeries &of_pair = series(i, j), &x = both.of[i].moments, &y = both.of[j].moments;
    double sum = 0.0;
    for (std::size_t k = 0; k < std::min({of_pair.size(), x.size(), y.size()}); ++k) sum += of_pair[k] * x[k] * y[k];
    return sum;
  }

  const NematicMixture& mixture_;
  OrientationGrid grid_;
};

/// ln x / (1 - x) of the share of B, of which both shares follow with all their digits, however small one is.
double log_odds_of(double share_of_b) { return std::log(share_of_b / (1.0 - share_of_b)); }
Two densities_of(double n, double log_odds) {
  return {n / (1.0 + std::exp(log_odds)), n / (1.0 + std::exp(-log_odds))};
}

/// What Newton's method looks for at one composition of the isotropic fluid.
struct Unknowns {
  double log_n_isotropic = 0.0, log_n_nematic = 0.0;
  double log_odds = 0.0;  // of B in the nematic fluid
};

class MixtureBranch {
 public:
  explicit MixtureBranch(const NematicMixture& mixture) : fluid_(mixture), isotropic_(fluid_.isotropic()) {}

  /// From the fluid of A alone.
  bool begin(const Coexistence& of_a) {
    const double n_i = of_a.isotropic.reduced_density / fluid_.b(0, 0);
    const double n_n = of_a.nematic.reduced_density / fluid_.b(0, 0);
    moments_ = {fluid_.start_of_order(), fluid_.start_of_order()};
    // B's own order and share follow from A's: its potentials are equal in both.
    const BothDensities both = fluid_.equilibrium(densities_of(n_n, log_odds_of(kTraceOfB)), moments_);
    if (!both.converged) return false;
    moments_ = {both.of[0].moments, both.of[1].moments};
    const MixturePhase isotropic = fluid_.phase(densities_of(n_i, log_odds_of(kTraceOfB)), isotropic_);
    const MixturePhase nematic = fluid_.phase(densities_of(n_n, log_odds_of(kTraceOfB)), both);
    const double shift = isotropic.chemical_potentials[1] - nematic.chemical_potentials[1];
    at_ = {std::log(n_i), std::log(n_n), log_odds_of(kTraceOfB) + shift};
    odds_ = log_odds_of(kTraceOfB);
    return solve(odds_, at_).has_value();
  }

  /// Moves along the branch to this composition, by steps that Newton's method can take.
  std::optional<MixtureCoexistence> follow(double composition) {
    constexpr double kSmallestStep = 1e-5;
    std::optional<MixtureCoexistence> found;
    double step = 1.0;
    const double target = log_odds_of(std::clamp(composition, kTraceOfB, 1.0 - kTraceOfB));
    do {
      const double next = std::fabs(target - odds_) <= step ? target : odds_ + std::copysign(step, target - odds_);
      Unknowns guess = at_;
      guess.log_odds += next - odds_;
      const std::array<EvenSeries, 2> kept = moments_;
      found = solve(next, guess);
      if (found) {
        odds_ = next;
        step = std::min(1.5, 1.5 * step);
      } else {
        moments_ = kept;
        step *= 0.5;
        if (step < kSmallestStep) return std::nullopt;
      }
    } while (!found || odds_ != target);
    found->composition = composition;
    return found;
  }

 private:
  struct Residual {
    MixturePhase isotropic, nematic;
    std::array<double, 3> of{};
    double size() const { return std::max({std::fabs(of[0]), std::fabs(of[1]), std::fabs(of[2])}); }
  };

  /// `odds`: of B in the isotropic fluid, their logarithm.
  std::optional<Residual> residual(double odds, const Unknowns& at, bool keeps_moments) {
    Residual found;
    const Two n = densities_of(std::exp(at.log_n_nematic), at.log_odds);
    const BothDensities both = fluid_.equilibrium(n, moments_);
    if (!both.converged ||
        !(std::max(both.of[0].order_parameter(), both.of[1].order_parameter()) > kLeastOrderOfBranch)) {
      return std::nullopt;
    }
    if (keeps_moments) moments_ = {both.of[0].moments, both.of[1].moments};
    found.isotropic = fluid_.phase(densities_of(std::exp(at.log_n_isotropic), odds), isotropic_);
    found.nematic = fluid_.phase(n, both);
    found.of = {std::log(found.nematic.pressure / found.isotropic.pressure),
                found.nematic.chemical_potentials[0] - found.isotropic.chemical_potentials[0],
                found.nematic.chemical_potentials[1] - found.isotropic.chemical_potentials[1]};
    for (const double value : found.of) {
      if (!std::isfinite(value)) return std::nullopt;
    }
    return found;
  }

  std::optional<MixtureCoexistence> solve(double odds, Unknowns at) {
    constexpr int kMostNewtonSteps = 12;
    constexpr double kDifference = 1e-6;
    std::optional<Residual> now = residual(odds, at, true);
    for (int step = 0; now && step < kMostNewtonSteps; ++step) {
      if (now->size() < 1e-11) break;
      std::array<std::array<double, 4>, 3> rows{};  // the Jacobian by differences, and the residual
      for (std::size_t column = 0; column < 3; ++column) {
        Unknowns other = at;
        (column == 0 ? other.log_n_isotropic : column == 1 ? other.log_n_nematic : other.log_odds) += kDifference;
        const std::optional<Residual> there = residual(odds, other, false);
        if (!there) return std::nullopt;
        for (std::size_t row = 0; row < 3; ++row) rows[row][column] = (there->of[row] - now->of[row]) / kDifference;
      }
      for (std::size_t row = 0; row < 3; ++row) rows[row][3] = -now->of[row];
      const std::optional<std::array<double, 3>> change = solution_of(rows);
      if (!change) return std::nullopt;
      const double longest = std::max({std::fabs((*change)[0]), std::fabs((*change)[1]), std::fabs((*change)[2])});
      const double damping = longest > 0.5 ? 0.5 / longest : 1.0;
      at.log_n_isotropic += damping * (*change)[0];
      at.log_n_nematic += damping * (*change)[1];
      at.log_odds += damping * (*change)[2];
      now = residual(odds, at, true);
    }
    if (!now || now->size() > kLargestResidual) return std::nullopt;
    at_ = at;
    return MixtureCoexistence{0.0, now->isotropic, now->nematic, now->size()};
  }

  /// Gauss's elimination with pivots.
  static std::optional<std::array<double, 3>> solution_of(std::array<std::array<double, 4>, 3> rows) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::size_t pivot = k;
      for (std::size_t row = k + 1; row < 3; ++row) {
        if (std::fabs(rows[row][k]) > std::fabs(rows[pivot][k])) pivot = row;
      }
      if (!(std::fabs(rows[pivot][k]) > 0.0)) return std::nullopt;
      std::swap(rows[k], rows[pivot]);
      for (std::size_t row = k + 1; row < 3; ++row) {
        const double factor = rows[row][k] / rows[k][k];
        for (std::size_t column = k; column < 4; ++column) rows[row][column] -= factor * rows[k][column];
      }
    }
    std::array<double, 3> x{};
    for (std::size_t k = 3; k-- > 0;) {
      x[k] = rows[k][3];
      for (std::size_t column = k + 1; column < 3; ++column) x[k] -= rows[k][column] * x[column];
      x[k] /= rows[k][k];
      if (!std::isfinite(x[k])) return std::nullopt;
    }
    return x;
  }

  MixtureFluid fluid_;
  BothDensities isotropic_;
  std::array<EvenSeries, 2> moments_;
  Unknowns at_;
  double odds_ = 0.0;  // of B in the isotropic fluid, their logarithm
};

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
  MixtureBranch branch(mixture);
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
  if (!branch.begin(*pure.found)) {
    result.reason = "the branch was not found at its beginning, the fluid of A alone";
    return result;
  }
  for (const double composition : compositions) {
    std::optional<MixtureCoexistence> found = branch.follow(composition);
    if (!found) {
      result.reason =
          "the branch was lost before a share of " + shortest_number(composition) + " of B in the isotropic fluid";
      break;
    }
    result.found.push_back(std::move(*found));
  }
  return result;
}

}  // namespace vex
