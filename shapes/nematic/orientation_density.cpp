#include "shapes/nematic/orientation_density.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "engine/numeric/interruption.h"
#include "shapes/nematic/fixed_point.h"

namespace vex {
namespace {

using Eigen::ArrayXd;
using Eigen::VectorXd;

constexpr std::size_t kNodes = 128;  // between cos theta = 0 and 1; and degrees, of which every second counts
constexpr double kTolerance = 1e-14, kNearly = 1e-12;
constexpr int kMostIterations = 4000;

// From -1 to 1, of which the upper half is stored.
template <unsigned n>
void set_nodes(std::vector<double>* cosines, ArrayXd* weights) {
  using Gauss = boost::math::quadrature::gauss<double, n>;
  cosines->assign(Gauss::abscissa().begin(), Gauss::abscissa().end());
  *weights = Eigen::Map<const ArrayXd>(Gauss::weights().data(), static_cast<Eigen::Index>(Gauss::weights().size()));
}

double log_cosh(double x) { return std::fabs(x) + std::log1p(std::exp(-2.0 * std::fabs(x))) - std::log(2.0); }

}  // namespace

OrientationGrid::OrientationGrid(const EvenSeries& series, Size size) : series_(series) {
  const bool is_doubled = size == Size::doubled;
  if (is_doubled) {
    set_nodes<4 * kNodes>(&cosines_, &weights_);
  } else {
    set_nodes<2 * kNodes>(&cosines_, &weights_);
  }
  series_.resize((is_doubled ? 2 * kNodes : kNodes) / 2 + 1, 0.0);
  polynomials_.resize(static_cast<Eigen::Index>(series_.size()), weights_.size());
  for (Eigen::Index i = 0; i < polynomials_.cols(); ++i) {
    double before = 0.0, now = 1.0;
    for (Eigen::Index l = 0; l / 2 < polynomials_.rows(); ++l) {
      if (l % 2 == 0) polynomials_(l / 2, i) = now;
      const auto n = static_cast<double>(l);
      const double next = ((2.0 * n + 1.0) * cosines_[static_cast<std::size_t>(i)] * now - n * before) / (n + 1.0);
      before = now;
      now = next;
    }
  }
}

OrientationDensity OrientationGrid::density_of(ArrayXd logarithms) const {
  logarithms -= logarithms.maxCoeff();
  ArrayXd values = logarithms.exp();
  const double norm = (weights_ * values).sum();
  values /= norm;
  const VectorXd weighted = weights_ * values;
  const VectorXd moments = polynomials_ * weighted;
  OrientationDensity density;
  density.values.assign(values.begin(), values.end());
  density.entropy = weighted.dot((logarithms - std::log(norm)).matrix());  // ln(4 pi f)
  density.moments.assign(moments.begin(), moments.end());
  density.interaction = 0.0;
  for (std::size_t k = 0; k < series_.size(); ++k) {
    density.interaction += series_[k] * density.moments[k] * density.moments[k];
  }
  return density;
}

OrientationDensity OrientationGrid::equilibrium(double coupling, const EvenSeries& start) const {
  EvenSeries moments = start;
  moments.resize(series_.size(), 0.0);
  OrientationDensity density;
  density.converged = false;
  FixedPoint fixed_point;
  for (int iteration = 0; iteration < kMostIterations && !density.converged; ++iteration) {
    end_if_interrupted();
    EvenSeries field(series_.size(), 0.0);
    for (std::size_t k = 1; k < series_.size(); ++k) field[k] = -2.0 * coupling * series_[k] * moments[k];
    density = in_field(field);
    const double change = fixed_point.step(moments, density.moments);
    density.converged = change <= kTolerance || (iteration + 1 == kMostIterations && change < kNearly);
  }
  return density;
}

OrientationDensity OrientationGrid::in_field(const EvenSeries& field) const {
  VectorXd by_degree = VectorXd::Zero(polynomials_.rows());
  for (std::size_t k = 1; k < std::min(field.size(), series_.size()); ++k) {
    by_degree[static_cast<Eigen::Index>(k)] = field[k];
  }
  return density_of((polynomials_.transpose() * by_degree).array());
}

OrientationDensity OrientationGrid::trial(double alpha) const {
  ArrayXd logarithms(weights_.size());
  for (std::size_t i = 0; i < cosines_.size(); ++i) {
    logarithms[static_cast<Eigen::Index>(i)] = log_cosh(alpha * cosines_[i]);
  }
  return density_of(std::move(logarithms));
}

double OrientationGrid::coupling_of_trial(double alpha) const {
  const OrientationDensity density = trial(alpha);
  const Eigen::Map<const ArrayXd> values(density.values.data(), weights_.size());
  const Eigen::Map<const ArrayXd> cosines(cosines_.data(), weights_.size());
  // d<g> / dalpha is the covariance of g with d ln f / dalpha = x tanh(alpha x).
  const ArrayXd slope = cosines * (alpha * cosines).tanh();
  const ArrayXd weighted = weights_ * values;
  const ArrayXd by_alpha = weighted * (slope - (weighted * slope).sum());
  const double entropy_slope = (by_alpha * cosines.unaryExpr([&](double x) { return log_cosh(alpha * x); })).sum();
  const VectorXd moment_slopes = polynomials_ * by_alpha.matrix();
  double interaction_slope = 0.0;
  for (std::size_t k = 1; k < series_.size(); ++k) {
    interaction_slope += 2.0 * series_[k] * density.moments[k] * moment_slopes[static_cast<Eigen::Index>(k)];
  }
  return -entropy_slope / interaction_slope;
}

}  // namespace vex
