// Poisson's law of one mean (internal).
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace vex {

/// P(N >= n) and P(N = n) in a window beyond which there is nothing to double precision.
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

}  // namespace vex
