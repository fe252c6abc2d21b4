#include "engine/sampling/percolation/crossing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/numeric/eigen.h"
#include "engine/numeric/errors.h"
#include "engine/sampling/percolation/poisson_law.h"

namespace vex {
namespace {

constexpr Eigen::Index kNC = static_cast<Eigen::Index>(kNCrossingCriteria);
using CriteriaVector = Eigen::Matrix<double, kNC, 1>;
using CriteriaMatrix = Eigen::Matrix<double, kNC, kNC>;

// With how many bodies each criterion was first met.
std::array<std::uint32_t, kNCrossingCriteria> numbers_of(const WrappingNumbers& one) {
  return {one.along[0], one.along[1], one.along[2]};
}

// What one size says at a density: R of each criterion, its covariance and its slope by the density.
struct Observed {
  CriteriaVector value, slope;
  CriteriaMatrix covariance;
};

// A share of each variance is added to it, so that no difference of criteria counts for more than its scatter is known;
// and that of two events, of which the scatter of rare ones would else not be known to be there.
constexpr double kCrossingRidge = 0.01, kFewEvents = 2.0;

Observed observe(const SizedRealisations& size, double density) {
  const PoissonLaw law(density * size.volume);
  const double n = static_cast<double>(size.realisations.size());
  Observed seen{CriteriaVector::Zero(), CriteriaVector::Zero(), CriteriaMatrix::Zero()};
  CriteriaMatrix products = CriteriaMatrix::Zero();
  for (const WrappingNumbers& one : size.realisations) {
    const std::array<std::uint32_t, kNCrossingCriteria> numbers = numbers_of(one);
    CriteriaVector met;
    for (Eigen::Index c = 0; c < kNC; ++c) {
      met[c] = law.at_least(numbers[static_cast<std::size_t>(c)]);
      seen.slope[c] += law.slope(numbers[static_cast<std::size_t>(c)]);
    }
    seen.value += met;
    products += met * met.transpose();
  }
  seen.value /= n;
  seen.slope *= size.volume / n;
  products = products / n - seen.value * seen.value.transpose();
  // The inverse of a covariance of n draws is too large by this factor on average (Hartlap et al. 2007).
  const double few = (n - 1.0) / (n - static_cast<double>(kNC) - 2.0);
  seen.covariance = products * (few / (n - 1.0));
  for (Eigen::Index c = 0; c < kNC; ++c) {
    seen.covariance(c, c) += kCrossingRidge * seen.covariance(c, c) + kFewEvents / (n * n);
  }
  return seen;
}

// Values of the fit: n_c less the density at which R was observed, R_c, and a_c by the size of the smallest cube.
constexpr Eigen::Index kNValues = 1 + 2 * kNC;
struct CrossingFit {
  Eigen::Matrix<double, kNValues, 1> values;
  Eigen::Matrix<double, kNValues, kNValues> covariance;
  double chi_square = 0.0;
};

// Least squares at one density and y: linear.
CrossingFit fit_crossing(std::span<const SizedRealisations> sizes, std::span<const Observed> seen, double unit,
                         double exponent) {
  using Design = Eigen::Matrix<double, kNC, kNValues>;
  double smallest = HUGE_VAL;
  for (const SizedRealisations& size : sizes) smallest = std::fmin(smallest, size.size);
  Eigen::Matrix<double, kNValues, kNValues> information = decltype(information)::Zero();
  Eigen::Matrix<double, kNValues, 1> right = decltype(right)::Zero();
  const double correction_error = kCorrectionError * std::pow(smallest / kCorrectionSize, -kCorrectionExponent);
  // Criteria that hardly move with the density are hardly corrected either.
  const std::size_t at_smallest =
      static_cast<std::size_t>(std::ranges::min_element(sizes, {}, &SizedRealisations::size) - sizes.begin());
  const CriteriaVector slope = seen[at_smallest].slope.cwiseMax(1e-6 * seen[at_smallest].slope.maxCoeff());
  const CriteriaVector scale = (slope / slope.maxCoeff()).cwiseSqrt();
  const CriteriaMatrix corrections =
      scale.asDiagonal() *
      (CriteriaMatrix::Constant(kCorrectionCorrelation) + CriteriaMatrix::Identity() * (1.0 - kCorrectionCorrelation)) *
      scale.asDiagonal();
  const CriteriaMatrix of_corrections =
      corrections.ldlt().solve(CriteriaMatrix::Identity()) / (correction_error * correction_error);
  information.bottomRightCorner<kNC, kNC>() = of_corrections;
  std::vector<Design> designs;
  std::vector<CriteriaMatrix> weights;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    Design& design = designs.emplace_back(Design::Zero());
    design.col(0) = -seen[k].slope * unit;
    for (Eigen::Index c = 0; c < kNC; ++c) {
      design(c, 1 + c) = 1.0;
      design(c, 1 + kNC + c) = std::pow(sizes[k].size / smallest, -exponent);
    }
    weights.push_back(seen[k].covariance.ldlt().solve(CriteriaMatrix::Identity()));
    information += design.transpose() * weights.back() * design;
    right += design.transpose() * weights.back() * seen[k].value;
  }
  CrossingFit fit;
  fit.covariance = information.ldlt().solve(Eigen::Matrix<double, kNValues, kNValues>::Identity());
  fit.values = fit.covariance * right;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const CriteriaVector residual = seen[k].value - designs[k] * fit.values;
    fit.chi_square += residual.dot(weights[k] * residual);
  }
  fit.chi_square += fit.values.tail<kNC>().dot(of_corrections * fit.values.tail<kNC>());
  return fit;
}

