// A lens: what two equal balls have in common. Axis z, its rim in the plane z = 0 about the origin.
//
// G. Cinacchi and S. Torquato, J. Chem. Phys. 143, 224506 (2015): hard lenses of aspect ratio thickness over diameter.
#pragma once

#include <cmath>
#include <numbers>

#include "engine/numeric/errors.h"
#include "engine/support/checked_input.h"
#include "engine/support/combinators.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"
#include "shapes/solid_moments.h"

namespace vex {

class Lens {
 public:
  /// The radius of the rim, and the whole thickness: from 2e-9 of the radius up to twice the radius, where it is a
  /// ball.
  Lens(double radius, double thickness)
      : profile_(checked_size(radius, "the radius of a lens"),
                 0.5 * checked_size(thickness, "the thickness of a lens")) {
    if (!(profile_.half >= 1e-9 * profile_.radius && profile_.half <= profile_.radius)) {
      throw InputError(
          "the thickness of a lens is not from 2e-9 of its radius to twice its radius - a thinner one is a disc, and a "
          "thicker one no lens");
    }
  }

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return profile_.support(dir);
  }
  ProfileForm profile_form() const { return profile_; }
  double support_error() const { return profile_.support_error(); }
  Vec3d centre() const { return {}; }
  double circumradius() const { return profile_.radius; }
  double inradius() const { return profile_.half; }

  double radius() const { return profile_.radius; }
  double thickness() const { return 2.0 * profile_.half; }

  /// With h = H/2: two caps of area pi (R^2 + h^2), of mean curvature 2 pi h each, and the rim, an edge of length
  /// 2 pi R whose exterior angle is pi - 4 atan(h/R).
  Measures measures() const {
    constexpr double pi = std::numbers::pi;
    const double r = profile_.radius, h = profile_.half;
    return {pi * h * (r * r + h * h / 3.0), 2.0 * pi * (r * r + h * h), 4.0 * pi * h + pi * r * rim_angle()};
  }

  /// Disc by disc, at the height s h: its radius squared is (1 - s) (R^2 + h^2 s).
  SolidMoments solid_moments() const {
    constexpr double pi = std::numbers::pi;
    const double h = profile_.half, r_sq = profile_.radius * profile_.radius, h_sq = profile_.half * profile_.half;
    const double across = 0.5 * pi * h * (r_sq * r_sq / 3.0 + r_sq * h_sq / 6.0 + h_sq * h_sq / 30.0);
    return SolidMoments::diagonal(measures().volume, {},
                                  {across, across, 2.0 * pi * h * h_sq * (r_sq / 12.0 + h_sq / 20.0)});
  }

  NormalMeasure area_measure() const {
    return caps(std::numbers::pi * (profile_.radius * profile_.radius + profile_.half * profile_.half));
  }
  NormalMeasure mean_curvature_measure() const {
    constexpr double pi = std::numbers::pi;
    NormalMeasure curvature = caps(2.0 * pi * profile_.half);
    const double angle = rim_angle();
    if (angle > 0.0) curvature.add(NormalRim{0.5 * (pi - angle), 0.5 * (pi + angle), pi * profile_.radius * angle});
    return curvature;
  }

 private:
  double rim_angle() const { return std::numbers::pi - 4.0 * std::atan(profile_.half / profile_.radius); }
  /// The cosine of a cap's half angle 2 atan(h/R).
  NormalMeasure caps(double mass) const {
    const double slope = profile_.half / profile_.radius,
                 cosine = (1.0 - slope) * (1.0 + slope) / (1.0 + slope * slope);
    NormalMeasure both;
    both.add(NormalZone{cosine, 1.0, mass});
    both.add(NormalZone{-1.0, -cosine, mass});
    return both;
  }

  LensProfile profile_;
};

}  // namespace vex
