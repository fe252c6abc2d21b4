#include "shapes/nematic/orientation_density.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "engine/numeric/interruption.h"

namespace vex {
namespace {

constexpr std::size_t kNodes = 128;  // between cos theta = 0 and 1; and degrees, of which every second counts
constexpr double kTolerance = 1e-14;
constexpr double kNoMoment = 1e-16;
constexpr int kMostIterations = 50000;

template <unsigned n>
void append_nodes(std::vector<double>* cosines, std::vector<double>* weights) {
  using Gauss = boost::math::quadrature::gauss<double, n>;  // from -1 to 1, of which the upper half is stored
  cosines->assign(Gauss::abscissa().begin(), Gauss::abscissa().end());
  weights->assign(Gauss::weights().begin(), Gauss::weights().end());
}

double log_cosh(double x) { return std::fabs(x) + std::log1p(std::exp(-2.0 * std::fabs(x))) - std::log(2.0); }

}  // namespace

OrientationGrid::OrientationGrid(const EvenSeries& series, Size size) : series_(series) {
  const bool is_doubled = size == Size::doubled;
  if (is_doubled) {
    append_nodes<4 * kNodes>(&cosines_, &weights_);
  } else {
    append_nodes<2 * kNodes>(&cosines_, &weights_);
  }
  series_.resize((is_doubled ? 2 * kNodes : kNodes) / 2 + 1, 0.0);
  polynomials_.assign(series_.size(), std::vector<double>(cosines_.size()));
  for (std::size_t i = 0; i < cosines_.size(); ++i) {
    double before = 0.0, now = 1.0;
    for (std::size_t l = 0; l / 2 < series_.size(); ++l) {
      if (l % 2 == 0) polynomials_[l / 2][i] = now;
      const auto n = static_cast<double>(l);
      const double next = ((2.0 * n + 1.0) * cosines_[i] * now - n * before) / (n + 1.0);
      before = now;
      now = next;
    }
  }
}

double OrientationGrid::mean(const OrientationDensity& density, const std::vector<double>& values) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += weights_[i] * density.values[i] * values[i];
  return sum;
}

OrientationDensity OrientationGrid::density_of(std::vector<double> logarithms) const {
  const double largest = *std::ranges::max_element(logarithms);
  OrientationDensity density;
  density.values.reserve(logarithms.size());
  double norm = 0.0;
  for (std::size_t i = 0; i < logarithms.size(); ++i) {
    density.values.push_back(std::exp(logarithms[i] - largest));
    norm += weights_[i] * density.values[i];
  }
  for (double& value : density.values) value /= norm;
  for (double& value : logarithms) value -= largest + std::log(norm);  // of 4 pi f now
  density.entropy = mean(density, logarithms);
  // Of a smooth density the moments fall faster than any power: three that are none end them.
  density.moments.assign(series_.size(), 0.0);
  density.interaction = 0.0;
  for (std::size_t k = 0, n_none = 0; k < series_.size() && n_none < 3; ++k) {
    density.moments[k] = mean(density, polynomials_[k]);
    density.interaction += series_[k] * density.moments[k] * density.moments[k];
    n_none = std::fabs(density.moments[k]) < kNoMoment ? n_none + 1 : 0;
  }
  return density;
}

OrientationDensity OrientationGrid::equilibrium(double coupling, const EvenSeries& start) const {
  EvenSeries moments = start;
  moments.resize(series_.size(), 0.0);
  double mixing = 1.0, change_before = 2.0;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    end_if_interrupted();
    EvenSeries field(series_.size(), 0.0);
    for (std::size_t k = 1; k < series_.size(); ++k) field[k] = -2.0 * coupling * series_[k] * moments[k];
    OrientationDensity density = in_field(field);
    double change = 0.0;
    for (std::size_t k = 1; k < series_.size(); ++k) {
      const double step = density.moments[k] - moments[k];
      change = std::max(change, std::fabs(step));
      moments[k] += mixing * step;
    }
    if (change <= kTolerance) return density;
    // A step that overshoots makes the next one longer. Rounding alone, at the end, is no overshooting.
    if (change > change_before && change > 1e-12) mixing = std::max(0.5 * mixing, 1.0 / 64.0);
    change_before = change;
    if (iteration + 1 == kMostIterations) {
      density.converged = change < 1e-12;
      return density;
    }
  }
  return {};
}

OrientationDensity OrientationGrid::in_field(const EvenSeries& field) const {
  std::vector<double> logarithms(cosines_.size(), 0.0);
  for (std::size_t k = 1; k < std::min(field.size(), series_.size()); ++k) {
    if (std::fabs(field[k]) < kNoMoment) continue;  // below the rounding of f
    for (std::size_t i = 0; i < logarithms.size(); ++i) logarithms[i] += field[k] * polynomials_[k][i];
  }
  return density_of(std::move(logarithms));
}

OrientationDensity OrientationGrid::trial(double alpha) const {
  std::vector<double> logarithms(cosines_.size());
  for (std::size_t i = 0; i < cosines_.size(); ++i) logarithms[i] = log_cosh(alpha * cosines_[i]);
  return density_of(std::move(logarithms));
}

double OrientationGrid::coupling_of_trial(double alpha) const {
  const OrientationDensity density = trial(alpha);
  // d<g> / dalpha is the covariance of g with d ln f / dalpha = x tanh(alpha x).
  std::vector<double> slope(cosines_.size());
  for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = cosines_[i] * std::tanh(alpha * cosines_[i]);
  const double mean_slope = mean(density, slope);
  const auto derivative_of = [&](const auto& value_at) {
    double sum = 0.0;
    for (std::size_t i = 0; i < slope.size(); ++i) {
      sum += weights_[i] * density.values[i] * value_at(i) * (slope[i] - mean_slope);
    }
    return sum;
  };
  const double entropy_slope = derivative_of([&](std::size_t i) { return log_cosh(alpha * cosines_[i]); });
  double interaction_slope = 0.0;
  for (std::size_t k = 1; k < series_.size(); ++k) {
    interaction_slope +=
        2.0 * series_[k] * density.moments[k] * derivative_of([&](std::size_t i) { return polynomials_[k][i]; });
  }
  return -entropy_slope / interaction_slope;
}

}  // namespace vex
