// Mean of an integrand over independent scramblings of a Sobol' net, with its standard error.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/sampling/integrand.h"
#include "engine/sampling/points/sobol.h"

namespace vex {

struct RandomisedMean {
  double value = 0.0, std_error = 0.0;
  double half_width_sum = 0.0;
  double largest = 0.0;  // of all values
};

/// Coordinate c of point k is at [c * n + k], n = 2^log2_n_points.
inline std::vector<double> scrambled_net(int dimension, int log2_n_points, std::uint64_t seed,
                                         std::uint64_t replicate) {
  const SobolPoints net(dimension);
  const SobolPoints::Scrambling keys = net.scrambling(seed, replicate);
  const std::size_t n = std::size_t{1} << log2_n_points;
  const auto n_coordinates = static_cast<std::size_t>(dimension);
  std::vector<double> points(n_coordinates * n), point(n_coordinates);
  for (std::size_t i = 0; i < n; ++i) {
    net.scrambled(keys, i, point);
    for (std::size_t c = 0; c < n_coordinates; ++c) points[c * n + i] = point[c];
  }
  return points;
}

inline constexpr int kScramblings = 32;

inline RandomisedMean mean_of(Integrand& integrand, int log2_n_points, std::uint64_t seed) {
  std::vector<double> values(std::size_t{1} << log2_n_points);
  RandomisedMean found;
  double sum = 0.0, sum_sq = 0.0, first = 0.0;
  for (int k = 0; k < kScramblings; ++k) {
    const std::vector<double> points =
        scrambled_net(integrand.dimension(), log2_n_points, seed, static_cast<std::uint64_t>(k));
    for (const Doubt& doubt : integrand.evaluate(points, values)) found.half_width_sum += doubt.half_width;
    double of_net = 0.0;
    for (const double value : values) {
      of_net += value;
      found.largest = std::fmax(found.largest, value);
    }
    of_net /= static_cast<double>(values.size());
    if (k == 0) first = of_net;
    sum += of_net - first;  // of what is small: nets agree to many digits
    sum_sq += (of_net - first) * (of_net - first);
  }
  const double mean = sum / kScramblings;
  found.value = first + mean;
  found.std_error = std::sqrt(std::fmax(0.0, sum_sq / kScramblings - mean * mean) / (kScramblings - 1));
  return found;
}

}  // namespace vex
