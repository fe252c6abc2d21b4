#include "engine/sampling/percolation/extrapolation.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "engine/numeric/eigen.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

constexpr Eigen::Index kN = static_cast<Eigen::Index>(kNWrappingCriteria);

struct Fit {
  Eigen::VectorXd values;  // the density, then the amplitudes, in units of the first threshold and of the largest size
  double error, universal_error, chi_square;
};

// Least squares with the covariance of each size's criteria. Sizes are in units of the largest and densities in units
// of the first, so that the equations are well scaled.
Fit fit(std::span<const SizedThreshold> sizes, double exponent) {
  const bool has_amplitudes = sizes.size() > 1;
  const Eigen::Index n_values = has_amplitudes ? 1 + kN : 1;
  double largest = 0.0;
  for (const SizedThreshold& size : sizes) largest = std::fmax(largest, size.size);
  const double unit = sizes.front().density.front();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n_values, n_values);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n_values);
  // How the solution moves with each criterion's universal value, which is common to all sizes.
  Eigen::MatrixXd by_universal = Eigen::MatrixXd::Zero(n_values, kN);
  std::vector<Eigen::Matrix3d> weights;
  std::vector<Eigen::MatrixXd> designs;
  std::vector<Eigen::Vector3d> data;
  for (const SizedThreshold& size : sizes) {
    Eigen::Matrix3d covariance;
    Eigen::Vector3d density;
    Eigen::Matrix3d universal = Eigen::Matrix3d::Zero();
    Eigen::MatrixXd design = Eigen::MatrixXd::Zero(kN, n_values);
    for (Eigen::Index c = 0; c < kN; ++c) {
      const std::size_t row = static_cast<std::size_t>(c);
      density[c] = size.density[row] / unit;
      universal(c, c) = size.universal_error[row] / unit;
      for (Eigen::Index d = 0; d < kN; ++d) {
        covariance(c, d) = size.covariance[row][static_cast<std::size_t>(d)] / (unit * unit);
      }
      design(c, 0) = 1.0;
      if (has_amplitudes) design(c, 1 + c) = std::pow(size.size / largest, -exponent);
    }
    const Eigen::Matrix3d weight = covariance.ldlt().solve(Eigen::Matrix3d::Identity());
    normal += design.transpose() * weight * design;
    right += design.transpose() * weight * density;
    by_universal += design.transpose() * weight * universal;
    weights.push_back(weight);
    designs.push_back(design);
    data.push_back(density);
  }
  const Eigen::MatrixXd inverse = normal.ldlt().solve(Eigen::MatrixXd::Identity(n_values, n_values));
  Fit result;
  result.values = inverse * right;
  result.error = std::sqrt(std::fmax(0.0, inverse(0, 0))) * unit;
  result.universal_error = (inverse * by_universal).row(0).norm() * unit;
  result.chi_square = 0.0;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const Eigen::Vector3d residual = data[k] - designs[k] * result.values;
    result.chi_square += residual.dot(weights[k] * residual);
  }
  result.values *= unit;
  if (has_amplitudes) result.values.tail(kN) *= std::pow(largest, exponent);
  return result;
}

}  // namespace

SizedThreshold sized_threshold(const SizeThreshold& threshold, double size, double volume) {
  SizedThreshold sized;
  sized.size = size;
  for (std::size_t c = 0; c < kNWrappingCriteria; ++c) {
    sized.density[c] = threshold.lambda[c] / volume;
    sized.universal_error[c] = threshold.universal_error[c] / volume;
    for (std::size_t d = 0; d < kNWrappingCriteria; ++d) {
      sized.covariance[c][d] = threshold.covariance[c][d] / volume / volume;
    }
  }
  return sized;
}

Extrapolation extrapolate(std::span<const SizedThreshold> sizes) {
  if (sizes.empty()) throw UsageError("no size is given - give one");
  for (const SizedThreshold& size : sizes) {
    for (std::size_t c = 0; c < kNWrappingCriteria; ++c) {
      if (!(size.covariance[c][c] > 0.0)) {
        throw UsageError("realisations of a size do not scatter, and their errors are unknown - make more of them");
      }
    }
  }
  const Fit best = fit(sizes, kSizeExponent);
  Extrapolation result;
  result.density = best.values[0];
  result.scatter_error = best.error;
  result.universal_error = best.universal_error;
  result.chi_square = best.chi_square;
  result.is_extrapolated = sizes.size() > 1;
  result.degrees_of_freedom =
      static_cast<int>(kNWrappingCriteria * sizes.size()) - static_cast<int>(best.values.size());
  result.p_value = boost::math::gamma_q(0.5 * result.degrees_of_freedom, 0.5 * result.chi_square);
  if (result.is_extrapolated) {
    for (std::size_t c = 0; c < kNWrappingCriteria; ++c) {
      result.amplitude[c] = best.values[1 + static_cast<Eigen::Index>(c)];
    }
    const double more = fit(sizes, kSizeExponent + kSizeExponentError).values[0];
    const double less = fit(sizes, kSizeExponent - kSizeExponentError).values[0];
    result.exponent_error = 0.5 * std::fabs(more - less);
  }
  result.std_error = std::hypot(result.scatter_error, result.exponent_error, result.universal_error);
  if (sizes.size() > 2) {
    std::vector<SizedThreshold> larger(sizes.begin(), sizes.end());
    larger.erase(std::ranges::min_element(larger, {}, &SizedThreshold::size));
    result.without_smallest = fit(larger, kSizeExponent).values[0];
  }
  return result;
}

}  // namespace vex
