#include "engine/sampling/percolation/extrapolation.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "engine/numeric/eigen.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

constexpr Eigen::Index kN = static_cast<Eigen::Index>(kNWrappingCriteria);

// Sizes in units of the largest and densities in units of the first, so that the equations are well scaled.
struct Units {
  explicit Units(std::span<const SizedThreshold> sizes) : density(sizes.front().density.front()) {
    for (const SizedThreshold& one : sizes) size = std::fmax(size, one.size);
  }
  double density, size = 0.0;
};

// What is fitted: the density, then the criteria's amplitudes of the terms, and theta, where there are several sizes.
struct Fit {
  Eigen::VectorXd values;
  Eigen::MatrixXd covariance;
  double universal_error = 0.0;
  double next_error = 0.0;  // of b beforehand
  double chi_square = 0.0;  // what is known of theta and b beforehand counts as data
  double theta_step = 0.0;  // by which theta is off its best value, to first order
};

// Least squares with the covariance of each size's criteria, at one theta; its column, and what is known of it, come in
// where the amplitudes are known. Linear but for theta.
Fit fit_at(std::span<const SizedThreshold> sizes, const Units& units, double theta) {
  const bool has_amplitudes = sizes.size() > 1;
  const Eigen::Index n_terms = has_amplitudes ? 2 : 0, n_linear = 1 + kN * n_terms,
                     n_values = n_linear + (n_terms > 0 ? 1 : 0);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n_linear, n_linear);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n_linear);
  struct Size {
    Eigen::Matrix3d weight, universal;
    Eigen::MatrixXd design;
    Eigen::Vector3d density;
    double log_size;
  };
  std::vector<Size> rows;
  for (const SizedThreshold& one : sizes) {
    Size& row = rows.emplace_back();
    Eigen::Matrix3d covariance;
    row.universal = Eigen::Matrix3d::Zero();
    row.design = Eigen::MatrixXd::Zero(kN, n_values);
    row.log_size = std::log(one.size / units.size);
    for (Eigen::Index c = 0; c < kN; ++c) {
      const std::size_t k = static_cast<std::size_t>(c);
      row.density[c] = one.density[k] / units.density;
      row.universal(c, c) = one.universal_error[k] / units.density;
      for (Eigen::Index d = 0; d < kN; ++d) {
        covariance(c, d) = one.covariance[k][static_cast<std::size_t>(d)] / (units.density * units.density);
      }
      row.design(c, 0) = 1.0;
      if (has_amplitudes) row.design(c, 1 + c) = std::exp(-theta * row.log_size);
      if (has_amplitudes) row.design(c, 1 + kN + c) = std::exp(-kNextSizeExponent * row.log_size);
    }
    // Criteria that are met by the same bodies always would else weigh without end.
    constexpr double kSameRidge = 1e-4;
    covariance.diagonal() *= 1.0 + kSameRidge;
    row.weight = covariance.ldlt().solve(Eigen::Matrix3d::Identity());
    const Eigen::MatrixXd linear = row.design.leftCols(n_linear);
    normal += linear.transpose() * row.weight * linear;
    right += linear.transpose() * row.weight * row.density;
  }
  // Of b, which is 0 to within this.
  const double next_error = kNextAmplitudeError * std::pow(units.size, -kNextSizeExponent);
  const double next_weight = 1.0 / (next_error * next_error);
  for (Eigen::Index c = 0; has_amplitudes && c < kN; ++c) normal(1 + kN + c, 1 + kN + c) += next_weight;
  Fit result;
  result.next_error = next_error;
  result.values = Eigen::VectorXd::Constant(n_values, theta);
  result.values.head(n_linear) = normal.ldlt().solve(right);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n_values, n_values);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(n_values);
  // How the solution moves with each criterion's universal value, which is common to all sizes.
  Eigen::MatrixXd by_universal = Eigen::MatrixXd::Zero(n_values, kN);
  for (Size& row : rows) {
    const Eigen::Vector3d residual = row.density - row.design.leftCols(n_linear) * result.values.head(n_linear);
    result.chi_square += residual.dot(row.weight * residual);
    if (has_amplitudes) {
      for (Eigen::Index c = 0; c < kN; ++c) {
        row.design(c, n_linear) = -row.log_size * row.design(c, 1 + c) * result.values[1 + c];
      }
    }
    information += row.design.transpose() * row.weight * row.design;
    gradient += row.design.transpose() * row.weight * residual;
    by_universal += row.design.transpose() * row.weight * row.universal;
  }
  if (has_amplitudes) {
    information(n_linear, n_linear) += 1.0 / (kSizeExponentError * kSizeExponentError);
    const double off = (theta - kSizeExponent) / kSizeExponentError;
    result.chi_square += off * off;
    gradient[n_linear] -= off / kSizeExponentError;
    for (Eigen::Index c = 0; c < kN; ++c) {
      const Eigen::Index at = 1 + kN + c;
      information(at, at) += next_weight;
      gradient[at] -= next_weight * result.values[at];
      result.chi_square += next_weight * result.values[at] * result.values[at];
    }
  }
  result.covariance = information.ldlt().solve(Eigen::MatrixXd::Identity(n_values, n_values));
  if (has_amplitudes) result.theta_step = result.covariance.row(n_linear).dot(gradient);
  result.universal_error = (result.covariance * by_universal).row(0).norm();
  return result;
}