// Both halves of each size, its own first.
struct Crossed {
  double density;
  std::vector<Observed> seen;
  CrossingFit fit;
};

// Of each size the two halves of its realisations, each with the covariance and the slopes of the other one. Weights
// that the same realisations had made would go with them: by 1/n of the number of realisations, the threshold would be
// biased.
std::vector<Observed> observe_all(std::span<const SizedRealisations> halves, double density) {
  std::vector<Observed> seen;
  for (const SizedRealisations& half : halves) seen.push_back(observe(half, density));
  for (std::size_t k = 0; k + 1 < seen.size(); k += 2) {
    std::swap(seen[k].covariance, seen[k + 1].covariance);
    std::swap(seen[k].slope, seen[k + 1].slope);
  }
  return seen;
}

std::vector<SizedRealisations> halves_of(std::span<const SizedRealisations> sizes) {
  std::vector<SizedRealisations> halves;
  for (const SizedRealisations& size : sizes) {
    const std::size_t n = size.realisations.size() / 2 * 2, half = n / 2;
    halves.push_back({size.size, size.volume, size.realisations.first(half)});
    halves.push_back({size.size, size.volume, size.realisations.subspan(half, half)});
  }
  return halves;
}

// Where R of a size has a value; R grows with the density.
double density_where(const SizedRealisations& size, std::size_t criterion, double value, double start) {
  double lower = 0.0, upper = 2.0 * start;
  const auto at = [&](double density) {
    return crossing_probability(size.realisations, criterion, density * size.volume);
  };
  for (int k = 0; k < 20 && at(upper) < value; ++k) upper *= 2.0;
  while (upper - lower > 1e-9 * start) {
    const double middle = 0.5 * (lower + upper);
    (at(middle) < value ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper);
}

// Densities between which the threshold is: where the largest cube wraps along an axis hardly ever, and nearly always.
// Beyond them all sizes are alike, and any density would fit.
struct Range {
  double lower, upper;
};
Range range_of(const SizedRealisations& largest, double start) {
  constexpr double kHardly = 0.02;
  Range range{HUGE_VAL, 0.0};
  for (std::size_t c = 0; c < kNCrossingCriteria; ++c) {
    range.lower = std::fmin(range.lower, density_where(largest, c, kHardly, start));
    range.upper = std::fmax(range.upper, density_where(largest, c, 1.0 - kHardly, start));
  }
  return range;
}

// R is not linear in the density, but where it is observed at the threshold that does not matter. So the density is
// looked for from which the fit does not move: the one that fits best, should there be several. Nothing where there is
// none.
std::optional<Crossed> cross(std::span<const SizedRealisations> halves, const Range& range, double exponent) {
  constexpr int kSteps = 24, kMostBisections = 60;
  const auto at = [&](double density) {
    std::vector<Observed> seen = observe_all(halves, density);
    const CrossingFit fit = fit_crossing(halves, seen, density, exponent);
    return Crossed{density, std::move(seen), fit};
  };
  std::optional<Crossed> best;
  Crossed before = at(range.lower);
  for (int k = 1; k <= kSteps; ++k) {
    Crossed here = at(range.lower + (range.upper - range.lower) * k / kSteps);
    if (before.fit.values[0] > 0.0 && here.fit.values[0] <= 0.0) {
      Crossed lower = before, upper = here;
      for (int j = 0; j < kMostBisections && upper.density - lower.density > 1e-9 * upper.density; ++j) {
        // The fit's own step, which is nearly exact, within what is known to hold the density; every fourth time the
        // middle.
        double next = lower.density * (1.0 + lower.fit.values[0]);
        if (j % 2 == 1) next = upper.density * (1.0 + upper.fit.values[0]);
        const double middle = 0.5 * (lower.density + upper.density);
        if (j % 4 == 3 || !(next > lower.density && next < upper.density)) next = middle;
        Crossed found = at(next);
        const bool is_at_threshold = std::fabs(found.fit.values[0]) < 1e-10;
        (found.fit.values[0] > 0.0 ? lower : upper) = std::move(found);
        if (is_at_threshold) {
          if (std::fabs(lower.fit.values[0]) < std::fabs(upper.fit.values[0])) upper = lower;
          break;
        }
      }
      if (!best || upper.fit.chi_square < best->fit.chi_square) best = std::move(upper);
    }
    before = std::move(here);
  }
  return best;
}

}  // namespace

