#include "shapes/nematic/coexistence.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <functional>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

constexpr double kLeastOrder = 0.02;       // below it a density is the isotropic one, or on its way there
constexpr double kLeastAnisotropy = 1e-9;  // of k_2: what quadrature and rounding make of 0

/// Density and slope for a coupling C.
struct Scaling {
  double density = 0.0;  // c
  double slope = 1.0;    // dC / dc
};

Scaling scaling_of(const NematicFluid& fluid, double coupling) {
  if (fluid.theory == NematicTheory::onsager) return {coupling, 1.0};
  // eta (4 - 3 eta) / (4 (1 - eta)^2) = C V / b, solved for eta without a difference of nearly equal numbers.
  const double k = 4.0 * coupling * fluid.volume_by_b2;
  const double eta = k / (k + 2.0 + std::sqrt(k + 4.0)), rest = 1.0 - eta;
  const double g = (4.0 - 3.0 * eta) / (4.0 * rest * rest), g_slope = (5.0 - 3.0 * eta) / (4.0 * rest * rest * rest);
  return {eta / fluid.volume_by_b2, g + eta * g_slope};
}

NematicPhase phase_of(const NematicFluid& fluid, double coupling, double entropy, double interaction) {
  const Scaling scaling = scaling_of(fluid, coupling);
  const double c = scaling.density;
  NematicPhase phase;
  phase.reduced_density = c;
  phase.pressure = c + c * c * interaction * scaling.slope;
  phase.chemical_potential = std::log(c) + entropy + coupling * interaction + c * interaction * scaling.slope;
  return phase;
}

NematicPhase isotropic_of_coupling(const NematicFluid& fluid, double coupling) {
  return phase_of(fluid, coupling, 0.0, 1.0);
}

/// The zero of a function between two points where its signs differ, to the last bits.
double zero_between(const std::function<double(double)>& f, double from, double to) {
  std::uintmax_t most_steps = 200;
  const auto [lower, upper] =
      boost::math::tools::toms748_solve(f, from, to, boost::math::tools::eps_tolerance<double>(52), most_steps);
  return 0.5 * (lower + upper);
}

/// The isotropic fluid of this pressure; one of the coupling `upper` has more.
NematicPhase isotropic_of_pressure(const NematicFluid& fluid, double pressure, double upper) {
  const auto excess = [&](double coupling) { return isotropic_of_coupling(fluid, coupling).pressure - pressure; };
  while (excess(upper) < 0.0) upper *= 2.0;
  double lower = upper;
  while (excess(lower) > 0.0) lower *= 0.5;
  if (excess(lower) == 0.0) return isotropic_of_coupling(fluid, lower);
  return isotropic_of_coupling(fluid, zero_between(excess, lower, upper));
}

/// Ordered fluids along one parameter: the coupling of the density that minimises, or alpha of the trial function.
class OrderedBranch {
 public:
  OrderedBranch(const NematicFluid& fluid, OrientationGrid::Size size) : fluid_(fluid), grid_(fluid.series, size) {}

  struct Point {
    NematicPhase phase;
    double coupling = 0.0;
    bool is_ordered = false;
  };

  Point at(double parameter) {
    const OrientationDensity density =
        fluid_.trial_function ? grid_.trial(parameter) : grid_.equilibrium(parameter, start_);
    Point point;
    point.coupling = fluid_.trial_function ? grid_.coupling_of_trial(parameter) : parameter;
    point.is_ordered = density.converged && density.order_parameter() > kLeastOrder && point.coupling > 0.0;
    if (!point.is_ordered) return point;
    if (!fluid_.trial_function) start_ = density.moments;  // the next one is near
    point.phase = phase_of(fluid_, point.coupling, density.entropy, density.interaction);
    point.phase.order_parameter = density.order_parameter();
    point.phase.cosines = grid_.cosines();
    point.phase.density = density.values;
    return point;
  }

  /// mu of the ordered fluid less that of the isotropic one of the same pressure: below 0 where it is the stable one.
  double excess(const Point& point) const {
    const NematicPhase isotropic = isotropic_of_pressure(fluid_, point.phase.pressure, 1.1 * point.coupling);
    return point.phase.chemical_potential - isotropic.chemical_potential;
  }

  /// Where the branch has ended the isotropic fluid is the stable one.
  double excess_at(double parameter) {
    const Point point = at(parameter);
    return point.is_ordered ? excess(point) : 1.0;
  }

  void start_from(EvenSeries moments) { start_ = std::move(moments); }
  void start_from_alpha(double alpha) { start_ = grid_.trial(alpha).moments; }
  const EvenSeries& start() const { return start_; }

 private:
  const NematicFluid& fluid_;
  OrientationGrid grid_;
  EvenSeries start_;
};

/// Parameters of two points of the branch between which the fluids coexist.
struct Bracket {
  double metastable = 0.0, stable = 0.0;
};

