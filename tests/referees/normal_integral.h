// Integrals over the measures on normals by quadrature: Gauss-Legendre along v, equidistant angles along w.
#pragma once

#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "engine/numeric/double_double.h"
#include "shapes/normal_measure.h"

namespace vex {

/// The integral of f(unit_normal) over the measure, good to 1e-13 or so where f is smooth along each component.
template <class F>
double integral_over(const NormalMeasure& measure, const F& f) {
  using Gauss = boost::math::quadrature::gauss<double, 60>;
  constexpr int kAngles = 96;
  DoubleDouble sum;
  for (const NormalMeasure::Component& component : measure.components()) {
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
