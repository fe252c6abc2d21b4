#include "engine/sampling/percolation/threshold.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"

namespace vex {
namespace {

// Poisson's law of one mean: P(N >= n) and P(N = n) in a window beyond which there is nothing to double precision.
class PoissonLaw {
 public:
  explicit PoissonLaw(double mean) {
    const double reach = 12.0 * std::sqrt(mean) + 40.0;
    first_ = static_cast<std::int64_t>(std::fmax(0.0, std::floor(mean - reach)));
    const std::int64_t mode = static_cast<std::int64_t>(std::floor(mean));
    const std::size_t n = static_cast<std::size_t>(static_cast<std::int64_t>(std::ceil(mean + reach)) - first_ + 1);
    point_.resize(n);
    // From the mode, where it is 1 before all are divided by their sum.
    const std::size_t middle = static_cast<std::size_t>(mode - first_);
    point_[middle] = 1.0;
    for (std::size_t k = middle; k + 1 < n; ++k) point_[k + 1] = point_[k] * mean / number(k + 1);
    for (std::size_t k = middle; k > 0; --k) point_[k - 1] = point_[k] * number(k) / mean;
    tail_.resize(n + 1);
    for (std::size_t k = n; k-- > 0;) tail_[k] = tail_[k + 1] + point_[k];
    const double sum = tail_[0];
    for (double& p : point_) p /= sum;
    for (double& p : tail_) p /= sum;
  }

  double at_least(std::int64_t n) const {
    if (n <= first_) return 1.0;
    const std::size_t k = static_cast<std::size_t>(n - first_);
    return k < tail_.size() ? tail_[k] : 0.0;
  }
  /// d/d mean of at_least(n), which is P(N = n - 1).
  double slope(std::int64_t n) const {
    const std::int64_t k = n - 1 - first_;
    return k >= 0 && k < static_cast<std::int64_t>(point_.size()) ? point_[static_cast<std::size_t>(k)] : 0.0;
  }

 private:
  double number(std::size_t k) const { return static_cast<double>(first_ + static_cast<std::int64_t>(k)); }

  std::int64_t first_;
  std::vector<double> point_, tail_;
};

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

// The estimate moves with one realisation's value r by (R - r) / (n R'), to first order.
SizeThreshold size_threshold(std::span<const WrappingNumbers> realisations) {
  if (realisations.size() < 2) throw UsageError("a threshold needs two realisations or more - make more of them");
  SizeThreshold result;
  const double n = static_cast<double>(realisations.size());
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
      result.covariance[c][d] = result.covariance[d][c] = sum / (n * (n - 1.0));
    }
  }
  return result;
}

}  // namespace vex
