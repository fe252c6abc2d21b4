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
    : half_(0.5 * checked_size(length, "the length of a spindle")),
      radius_(checked_size(radius, "the radius of a spindle")) {
  if (!(radius_ >= 2e-9 * half_ && radius_ <= half_)) {
    throw InputError(
        "the radius of a spindle is not from 1e-9 of its length to half of its length - a thinner one is a needle, and "
        "a thicker one no spindle");
  }
  arc_radius_ = 0.5 * (half_ * (half_ / radius_) + radius_);
  half_angle_rad_ = 2.0 * std::atan(radius_ / half_);
  const double cosine = half_ / arc_radius_;
  tip_cosine_sq_ = cosine * cosine;
}

Measures Spindle::measures() const {
  using std::numbers::pi;
  const double a = half_angle_rad_, r = arc_radius_;
  const auto across = [a, r](double t) { return r * over_chord(a, t); };
  const double volume = over_arc(a, [&](double t) { return across(t) * across(t) * std::cos(t); });
  const double area = over_arc(a, across);
  // R_arc - R = (h^2 - R^2) / 2R
  const double beyond = 0.5 * (half_ - radius_) * ((half_ + radius_) / radius_);
  return {pi * r * volume, 2.0 * pi * r * area, 2.0 * pi * (2.0 * half_ - beyond * a)};
}

SolidMoments Spindle::solid_moments() const {
  using std::numbers::pi;
  const double a = half_angle_rad_, r = arc_radius_;
  const auto across_sq = [a, r](double t) { return std::pow(r * over_chord(a, t), 2); };
  const double x = over_arc(a, [&](double t) { return 0.25 * across_sq(t) * across_sq(t) * std::cos(t); });
  const double z = over_arc(a, [&](double t) { return across_sq(t) * std::pow(r * std::sin(t), 2) * std::cos(t); });
  return SolidMoments::diagonal(measures().volume, {}, {pi * r * x, pi * r * x, pi * r * z});
}

NormalMeasure Spindle::area_measure() const {
  using std::numbers::pi;
  NormalMeasure area;
  area.add(NormalBelt{half_angle_rad_, 2.0 * pi * arc_radius_ * arc_radius_, 0.0, measures().surface_area});
  return area;
}

/// Half of it is the arc's own curvature, half that of the circle across, R_arc cos t / R_arc for each unit of angle.
NormalMeasure Spindle::mean_curvature_measure() const {
  using std::numbers::pi;
  NormalMeasure curvature;
  curvature.add(
      NormalBelt{half_angle_rad_, pi * arc_radius_, pi * arc_radius_, measures().integrated_mean_curvature});
  return curvature;
}

}  // namespace vex
