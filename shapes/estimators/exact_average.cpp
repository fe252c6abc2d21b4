#include "shapes/estimators/exact_average.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "engine/numeric/double_double.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/numeric/interruption.h"
#include "engine/sampling/points/sobol.h"
#include "shapes/estimators/axial_average.h"
#include "shapes/estimators/legendre_average.h"
#include "shapes/estimators/mixed_volume_estimator.h"

namespace vex {
namespace {

constexpr double kSeriesError = 1e-6;  // relative: above it, random points may do better

int log2_n_points(const MixedVolumeEstimator& estimator, const ExactAverageSettings& settings) {
  int log2_n = settings.log2_n_points;
  while (log2_n > 4 && std::ldexp(estimator.cost(), log2_n) * settings.n_randomisations > settings.largest_cost) {
    --log2_n;
  }
  return log2_n;
}

/// Mean and standard error over the unit cube, from as many randomisations as the settings ask for.
ExactAverage quasi_monte_carlo(MixedVolumeEstimator& estimator, const ExactAverageSettings& settings) {
  constexpr std::size_t kBatch = 64;
  const auto dimension = static_cast<std::size_t>(estimator.dimension());
  const SobolPoints net(estimator.dimension());
  const std::size_t n_points = std::size_t{1} << log2_n_points(estimator, settings);
  const auto is_interrupted = [&] { return settings.interrupt != nullptr && settings.interrupt->load() != 0; };
  const std::size_t batch = std::min(kBatch, n_points);
  std::vector<double> means, point(dimension), points(dimension * batch), values(batch);
  for (int k = 0; k < settings.n_randomisations; ++k) {
    const SobolPoints::Scrambling keys = net.scrambling(settings.seed, static_cast<std::uint64_t>(k));
    DoubleDouble sum;
    for (std::size_t first = 0; first < n_points && !is_interrupted(); first += batch) {  // both powers of two
      for (std::size_t i = 0; i < batch; ++i) {
        net.scrambled(keys, first + i, point);
        for (std::size_t c = 0; c < dimension; ++c) points[c * batch + i] = point[c];
      }
      end_if_interrupted();
      estimator.evaluate(points, values);
      for (const double value : values) sum += value;
    }
    if (is_interrupted()) break;
    means.push_back(sum.value() / static_cast<double>(n_points));
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (means.empty()) return {std::nan(""), kInfinity};
  const auto n = static_cast<double>(means.size());
  const double mean = std::accumulate(means.begin(), means.end(), 0.0) / n;
  double squares = 0.0;
  for (const double m : means) squares += (m - mean) * (m - mean);
  return {mean, means.size() < 2 ? kInfinity : std::sqrt(squares / (n * (n - 1.0)))};
}

}  // namespace

ExactAverage exact_average(const Body& a, const Body& b, const OrientationLaw& law,
                           const ExactAverageSettings& settings) {
  if (settings.n_randomisations < 2) {
    throw UsageError("too few randomisations to tell an error (" + std::to_string(settings.n_randomisations) +
                     ") - give two at least");
  }
  if (settings.log2_n_points < 0 || settings.log2_n_points > SobolPoints::kBits) {
    throw UsageError("no number of points (2 to the power of " + std::to_string(settings.log2_n_points) +
                     ") - give a power from 0 to " + std::to_string(SobolPoints::kBits));
  }
  if (!(settings.largest_cost >= 0.0)) throw UsageError("a largest cost is negative or no number - give one from 0 up");
  if (settings.series) {
    const std::optional<SeriesAverage> series =
        law.kind() == OrientationLaw::Kind::angle ? axial_average(a, b, law) : legendre_average(a, b, law);
    if (series && series->error <= kSeriesError * series->excluded_volume) {
      return {series->excluded_volume, series->error};
    }
  }
  MixedVolumeEstimator estimator(a, b, law);
  ExactAverage average;
  if (estimator.is_one_sum()) {
    const double point = 0.5;
    estimator.evaluate({&point, 1}, {&average.excluded_volume, 1});
  } else {
    average = quasi_monte_carlo(estimator, settings);
  }
  if (!std::isinf(average.error)) average.error += estimator.rounding(average.excluded_volume);  // not interrupted
  return average;
}

}  // namespace vex