std::string_view name_of_crossing_criterion(std::size_t criterion) {
  constexpr std::array<std::string_view, kNCrossingCriteria> names = {"x", "y", "z"};
  return names[criterion];
}

double crossing_probability(std::span<const WrappingNumbers> realisations, std::size_t criterion, double lambda) {
  const PoissonLaw law(lambda);
  double sum = 0.0;
  for (const WrappingNumbers& one : realisations) sum += law.at_least(numbers_of(one)[criterion]);
  return sum / static_cast<double>(realisations.size());
}

Crossing find_crossing(std::span<const SizedRealisations> sizes) {
  if (sizes.size() < 2) {
    throw UsageError("a system that is not isotropic has a threshold where sizes cross, and one is given - give more");
  }
  for (const SizedRealisations& size : sizes) require_realisations(size.realisations.size());
  const SizedRealisations& largest = *std::ranges::max_element(sizes, {}, &SizedRealisations::size);
  // Near the threshold: where the largest cube wraps along one axis as often as an isotropic one does.
  double start = 0.0;
  for (const double lambda : size_threshold(largest.realisations).lambda) start += lambda / largest.volume / 3.0;
  const Range range = range_of(largest, start);
  const std::vector<SizedRealisations> halves = halves_of(sizes);
  const std::optional<Crossed> found = cross(halves, range, kCorrectionExponent);
  if (!found) throw UsageError("the sizes do not cross anywhere - make more realisations, or larger sizes");
  Crossing crossing;
  Extrapolation& threshold = crossing.threshold;
  const CrossingFit& fit = found->fit;
  threshold.density = found->density;
  threshold.is_extrapolated = true;
  threshold.exponent = kCorrectionExponent;
  threshold.exponent_std_error = kCorrectionExponentError;
  threshold.chi_square = fit.chi_square;
  // Criteria of each half, and what is known of the corrections.
  threshold.degrees_of_freedom =
      static_cast<int>(kNCrossingCriteria * (halves.size() + 1)) - static_cast<int>(kNValues);
  threshold.p_value = chi_square_p_value(fit.chi_square, threshold.degrees_of_freedom);
  // Where the sizes scatter by more than they should, so does the threshold.
  const double excess = std::sqrt(std::fmax(1.0, fit.chi_square / threshold.degrees_of_freedom));
  threshold.scatter_error = excess * std::sqrt(fit.covariance(0, 0)) * found->density;
  const auto moved = [&](double by) {
    return fit_crossing(halves, found->seen, found->density, kCorrectionExponent + by).values[0] * found->density;
  };
  threshold.offset_error = 0.5 * std::fabs(moved(kCorrectionExponentError) - moved(-kCorrectionExponentError));
  threshold.std_error = std::hypot(threshold.scatter_error, threshold.offset_error);
  for (std::size_t c = 0; c < kNCrossingCriteria; ++c) {
    const Eigen::Index row = 1 + static_cast<Eigen::Index>(c);
    crossing.probability[c] = fit.values[row];
    crossing.probability_std_error[c] = excess * std::sqrt(fit.covariance(row, row));
  }
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    Crossing::OfSize& size = crossing.sizes.emplace_back();
    const Observed seen = observe(sizes[k], found->density);
    for (std::size_t c = 0; c < kNCrossingCriteria; ++c) {
      const Eigen::Index row = static_cast<Eigen::Index>(c);
      size.density[c] = density_where(sizes[k], c, crossing.probability[c], found->density);
      size.std_error[c] = std::sqrt(seen.covariance(row, row)) / seen.slope[row];
    }
  }
  if (sizes.size() > 2) {
    std::vector<SizedRealisations> larger(sizes.begin(), sizes.end());
    larger.erase(std::ranges::min_element(larger, {}, &SizedRealisations::size));
    const std::optional<Crossed> without = cross(halves_of(larger), range, kCorrectionExponent);
    if (without) threshold.without_smallest = without->density;
  }
  return crossing;
}

}  // namespace vex
