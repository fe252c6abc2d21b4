#include "engine/sampling/percolation/threshold.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/sampling/percolation/poisson_law.h"

namespace vex {
namespace {

// Of one realisation: f(n) of the number of bodies that the criterion asks for.
template <class OfNumber>
double of_criterion(const WrappingNumbers& numbers, WrappingCriterion criterion, const OfNumber& f) {
  switch (criterion) {
    case WrappingCriterion::x: return (f(numbers.along[0]) + f(numbers.along[1]) + f(numbers.along[2])) / 3.0;
    case WrappingCriterion::any: return f(numbers.any());
    case WrappingCriterion::all: return f(numbers.all());
  }
  return 0.0;
}

struct Probability {
  double value, slope;
};

Probability probability(std::span<const WrappingNumbers> realisations, WrappingCriterion criterion, double lambda) {
  const PoissonLaw law(lambda);
  double value = 0.0, slope = 0.0;
  for (const WrappingNumbers& numbers : realisations) {
    value += of_criterion(numbers, criterion, [&](std::uint32_t n) { return law.at_least(n); });
    slope += of_criterion(numbers, criterion, [&](std::uint32_t n) { return law.slope(n); });
  }
  const double n = static_cast<double>(realisations.size());
  return {value / n, slope / n};
}

// R grows with lambda, from 0 to 1. Newton's steps, or bisection where they leave what is known to hold the root.
double solve(std::span<const WrappingNumbers> realisations, WrappingCriterion criterion) {
  const double goal = universal_probability(criterion).value;
  double lower = 0.0, upper = 0.0;
  for (const WrappingNumbers& numbers : realisations) upper = std::fmax(upper, numbers.all());
  upper += 12.0 * std::sqrt(upper) + 40.0;
  double lambda = 0.5 * upper;
  for (int k = 0; k < 200; ++k) {
    const Probability at = probability(realisations, criterion, lambda);
    (at.value < goal ? lower : upper) = lambda;
    double next = at.slope > 0.0 ? lambda + (goal - at.value) / at.slope : 0.0;
    if (!(next > lower && next < upper)) next = 0.5 * (lower + upper);
    const bool is_done = std::fabs(next - lambda) <= 0x1p-40 * lambda;
    lambda = next;
    if (is_done) break;
  }
  return lambda;
}

}  // namespace

std::string_view name_of(WrappingCriterion criterion) {
  constexpr std::array<std::string_view, kNWrappingCriteria> names = {"x", "any", "all"};
  return names[static_cast<std::size_t>(criterion)];
}

UniversalProbability universal_probability(WrappingCriterion criterion) {
  constexpr std::array<UniversalProbability, kNWrappingCriteria> values = {
      {{0.25780, 6e-5}, {0.45998, 8e-5}, {0.08041, 8e-5}}};
  return values[static_cast<std::size_t>(criterion)];
}

double wrapping_probability(std::span<const WrappingNumbers> realisations, WrappingCriterion criterion, double lambda) {
  VEX_EXPECT(lambda > 0.0 && !realisations.empty());
  return probability(realisations, criterion, lambda).value;
}

void require_realisations(std::size_t n) {
  if (n >= kFewestRealisations) return;
  throw UsageError("a threshold needs " + std::to_string(kFewestRealisations) +
                   " realisations of each size or more, and of one there are " + std::to_string(n) +
                   " - make more of them");
}

// The estimate moves with one realisation's value r by (R - r) / (n R'), to first order.
SizeThreshold size_threshold(std::span<const WrappingNumbers> realisations) {
  require_realisations(realisations.size());
  SizeThreshold result;
  const double n = static_cast<double>(realisations.size());
  // Fits weigh by the inverse of a covariance of n draws, which is uncertain and too large on average (J. Hartlap, P.
  // Simon and P. Schneider, Astron. Astrophys. 464, 399, 2007). With this factor the errors of extrapolated thresholds
  // of cubes and of spheres are as large as their scatter, to a tenth, from 50 realisations of each size on.
  constexpr double kFewer = 15.0;
  const double few = n / (n - kFewer);
  std::array<std::vector<double>, kNWrappingCriteria> moves;
  for (std::size_t c = 0; c < kNWrappingCriteria; ++c) {
    const WrappingCriterion criterion = static_cast<WrappingCriterion>(c);
    const double lambda = solve(realisations, criterion);
    const Probability at = probability(realisations, criterion, lambda);
    result.lambda[c] = lambda;
    result.universal_error[c] = universal_probability(criterion).std_error / at.slope;
    const PoissonLaw law(lambda);
    moves[c].reserve(realisations.size());
    for (const WrappingNumbers& numbers : realisations) {
      const double value = of_criterion(numbers, criterion, [&](std::uint32_t k) { return law.at_least(k); });
      moves[c].push_back((at.value - value) / at.slope);
    }
  }
  for (std::size_t c = 0; c < kNWrappingCriteria; ++c) {
    for (std::size_t d = 0; d <= c; ++d) {
      double sum = 0.0;
      for (std::size_t k = 0; k < realisations.size(); ++k) sum += moves[c][k] * moves[d][k];
      result.covariance[c][d] = result.covariance[d][c] = few * sum / (n * (n - 1.0));
    }
  }
  return result;
}

}  // namespace vex
