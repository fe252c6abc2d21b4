// Integrals over the measures on normals by quadrature: Gauss-Legendre along v, equidistant angles along w; of
// superellipsoids, which have algebraic singularities at the ends of quarters and eighths, the double exponential rule.
#pragma once

#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <variant>

#include "engine/numeric/double_double.h"
#include "shapes/normal_measure.h"

namespace vex {

template <class F>
double double_exponential(const F& f, double from, double to) {
  constexpr double kStep = 0.125;
  double sum = 0.0;
  for (int k = -26; k <= 26; ++k) {
    const double s = 0.5 * std::numbers::pi * std::sinh(k * kStep), cosh = std::cosh(s);
    const double weight = 0.25 * std::numbers::pi * kStep * std::cosh(k * kStep) / (cosh * cosh);
    sum += weight * f(from + (to - from) / (1.0 + std::exp(-2.0 * s)));
  }
  return (to - from) * sum;
}

template <class F>
double integral_over_superellipsoid(const NormalMeasure::Component& part, const F& f) {
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    sum += double_exponential(
        [&](double v) {
          double inner = 0.0;
          for (int j = 0; j < 8; ++j) {
            inner += double_exponential(
                [&](double w) {
                  const WeightedNormal at = normal_at(part, v, w);
                  return at.weight * f(at.unit_normal);
                },
                0.125 * j, 0.125 * (j + 1));
          }
          return inner;
        },
        0.25 * i, 0.25 * (i + 1));
  }
  return sum;
}

/// The integral of f(unit_normal) over the measure, good to 1e-13 or so where f is smooth along each component.
template <class F>
double integral_over(const NormalMeasure& measure, const F& f) {
  using Gauss = boost::math::quadrature::gauss<double, 60>;
  constexpr int kAngles = 96;
  DoubleDouble sum;
  for (const NormalMeasure::Component& component : measure.components()) {
    if (std::holds_alternative<SuperellipsoidNormals>(component)) {
      sum += integral_over_superellipsoid(component, f);
      continue;
    }
    const CoordinatesUsed used = coordinates_used(component);
    const auto over_w = [&](double v) {
      const int n_angles = used.w ? kAngles : 1;
      double mean = 0.0;
      for (int i = 0; i < n_angles; ++i) {
        const WeightedNormal at = normal_at(component, v, (i + 0.5) / n_angles);
        mean += at.weight * f(at.unit_normal) / n_angles;
      }
      return mean;
    };
    sum += used.v ? Gauss::integrate(over_w, 0.0, 1.0) : over_w(0.5);
  }
  return sum.value();
}

}  // namespace vex
