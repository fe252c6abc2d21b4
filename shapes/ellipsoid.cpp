#include "shapes/ellipsoid.h"

#include <boost/math/special_functions/ellint_rg.hpp>
#include <numbers>

namespace vex {

Measures Ellipsoid::measures() const {
  constexpr double pi = std::numbers::pi;
  // In units of the longest semi-axis, so that no square over- or underflows before the result does.
  const double unit = circumradius();
  const double a = axes_.x / unit, b = axes_.y / unit, c = axes_.z / unit;
  const double area = boost::math::ellint_rg(a * a * b * b, a * a * c * c, b * b * c * c);
  const double curvature = boost::math::ellint_rg(a * a, b * b, c * c);
  return {4.0 / 3.0 * pi * axes_.x * axes_.y * axes_.z, 4.0 * pi * area * unit * unit, 4.0 * pi * curvature * unit};
}

}  // namespace vex
