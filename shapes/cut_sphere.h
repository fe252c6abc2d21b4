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
      : radius_(checked_size(radius, "the radius of a cut sphere")),
        below_(checked_size(below, "the height of a cut sphere below its middle")),
        above_(checked_size(above, "the height of a cut sphere above its middle")) {
    if (below_ > radius_ || above_ > radius_) {
      throw InputError(
          "a plane of a cut sphere does not meet the ball - give heights below and above its middle of at most the "
          "radius");
    }
    below_rim_ = rim(below_);
    above_rim_ = rim(above_);
  }

  /// On the ball, or on the rim of a face where the ball's point is beyond the plane.
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    const Vec3<L> on_ball = ball_support(L(radius_), dir), unit_rim = disc_support(1.0, dir);
    const L above(above_), below(-below_);
    const Vec3<L> on_upper{L(above_rim_) * unit_rim.x, L(above_rim_) * unit_rim.y, above};
    const Vec3<L> on_lower{L(below_rim_) * unit_rim.x, L(below_rim_) * unit_rim.y, below};
    return select<L>(on_ball.z > above, on_upper, select<L>(below > on_ball.z, on_lower, on_ball));
  }
  double support_error() const { return 16.0 * kUnitRoundoff * radius_; }  // E2
  /// Towards the farther plane: as the hemisphere's.
  Vec3d centre() const { return {0.0, 0.0, 0.125 * (above_ - below_)}; }
  /// |x - c|^2 = R^2 + c^2 - 2 c z on the ball is largest at the nearer plane.
  double circumradius() const {
    const double c = std::fabs(centre().z), nearer = std::min(below_, above_);
    return std::sqrt(radius_ * radius_ + c * (c + 2.0 * nearer)) * (1.0 + gamma(8));
  }
  double inradius() const {
    const double c = centre().z;
    return std::min({above_ - c, below_ + c, radius_ - std::fabs(c)}) * (1.0 - gamma(8));
  }

  /// The zone has an area of 2 pi R (B + T); faces of radius r, whose rims have the exterior angle of which r/R is the
  /// sine.
  Measures measures() const {
    constexpr double pi = std::numbers::pi;
    const double r = radius_, b = below_, t = above_, p = below_rim_, q = above_rim_;
    return {pi * (b * (r * r - b * b / 3.0) + t * (r * r - t * t / 3.0)), pi * (2.0 * r * (b + t) + p * p + q * q),
            pi * (2.0 * (b + t) + p * std::atan2(p, b) + q * std::atan2(q, t))};
  }

  /// Disc by disc, of radius^2 R^2 - z^2; in units of R, so that nothing underflows before the result does.
  SolidMoments solid_moments() const {
    constexpr double pi = std::numbers::pi;
    const double b = below_ / radius_, t = above_ / radius_, unit = radius_ * radius_ * radius_;
    const double volume = pi * (b * (1.0 - b * b / 3.0) + t * (1.0 - t * t / 3.0));
    const double mean = pi * (t * t * (0.5 - 0.25 * t * t) - b * b * (0.5 - 0.25 * b * b)) / volume;
    const auto second = [](double h) { return h * h * h * (1.0 / 3.0 - h * h / 5.0); };
    const auto across = [](double h) { return 0.25 * h * (1.0 - h * h * (2.0 / 3.0 - 0.2 * h * h)); };
    const double x = pi * (across(b) + across(t)) * unit * radius_ * radius_;
    const double z = (pi * (second(b) + second(t)) - mean * mean * volume) * unit * radius_ * radius_;
    return SolidMoments::diagonal(measures().volume, {0.0, 0.0, mean * radius_}, {x, x, z});
  }

  NormalMeasure area_measure() const {
    constexpr double pi = std::numbers::pi;
    NormalMeasure area;
    if (below_rim_ > 0.0) area.add(NormalAtom{{0.0, 0.0, -1.0}, pi * below_rim_ * below_rim_});
    if (above_rim_ > 0.0) area.add(NormalAtom{{0.0, 0.0, 1.0}, pi * above_rim_ * above_rim_});
    area.add(NormalZone{-below_ / radius_, above_ / radius_, 2.0 * pi * radius_ * (below_ + above_)});
    return area;
  }
  NormalMeasure mean_curvature_measure() const {
    constexpr double pi = std::numbers::pi;
    NormalMeasure curvature;
    curvature.add(NormalZone{-below_ / radius_, above_ / radius_, 2.0 * pi * (below_ + above_)});
    const double below = std::atan2(below_rim_, below_), above = std::atan2(above_rim_, above_);
    if (below > 0.0) curvature.add(NormalRim{pi - below, pi, pi * below_rim_ * below});
    if (above > 0.0) curvature.add(NormalRim{0.0, above, pi * above_rim_ * above});
    return curvature;
  }

 private:
  double rim(double height) const { return std::sqrt((radius_ - height) * (radius_ + height)); }

  double radius_, below_, above_;
  double below_rim_ = 0.0, above_rim_ = 0.0;
};

}  // namespace vex
