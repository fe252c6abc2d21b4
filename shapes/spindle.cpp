#include "shapes/spindle.h"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

/// cos t - cos a = 2 sin((a + t)/2) sin((a - t)/2), which does not cancel.
double over_chord(double half_angle, double t) {
  return 2.0 * std::sin(0.5 * (half_angle + t)) * std::sin(0.5 * (half_angle - t));
}

/// Of a function of t that is even, from -a to a.
template <class F>
double over_arc(double half_angle, const F& f) {
  return 2.0 * boost::math::quadrature::gauss<double, 30>::integrate(f, 0.0, half_angle);
}

}  // namespace

Spindle::Spindle(double length, double radius)
    : profile_(0.5 * checked_size(length, "the length of a spindle"), checked_size(radius, "the radius of a spindle")) {
  if (!(profile_.radius >= 2e-9 * profile_.half && profile_.radius <= profile_.half)) {
    throw InputError(
        "the radius of a spindle is not from 1e-9 of its length to half of its length - a thinner one is a needle, and "
        "a thicker one no spindle");
  }
  half_angle_rad_ = 2.0 * std::atan(profile_.radius / profile_.half);
}

Measures Spindle::measures() const {
  using std::numbers::pi;
  const double a = half_angle_rad_, r = profile_.arc_radius;
  const auto across = [a, r](double t) { return r * over_chord(a, t); };
  const double volume = over_arc(a, [&](double t) { return across(t) * across(t) * std::cos(t); });
  const double area = over_arc(a, across);
  // R_arc - R = (h^2 - R^2) / 2R
  const double beyond = 0.5 * (profile_.half - profile_.radius) * ((profile_.half + profile_.radius) / profile_.radius);
  return {pi * r * volume, 2.0 * pi * r * area, 2.0 * pi * (2.0 * profile_.half - beyond * a)};
}

SolidMoments Spindle::solid_moments() const {
  using std::numbers::pi;
  const double a = half_angle_rad_, r = profile_.arc_radius;
  const auto across_sq = [a, r](double t) { return std::pow(r * over_chord(a, t), 2); };
  const double x = over_arc(a, [&](double t) { return 0.25 * across_sq(t) * across_sq(t) * std::cos(t); });
  const double z = over_arc(a, [&](double t) { return across_sq(t) * std::pow(r * std::sin(t), 2) * std::cos(t); });
  return SolidMoments::diagonal(measures().volume, {}, {pi * r * x, pi * r * x, pi * r * z});
}

NormalMeasure Spindle::area_measure() const {
  using std::numbers::pi;
  NormalMeasure area;
  area.add(
      NormalBelt{half_angle_rad_, 2.0 * pi * profile_.arc_radius * profile_.arc_radius, 0.0, measures().surface_area});
  return area;
}

/// Half of it is the arc's own curvature, half that of the circle across, R_arc cos t / R_arc for each unit of angle.
NormalMeasure Spindle::mean_curvature_measure() const {
  using std::numbers::pi;
  NormalMeasure curvature;
  curvature.add(NormalBelt{half_angle_rad_, pi * profile_.arc_radius, pi * profile_.arc_radius,
                           measures().integrated_mean_curvature});
  return curvature;
}

}  // namespace vex
