#include "engine/sampling/control_variate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/numeric/rounding.h"
#include "engine/sampling/points/random_stream.h"

namespace vex {

ControlledIntegrand::ControlledIntegrand(std::unique_ptr<Integrand> f, std::unique_ptr<Integrand> g, double mean_of_g,
                                         double weight)
    : f_(std::move(f)), g_(std::move(g)), mean_of_g_(mean_of_g), weight_(weight) {}

int ControlledIntegrand::dimension() const { return std::max(f_->dimension(), g_->dimension()); }

int ControlledIntegrand::n_independent_coordinates() const {
  // From the first one on that is such of f or of g.
  const int first_of_f = f_->dimension() - f_->n_independent_coordinates(),
            first_of_g = g_->dimension() - g_->n_independent_coordinates();
  return dimension() - std::min(f_->n_independent_coordinates() > 0 ? first_of_f : dimension(),
                                g_->n_independent_coordinates() > 0 ? first_of_g : dimension());
}

double ControlledIntegrand::scale() const {
  return f_->scale() + std::fabs(weight_) * (g_->scale() + std::fabs(mean_of_g_));
}

// g is off by its own rounding, relative to its mean, which f's may be far below; and the difference from the mean, the
// product with the weight and the last difference round once each, values no larger on average than twice g's mean.
double ControlledIntegrand::absolute_rounding() const {
  const double of_g = g_->relative_rounding() * std::fabs(mean_of_g_) + g_->absolute_rounding();
  return f_->absolute_rounding() + std::fabs(weight_) * (of_g + gamma(8) * std::fabs(mean_of_g_));
}

Doubts ControlledIntegrand::evaluate(std::span<const double> points, std::span<double> values) {
  of_g_.resize(values.size());
  const auto first = [&](const Integrand& one) {
    return points.first(static_cast<std::size_t>(one.dimension()) * values.size());
  };
  const Doubts of_f = f_->evaluate(first(*f_), values), of_g = g_->evaluate(first(*g_), of_g_);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] -= weight_ * (of_g_[k] - mean_of_g_);
  // One for each value: where both are in doubt, what it may be off by adds up.
  Doubts doubts;
  auto f = of_f.begin();
  auto g = of_g.begin();
  while (f != of_f.end() || g != of_g.end()) {
    const bool has_f = f != of_f.end() && (g == of_g.end() || f->k <= g->k);
    const bool has_g = g != of_g.end() && (f == of_f.end() || g->k <= f->k);
    doubts.push_back({has_f ? f->k : g->k, 0.0});
    if (has_f) doubts.back().half_width += (f++)->half_width;
    if (has_g) doubts.back().half_width += std::fabs(weight_) * (g++)->half_width;
  }
  return doubts;
}

double control_weight(Integrand& f, Integrand& g, std::uint64_t seed) {
  constexpr std::size_t kPoints = 2048;
  const auto dimension = static_cast<std::size_t>(std::max(f.dimension(), g.dimension()));
  std::vector<double> points(dimension * kPoints), point(dimension), of_f(kPoints), of_g(kPoints);
  for (std::size_t k = 0; k < kPoints; ++k) {
    draw_unit_cube(seed, Stream::pilot, k, point);
    for (std::size_t c = 0; c < dimension; ++c) points[c * kPoints + k] = point[c];
  }
  f.evaluate(std::span<const double>(points).first(static_cast<std::size_t>(f.dimension()) * kPoints), of_f);
  g.evaluate(std::span<const double>(points).first(static_cast<std::size_t>(g.dimension()) * kPoints), of_g);
  double mean_f = 0.0, mean_g = 0.0;
  for (std::size_t k = 0; k < kPoints; ++k) {
    mean_f += of_f[k] / kPoints;
    mean_g += of_g[k] / kPoints;
  }
  double both = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < kPoints; ++k) {
    both += (of_f[k] - mean_f) * (of_g[k] - mean_g);
    squares += (of_g[k] - mean_g) * (of_g[k] - mean_g);
  }
  // What varies by rounding alone goes together with nothing: a weight of it would be noise, and multiplied by it the
  // rounding of a large g would be the result.
  constexpr double kBeyondRounding = 64.0;
  const double rounding = (g.relative_rounding() + 0x1p-50) * std::fabs(mean_g) + g.absolute_rounding();
  return std::sqrt(squares / kPoints) > kBeyondRounding * rounding ? both / squares : 0.0;
}

}  // namespace vex
