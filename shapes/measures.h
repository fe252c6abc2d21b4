// The three measures of a convex body that its average excluded volume depends on.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

namespace vex {

/// V, S and M of a convex body, in units of length^3, length^2 and length.
///
/// `integrated_mean_curvature` is M, the mean curvature integrated over the surface, which is also the integral of the
/// support function over the unit sphere: 4 pi R for a sphere. Other tools report M / 4 pi as "mean curvature".
/// A flat body counts both of its sides in S.
struct Measures {
  double volume = 0.0;
  double surface_area = 0.0;
  double integrated_mean_curvature = 0.0;

  /// M / 4 pi, in units of length: R for a sphere.
  /// Of a body that does not tell its measures: NaN each.
  static Measures unknown() {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    return {kUnknown, kUnknown, kUnknown};
  }
  bool are_known() const {
    return !(std::isnan(volume) || std::isnan(surface_area) || std::isnan(integrated_mean_curvature));
  }

  double mean_radius() const { return integrated_mean_curvature / (4.0 * std::numbers::pi); }
};

}  // namespace vex
