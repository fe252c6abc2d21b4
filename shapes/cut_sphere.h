// A ball about the origin between two planes across the z axis.
//
// J. A. C. Veerman and D. Frenkel, Phys. Rev. A 45, 5632 (1992): hard cut spheres, whose two faces are equal.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/numeric/errors.h"
#include "engine/support/checked_input.h"
#include "engine/support/combinators.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"
#include "shapes/solid_moments.h"

namespace vex {

class CutSphere {
 public:
  /// The ball's radius, and how far below and above its middle the planes are: at most the radius, where there is no
  /// face.
  CutSphere(double radius, double below, double above)
      : profile_(checked_size(radius, "the radius of a cut sphere"),
                 checked_size(below, "the height of a cut sphere below its middle"),
                 checked_size(above, "the height of a cut sphere above its middle")) {
    if (below > radius || above > radius) {
      throw InputError(
          "a plane of a cut sphere does not meet the ball - give heights below and above its middle of at most the "
          "radius");
    }
  }

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return profile_.support(dir);
  }
  ProfileForm profile_form() const { return profile_; }
  double support_error() const { return profile_.support_error(); }
  /// Towards the farther plane: as the hemisphere's.
  Vec3d centre() const { return {0.0, 0.0, 0.125 * (profile_.above - profile_.below)}; }
  /// |x - c|^2 = R^2 + c^2 - 2 c z on the ball is largest at the nearer plane.
  double circumradius() const {
    // Times a power of two, so that no product over- or underflows.
    const int exponent = std::ilogb(profile_.radius);
    const auto scaled = [exponent](double length) { return std::ldexp(length, -exponent); };
    const double c = scaled(std::fabs(centre().z)), nearer = scaled(std::min(profile_.below, profile_.above));
    const double r = scaled(profile_.radius);
    return std::ldexp(std::sqrt(r * r + c * (c + 2.0 * nearer)) * (1.0 + gamma(8)), exponent);
  }
  double inradius() const {
    const double c = centre().z;
    return std::min({profile_.above - c, profile_.below + c, profile_.radius - std::fabs(c)}) * (1.0 - gamma(8));
  }

  /// The zone has an area of 2 pi R (B + T); faces of radius r, whose rims have the exterior angle of which r/R is the
  /// sine.
  Measures measures() const {
    constexpr double pi = std::numbers::pi;
    const double r = profile_.radius, b = profile_.below, t = profile_.above, p = profile_.below_rim,
                 q = profile_.above_rim;
    return {pi * (b * (r * r - b * b / 3.0) + t * (r * r - t * t / 3.0)), pi * (2.0 * r * (b + t) + p * p + q * q),
            pi * (2.0 * (b + t) + p * std::atan2(p, b) + q * std::atan2(q, t))};
  }

  /// Disc by disc, of radius^2 R^2 - z^2; in units of R, so that nothing underflows before the result does.
  SolidMoments solid_moments() const {
    constexpr double pi = std::numbers::pi;
    const double b = profile_.below / profile_.radius, t = profile_.above / profile_.radius,
                 unit = profile_.radius * profile_.radius * profile_.radius;
    const double volume = pi * (b * (1.0 - b * b / 3.0) + t * (1.0 - t * t / 3.0));
    const double mean = pi * (t * t * (0.5 - 0.25 * t * t) - b * b * (0.5 - 0.25 * b * b)) / volume;
    const auto second = [](double h) { return h * h * h * (1.0 / 3.0 - h * h / 5.0); };
    const auto across = [](double h) { return 0.25 * h * (1.0 - h * h * (2.0 / 3.0 - 0.2 * h * h)); };
    const double x = pi * (across(b) + across(t)) * unit * profile_.radius * profile_.radius;
    const double z = (pi * (second(b) + second(t)) - mean * mean * volume) * unit * profile_.radius * profile_.radius;
    return SolidMoments::diagonal(measures().volume, {0.0, 0.0, mean * profile_.radius}, {x, x, z});
  }

  NormalMeasure area_measure() const {
    constexpr double pi = std::numbers::pi;
    NormalMeasure area;
    if (profile_.below_rim > 0.0) area.add(NormalAtom{{0.0, 0.0, -1.0}, pi * profile_.below_rim * profile_.below_rim});
    if (profile_.above_rim > 0.0) area.add(NormalAtom{{0.0, 0.0, 1.0}, pi * profile_.above_rim * profile_.above_rim});
    area.add(NormalZone{-profile_.below / profile_.radius, profile_.above / profile_.radius,
                        2.0 * pi * profile_.radius * (profile_.below + profile_.above)});
    return area;
  }
  NormalMeasure mean_curvature_measure() const {
    constexpr double pi = std::numbers::pi;
    NormalMeasure curvature;
    curvature.add(NormalZone{-profile_.below / profile_.radius, profile_.above / profile_.radius,
                             2.0 * pi * (profile_.below + profile_.above)});
    const double below = std::atan2(profile_.below_rim, profile_.below),
                 above = std::atan2(profile_.above_rim, profile_.above);
    if (below > 0.0) curvature.add(NormalRim{pi - below, pi, pi * profile_.below_rim * below});
    if (above > 0.0) curvature.add(NormalRim{0.0, above, pi * profile_.above_rim * above});
    return curvature;
  }

 private:
  CutBallProfile profile_;
};

}  // namespace vex