// Theta where chi^2 is least: by the golden section, which finds it whatever the start, then by Gauss and Newton's
// steps.
Fit fit(std::span<const SizedThreshold> sizes, const Units& units) {
  if (sizes.size() < 2) return fit_at(sizes, units, kSizeExponent);
  constexpr double kGolden = 0.6180339887498949, kMostOff = 4.0 * kSizeExponentError, kClose = 1e-3;
  double lower = kSizeExponent - kMostOff, upper = kSizeExponent + kMostOff;
  double left = upper - kGolden * (upper - lower), right = lower + kGolden * (upper - lower);
  double at_left = fit_at(sizes, units, left).chi_square, at_right = fit_at(sizes, units, right).chi_square;
  while (upper - lower > kClose) {
    if (at_left < at_right) {
      upper = right;
      right = left;
      at_right = at_left;
      left = upper - kGolden * (upper - lower);
      at_left = fit_at(sizes, units, left).chi_square;
    } else {
      lower = left;
      left = right;
      at_left = at_right;
      right = lower + kGolden * (upper - lower);
      at_right = fit_at(sizes, units, right).chi_square;
    }
  }
  Fit best = fit_at(sizes, units, 0.5 * (lower + upper));
  for (int k = 0; k < 4 && std::fabs(best.theta_step) < 10.0 * kClose; ++k) {
    best = fit_at(sizes, units, best.values[best.values.size() - 1] + best.theta_step);
  }
  return best;
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

double chi_square_p_value(double chi_square, int degrees_of_freedom) {
  return boost::math::gamma_q(0.5 * degrees_of_freedom, 0.5 * std::fmax(chi_square, 0.0));
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
  const Units units(sizes);
  const Fit best = fit(sizes, units);
  Extrapolation result;
  result.density = best.values[0] * units.density;
  result.universal_error = best.universal_error * units.density;
  result.chi_square = best.chi_square;
  result.is_extrapolated = sizes.size() > 1;
  // Criteria and sizes, theta and each b; less as many as are fitted.
  result.degrees_of_freedom = static_cast<int>(kNWrappingCriteria * sizes.size()) +
                              (result.is_extrapolated ? 1 + static_cast<int>(kN) : 0) -
                              static_cast<int>(best.values.size());
  result.p_value = chi_square_p_value(result.chi_square, result.degrees_of_freedom);
  double variance = std::fmax(0.0, best.covariance(0, 0));
  if (result.is_extrapolated) {
    const Eigen::Index theta = best.values.size() - 1;
    for (Eigen::Index c = 0; c < kN; ++c) {
      result.amplitude[static_cast<std::size_t>(c)] =
          best.values[1 + c] * units.density * std::pow(units.size, best.values[theta]);
    }
    result.exponent = best.values[theta];
    result.exponent_std_error = std::sqrt(std::fmax(0.0, best.covariance(theta, theta)));
    // How the density moves with what is known of theta and of each b beforehand, times the error of that.
    double offset = best.covariance(0, theta) / kSizeExponentError;
    for (Eigen::Index c = 0; c < kN; ++c) offset = std::hypot(offset, best.covariance(0, 1 + kN + c) / best.next_error);
    variance = std::fmax(0.0, variance - offset * offset);
    result.offset_error = offset * units.density;
  }
  result.scatter_error = std::sqrt(variance) * units.density;
  result.std_error = std::hypot(result.scatter_error, result.offset_error, result.universal_error);
  if (sizes.size() > 2) {
    std::vector<SizedThreshold> larger(sizes.begin(), sizes.end());
    larger.erase(std::ranges::min_element(larger, {}, &SizedThreshold::size));
    const Units their_units(larger);
    result.without_smallest = fit(larger, their_units).values[0] * their_units.density;
  }
  return result;
}

}  // namespace vex
