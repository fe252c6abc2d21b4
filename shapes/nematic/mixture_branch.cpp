#include "shapes/nematic/mixture_branch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vex {
namespace {

constexpr double kLeastOrderOfBranch = 0.02;  // below it a fluid is on its way to the isotropic one
constexpr double kLargestResidual = 1e-9;

TwoDensities densities_of(double log_n, double odds) {
  const double n = std::exp(log_n);
  return {n / (1.0 + std::exp(odds)), n / (1.0 + std::exp(-odds))};
}

using Three = std::array<double, 3>;

// What equilibrium asks to be 0.
Three differences(const BranchPoint& at) {
  return {std::log(at.nematic.pressure / at.isotropic.pressure),
          at.nematic.chemical_potentials[0] - at.isotropic.chemical_potentials[0],
          at.nematic.chemical_potentials[1] - at.isotropic.chemical_potentials[1]};
}

double largest(const Three& of) { return std::max({std::fabs(of[0]), std::fabs(of[1]), std::fabs(of[2])}); }

/// Gauss's elimination with pivots.
std::optional<std::array<double, 3>> solution_of(std::array<std::array<double, 4>, 3> rows) {
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

double distance(const BranchPoint& x, const BranchPoint& y) {
  const Three densities_and_share = {x.log_n_isotropic - y.log_n_isotropic, x.log_n_nematic - y.log_n_nematic,
                                     x.odds_of_isotropic - y.odds_of_isotropic};
  return std::max(largest(densities_and_share), std::fabs(x.odds_of_nematic - y.odds_of_nematic));
}

// On the line through two points of the branch, from the one at t = 0 to the one at t = 1 and beyond.
BranchPoint along(const BranchPoint& from, const BranchPoint& to, double t) {
  BranchPoint point = t < 0.5 ? from : to;
  for (double BranchPoint::*const coordinate : {&BranchPoint::log_n_isotropic, &BranchPoint::log_n_nematic,
                                                &BranchPoint::odds_of_isotropic, &BranchPoint::odds_of_nematic}) {
    point.*coordinate = std::lerp(from.*coordinate, to.*coordinate, t);
  }
  return point;
}

// Of a disc beside rods it may be negative.
bool is_ordered(const BothDensities& both) {
  return std::max(std::fabs(both.of[0].order_parameter()), std::fabs(both.of[1].order_parameter())) >
         kLeastOrderOfBranch;
}

std::array<double*, 3> unknowns_of(BranchPoint& at, MixtureBranch::Held held) {
  return {&at.log_n_isotropic, &at.log_n_nematic,
          held == MixtureBranch::Held::isotropic_share ? &at.odds_of_nematic : &at.odds_of_isotropic};
}

}  // namespace

double log_odds_of(double share_of_b) { return std::log(share_of_b / (1.0 - share_of_b)); }

bool MixtureBranch::set_phases(BranchPoint* point) const {
  const TwoDensities n = densities_of(point->log_n_nematic, point->odds_of_nematic);
  const BothDensities both = fluid_.equilibrium(n, point->moments);
  if (!both.converged || !is_ordered(both)) return false;
  if (fluid_.is_too_sharp(both)) return false;
  point->moments = {both.of[0].moments, both.of[1].moments};
  point->isotropic = fluid_.phase(densities_of(point->log_n_isotropic, point->odds_of_isotropic), isotropic_);
  point->nematic = fluid_.phase(n, both);
  return std::isfinite(largest(differences(*point)));
}

std::optional<BranchPoint> MixtureBranch::solve(BranchPoint at, Held held) const {
  constexpr int kMostNewtonSteps = 12;
  constexpr double kDifference = 1e-6, kSettled = 1e-11;
  bool is_fluid = set_phases(&at);
  for (int step = 0; is_fluid && step < kMostNewtonSteps; ++step) {
    const Three now = differences(at);
    if (largest(now) < kSettled) break;
    std::array<std::array<double, 4>, 3> rows{};  // the Jacobian by differences, and the residual
    for (std::size_t column = 0; column < 3; ++column) {
      BranchPoint other = at;
      *unknowns_of(other, held)[column] += kDifference;
      if (!set_phases(&other)) return std::nullopt;
      const Three there = differences(other);
      for (std::size_t row = 0; row < 3; ++row) rows[row][column] = (there[row] - now[row]) / kDifference;
    }
    for (std::size_t row = 0; row < 3; ++row) rows[row][3] = -now[row];
    const std::optional<Three> change = solution_of(rows);
    if (!change) return std::nullopt;
    const double longest = largest(*change), damping = longest > 0.5 ? 0.5 / longest : 1.0;
    const std::array<double*, 3> unknowns = unknowns_of(at, held);
    for (std::size_t k = 0; k < 3; ++k) *unknowns[k] += damping * (*change)[k];
    is_fluid = set_phases(&at);
  }
  if (!is_fluid) return std::nullopt;
  at.residual = largest(differences(at));
  if (!(at.residual <= kLargestResidual)) return std::nullopt;
  return at;
}

std::optional<BranchPoint> MixtureBranch::begin(const Coexistence& of_a) const {
  const double trace = log_odds_of(kTraceOfB);
  BranchPoint at;
  at.log_n_isotropic = std::log(of_a.isotropic.reduced_density / fluid_.b(0, 0));
  at.log_n_nematic = std::log(of_a.nematic.reduced_density / fluid_.b(0, 0));
  at.odds_of_isotropic = at.odds_of_nematic = trace;
  at.moments = {fluid_.start_of_order(), fluid_.start_of_order()};
  if (!set_phases(&at)) return std::nullopt;
  // B's own order and share follow from A's: its potentials are equal in both fluids. By how much the odds of B in the
  // nematic fluid are larger:
  const double shift = at.isotropic.chemical_potentials[1] - at.nematic.chemical_potentials[1];
  at.odds_of_nematic = trace + std::min(0.0, shift);
  at.odds_of_isotropic = at.odds_of_nematic - shift;
  return solve(std::move(at), Held::nematic_share);
}

MixtureBranch::Trace MixtureBranch::trace(const Coexistence& of_a) const {
  constexpr double kSmallestStep = 1e-6, kLargestStep = 0.5, kFarthest = 0.25;
  constexpr std::size_t kMostPoints = 4000;
  Trace trace;
  std::optional<BranchPoint> first = begin(of_a);
  if (!first) {
    trace.reason = "the branch was not found at its beginning, the fluid of A alone";
    return trace;
  }
  trace.points.push_back(std::move(*first));
  const double end = -log_odds_of(kTraceOfB);
  double step = kLargestStep;
  while (step >= kSmallestStep && trace.points.size() < kMostPoints) {
    const BranchPoint& last = trace.points.back();
    if (std::min(last.odds_of_isotropic, last.odds_of_nematic) >= end) return trace;
    // Along the line through the last two; at the beginning both shares grow alike. Either share turns back somewhere:
    // held is the one that changes more.
    BranchPoint guess = last;
    Held held = Held::nematic_share;
    if (trace.points.size() < 2) {
      guess.odds_of_nematic += step;
      guess.odds_of_isotropic += step;
    } else {
      const BranchPoint& before = trace.points[trace.points.size() - 2];
      const double nematic = last.odds_of_nematic - before.odds_of_nematic,
                   isotropic = last.odds_of_isotropic - before.odds_of_isotropic;
      if (std::fabs(isotropic) > std::fabs(nematic)) held = Held::isotropic_share;
      guess = along(before, last, 1.0 + step / std::max(std::fabs(isotropic), std::fabs(nematic)));
    }
    std::optional<BranchPoint> next = solve(guess, held);
    // Newton's method may end at an equilibrium elsewhere: of the branch is what lies next to the guess.
    if (next && distance(*next, guess) <= kFarthest * std::min(1.0, 4.0 * step)) {
      trace.points.push_back(std::move(*next));
      step = std::min(kLargestStep, 1.5 * step);
    } else {
      step *= 0.5;
    }
  }
  const BranchPoint& last = trace.points.back();
  trace.reason = "the branch was lost at a share of " + std::to_string(last.nematic.composition()) +
                 " of B in the nematic fluid, with order parameters " +
                 std::to_string(last.nematic.order_parameters[0]) + " of A and " +
                 std::to_string(last.nematic.order_parameters[1]) + " of B";
  // A little further on.
  const BothDensities beyond =
      fluid_.equilibrium(densities_of(last.log_n_nematic + 1e-3, last.odds_of_nematic + 1e-3), last.moments);
  if (fluid_.is_too_sharp(beyond)) trace.reason += ": ordered more sharply than 256 Legendre polynomials resolve";
  return trace;
}

void MixtureBranch::find_between(const BranchPoint& low, const BranchPoint& high, double odds_of_isotropic,
                                 std::vector<BranchPoint>* found, int depth) const {
  constexpr int kDeepest = 12;
  const double from = low.odds_of_isotropic, to = high.odds_of_isotropic;
  if ((from < odds_of_isotropic) == (to < odds_of_isotropic)) return;
  const double length = distance(low, high);
  BranchPoint guess = along(low, high, (odds_of_isotropic - from) / (to - from));
  guess.odds_of_isotropic = odds_of_isotropic;
  const std::optional<BranchPoint> one = solve(guess, Held::isotropic_share);
  if (one && distance(*one, guess) <= 0.5 * length) {
    found->push_back(*one);
    return;
  }
  if (depth == kDeepest) return;
  const bool is_steep = std::fabs(to - from) > std::fabs(high.odds_of_nematic - low.odds_of_nematic);
  const std::optional<BranchPoint> middle =
      solve(along(low, high, 0.5), is_steep ? Held::isotropic_share : Held::nematic_share);
  if (!middle) return;
  find_between(low, *middle, odds_of_isotropic, found, depth + 1);
  find_between(*middle, high, odds_of_isotropic, found, depth + 1);
}

}  // namespace vex
