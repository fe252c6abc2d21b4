#include "engine/sampling/virial/distance_control.h"

#include <cmath>
#include <numbers>

#include "engine/sampling/virial/overlapping_pairs.h"

namespace vex {

DistanceControl::DistanceControl(const ConvexBody& a, const ConvexBody& b, double excluded_volume,
                                 double relative_error, bool has_factors)
    : has_factors_(has_factors) {
  constexpr double kLeastShare = 0.02, kMostError = 1e-9, kShareOfAll = 1.0 + 1e-6;
  rounding_ = has_factors ? relative_error : 0.0;
  // Places of poses are off by less than 2^-40 of the reach: the ball that is used is smaller by far more.
  const double inner = a.inradius() + b.inradius() - margin_of_balls(a, b);
  const double share = 4.0 / 3.0 * std::numbers::pi * (inner * inner * inner) / excluded_volume;
  if (!(inner > 0.0 && share > kLeastShare && share < kShareOfAll && relative_error < kMostError)) return;
  inner_sq_ = inner * inner;
  share_ = share;
  // Besides <V_ex>: who is on which side of R is wrong where r is as near to it as its rounding, 2^-40 of the reach.
  rounding_ += share * relative_error + 0x1p-36 * (a.reach() + b.reach()) / inner;
}

void DistanceControl::add(const Vec3d& from_a_to_b, Values& sums, double factor) const {
  constexpr std::size_t kOfDistance = kN - 1;
  sums[kOfDistance] += factor - 1.0;
  if (!(share_ > 0.0)) return;
  // The integral of (1 - y^2)^k 3 y^2 from 0 to 1.
  constexpr std::array<double, kOfDistance> kMeans = {1.0, 2.0 / 5.0, 8.0 / 35.0};
  const double left = 1.0 - dot(from_a_to_b, from_a_to_b) / inner_sq_;
  double power = left > 0.0 ? factor : 0.0;
  for (std::size_t k = 0; k < kOfDistance; ++k, power *= left) sums[k] += power - share_ * kMeans[k];
}

void VirialControl::fit(std::vector<double> values, std::span<const DistanceControl::Values> means) {
  constexpr std::size_t kN = DistanceControl::kN;
  const std::size_t n = values.size();
  const auto centre = [n](std::vector<double>& column) {
    double sum = 0.0;
    for (const double x : column) sum += x;
    for (double& x : column) x -= sum / static_cast<double>(n);
  };
  const auto product = [n](const std::vector<double>& x, const std::vector<double>& y) {
    double sum = 0.0;
    for (std::size_t at = 0; at < n; ++at) sum += x[at] * y[at];
    return sum;
  };
  centre(values);
  // Gram and Schmidt: a column as it was is of[k][0] times the first one made orthogonal, and so on.
  std::array<std::vector<double>, kN> columns;
  std::array<std::array<double, kN>, kN> of{};
  std::array<double, kN> along{};
  for (std::size_t k = 0; k < kN; ++k) {
    for (const DistanceControl::Values& row : means) columns[k].push_back(row[k]);
    centre(columns[k]);
    const double before = product(columns[k], columns[k]);
    for (std::size_t j = 0; j < k; ++j) {
      const double length_sq = product(columns[j], columns[j]);
      of[k][j] = length_sq > 0.0 ? product(columns[k], columns[j]) / length_sq : 0.0;
      for (std::size_t at = 0; at < n; ++at) columns[k][at] -= of[k][j] * columns[j][at];
    }
    const double length_sq = product(columns[k], columns[k]);
    constexpr double kNothing = 1e-9;  // of what it was: it is no new direction, as the first one of balls
    if (length_sq > kNothing * before) {
      along[k] = product(values, columns[k]) / length_sq;
    } else {
      columns[k].assign(n, 0.0);
    }
  }
  // Back to the functions as they are.
  for (std::size_t k = kN; k-- > 0;) {
    factors[k] = along[k];
    for (std::size_t j = k + 1; j < kN; ++j) factors[k] -= of[j][k] * factors[j];
  }
}

double VirialControl::absolute_rounding() const {
  double sum = 0.0;
  for (const double factor : factors) sum += std::fabs(factor);
  return sum * functions.rounding();
}

}  // namespace vex
