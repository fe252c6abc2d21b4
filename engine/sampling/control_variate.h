// An integrand less what another one of known mean is off by at the same point: the same mean, and less variance where
// the two go together.
#pragma once

#include <memory>
#include <vector>

#include "engine/sampling/integrand.h"

namespace vex {

/// f - weight (g - mean of g).
class ControlledIntegrand final : public Integrand {
 public:
  /// `mean_of_g` is exact. Any weight leaves the mean as it is, if it does not depend on the points that follow.
  ControlledIntegrand(std::unique_ptr<Integrand> f, std::unique_ptr<Integrand> g, double mean_of_g, double weight);

  /// The larger of the two: both see the same first coordinates.
  int dimension() const override;
  int n_independent_coordinates() const override;
  double scale() const override;
  double relative_rounding() const override { return f_->relative_rounding(); }
  double absolute_rounding() const override;
  double cost() const override { return f_->cost() + g_->cost(); }
  Doubts evaluate(std::span<const double> points, std::span<double> values) override;

 private:
  std::unique_ptr<Integrand> f_, g_;
  double mean_of_g_, weight_;
  std::vector<double> of_g_;
};

/// The weight of least variance, cov(f, g) / var(g), by some thousand random points of (seed, Stream::pilot), which no
/// run uses. 0 where g does not vary, or not beyond what rounding alone would make it vary.
double control_weight(Integrand& f, Integrand& g, std::uint64_t seed);

}  // namespace vex