std::optional<Bracket> bracket_of_trials(OrderedBranch& branch) {
  constexpr double kFactor = 1.1, kLargestTrialAlpha = 2000.0;
  double before = 0.0;
  for (double alpha = 1.0; alpha < kLargestTrialAlpha; alpha *= kFactor) {
    const OrderedBranch::Point point = branch.at(alpha);
    if (!point.is_ordered) continue;
    if (branch.excess(point) > 0.0) {
      before = alpha;
    } else if (before > 0.0) {
      return Bracket{before, alpha};
    }
  }
  return std::nullopt;
}

std::optional<Bracket> bracket_of_equilibria(OrderedBranch& branch, double from) {
  constexpr double kUp = 1.03;
  constexpr int kMostStepsUp = 150, kMostStepsDown = 400;
  branch.start_from_alpha(10.0);
  double stable = from;
  OrderedBranch::Point point = branch.at(stable);
  for (int step = 0; step < kMostStepsUp && (!point.is_ordered || branch.excess(point) > 0.0); ++step) {
    if (!point.is_ordered) branch.start_from_alpha(10.0);
    stable *= kUp;
    point = branch.at(stable);
  }
  if (!point.is_ordered || branch.excess(point) > 0.0) return std::nullopt;
  // Down to where it is metastable; beyond the end of the branch the step was too long.
  double down = 0.98;
  for (int step = 0; step < kMostStepsDown; ++step) {
    const EvenSeries kept = branch.start();
    const double next = stable * down;
    point = branch.at(next);
    if (!point.is_ordered) {
      branch.start_from(kept);
      down = std::sqrt(down);
    } else if (branch.excess(point) > 0.0) {
      return Bracket{next, stable};
    } else {
      stable = next;
    }
  }
  return std::nullopt;
}

std::optional<Coexistence> found_on(const NematicFluid& fluid, OrientationGrid::Size size) {
  OrderedBranch branch(fluid, size);
  const std::optional<Bracket> bracket = fluid.trial_function
                                             ? bracket_of_trials(branch)
                                             : bracket_of_equilibria(branch, largest_isotropic_coupling(fluid));
  if (!bracket) return std::nullopt;
  const double parameter =
      zero_between([&](double at) { return branch.excess_at(at); }, bracket->metastable, bracket->stable);
  Coexistence result;
  const OrderedBranch::Point nematic = branch.at(parameter);
  if (!nematic.is_ordered) return std::nullopt;
  result.nematic = nematic.phase;
  result.isotropic = isotropic_of_pressure(fluid, nematic.phase.pressure, 1.1 * nematic.coupling);
  // Of the coarse grid: a picture needs no more.
  if (size == OrientationGrid::Size::doubled) return result;
  constexpr int kPoints = 60;
  const double last = fluid.trial_function ? 3.0 : 1.5;  // times the parameter at coexistence
  for (int k = 0; k <= kPoints; ++k) {
    const OrderedBranch::Point point = branch.at(parameter * (1.0 + (last - 1.0) * k / kPoints));
    if (point.is_ordered) result.branch.push_back(point.phase);
  }
  return result;
}

double relative_change(double x, double y) { return std::fabs(x - y) / std::max(std::fabs(x), std::fabs(y)); }

}  // namespace

NematicPhase isotropic_phase(const NematicFluid& fluid, double reduced_density) {
  if (fluid.theory == NematicTheory::onsager) return isotropic_of_coupling(fluid, reduced_density);
  const double eta = reduced_density * fluid.volume_by_b2, rest = 1.0 - eta;
  return isotropic_of_coupling(fluid, reduced_density * (4.0 - 3.0 * eta) / (4.0 * rest * rest));
}

double largest_isotropic_coupling(const NematicFluid& fluid) { return -2.5 / fluid.series.at(1); }

CoexistenceResult coexistence(const NematicFluid& fluid) {
  if (fluid.theory == NematicTheory::parsons_lee && !(fluid.volume_by_b2 > 0.0)) {
    throw UsageError(
        "a flat body has no volume, which the scaling of Parsons and Lee is about - take Onsager's theory");
  }
  CoexistenceResult result;
  if (fluid.series.size() < 2 || !(fluid.series[1] < -kLeastAnisotropy)) {
    result.reason = "bodies whose axes are aligned exclude no less than others do, so nothing makes them align";
    return result;
  }
  const std::optional<Coexistence> coarse = found_on(fluid, OrientationGrid::Size::usual);
  std::optional<Coexistence> fine = coarse ? found_on(fluid, OrientationGrid::Size::doubled) : std::nullopt;
  if (!fine) {
    result.reason =
        "no density was found at which an ordered and the isotropic fluid have one pressure and one chemical "
        "potential";
    return result;
  }
  fine->grid_error = std::max({relative_change(coarse->isotropic.reduced_density, fine->isotropic.reduced_density),
                               relative_change(coarse->nematic.reduced_density, fine->nematic.reduced_density),
                               relative_change(coarse->nematic.order_parameter, fine->nematic.order_parameter),
                               relative_change(coarse->nematic.pressure, fine->nematic.pressure)});
  fine->branch = coarse->branch;
  result.found = std::move(fine);
  return result;
}

}  // namespace vex
