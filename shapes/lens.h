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
      : radius_(checked_size(radius, "the radius of a lens")),
        half_(0.5 * checked_size(thickness, "the thickness of a lens")) {
    if (!(half_ >= 1e-9 * radius_ && half_ <= radius_)) {
      throw InputError(
          "the thickness of a lens is not from 2e-9 of its radius to twice its radius - a thinner one is a disc, and a "
          "thicker one no lens");
    }
    ball_radius_ = 0.5 * (radius_ * (radius_ / half_) + half_);
    const double sine = radius_ / ball_radius_;
    rim_sine_sq_ = sine * sine;
  }

  /// On the upper or the lower ball where the direction's angle to the axis is within the cap's; else on the rim. The
  /// height on a ball is H/2 - R_ball sin^2/(1 + cos): of a thin lens no large numbers cancel.
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    const L length = norm(dir);
    const Vec3<L> unit = (L(1.0) / select(length > L(0.0), length, L(1.0))) * dir;
    const L sine_sq = unit.x * unit.x + unit.y * unit.y;
    const L ball_radius(ball_radius_);
    const L height = L(half_) - ball_radius * (sine_sq / (L(1.0) + absolute(unit.z)));
    const Vec3<L> on_ball{ball_radius * unit.x, ball_radius * unit.y, copy_sign(height, dir.z)};
    return select<L>(sine_sq > L(rim_sine_sq_), disc_support(radius_, dir), on_ball);
  }
  double support_error() const { return 48.0 * kUnitRoundoff * (radius_ + half_); }  // E2
  Vec3d centre() const { return {}; }
  double circumradius() const { return radius_; }
  double inradius() const { return half_; }

  double radius() const { return radius_; }
  double thickness() const { return 2.0 * half_; }

  /// With h = H/2: two caps of area pi (R^2 + h^2), of mean curvature 2 pi h each, and the rim, an edge of length
  /// 2 pi R whose exterior angle is pi - 4 atan(h/R).
  Measures measures() const {
    constexpr double pi = std::numbers::pi;
    const double r = radius_, h = half_;
    return {pi * h * (r * r + h * h / 3.0), 2.0 * pi * (r * r + h * h), 4.0 * pi * h + pi * r * rim_angle()};
  }

  /// Disc by disc, at the height s h: its radius squared is (1 - s) (R^2 + h^2 s).
  SolidMoments solid_moments() const {
    constexpr double pi = std::numbers::pi;
    const double h = half_, r_sq = radius_ * radius_, h_sq = half_ * half_;
    const double across = 0.5 * pi * h * (r_sq * r_sq / 3.0 + r_sq * h_sq / 6.0 + h_sq * h_sq / 30.0);
    return SolidMoments::diagonal(measures().volume, {},
                                  {across, across, 2.0 * pi * h * h_sq * (r_sq / 12.0 + h_sq / 20.0)});
  }

  NormalMeasure area_measure() const { return caps(std::numbers::pi * (radius_ * radius_ + half_ * half_)); }
  NormalMeasure mean_curvature_measure() const {
    constexpr double pi = std::numbers::pi;
    NormalMeasure curvature = caps(2.0 * pi * half_);
    const double angle = rim_angle();
    if (angle > 0.0) curvature.add(NormalRim{0.5 * (pi - angle), 0.5 * (pi + angle), pi * radius_ * angle});
    return curvature;
  }

 private:
  double rim_angle() const { return std::numbers::pi - 4.0 * std::atan(half_ / radius_); }
  /// The cosine of a cap's half angle 2 atan(h/R).
  NormalMeasure caps(double mass) const {
    const double slope = half_ / radius_, cosine = (1.0 - slope) * (1.0 + slope) / (1.0 + slope * slope);
    NormalMeasure both;
    both.add(NormalZone{cosine, 1.0, mass});
    both.add(NormalZone{-1.0, -cosine, mass});
    return both;
  }

  double radius_, half_;
  double ball_radius_ = 0.0, rim_sine_sq_ = 0.0;
};

}  // namespace vex
