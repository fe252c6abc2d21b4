// A spindle, or lemon: what a segment of a circle sweeps as it turns about its chord, which is the z axis, its middle
// at the origin. It is the inner part of a spindle torus.
#pragma once

#include "engine/support/checked_input.h"
#include "engine/support/combinators.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"
#include "shapes/solid_moments.h"

namespace vex {

class Spindle {
 public:
  /// From tip to tip, and the radius at the equator: from 1e-9 of the length to half of it, where it is a ball.
  Spindle(double length, double radius);

  /// On the arc where the direction is within its normals; else a tip. The radius there is R - R_arc cos^2/(1 + sin) of
  /// the direction's angle to the axis: of a slender one no large numbers cancel.
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    const L length = norm(dir);
    const Vec3<L> unit = (L(1.0) / select(length > L(0.0), length, L(1.0))) * dir;
    const L cosine_sq = unit.z * unit.z, sine = square_root(unit.x * unit.x + unit.y * unit.y);
    const L across = L(radius_) - L(arc_radius_) * (cosine_sq / (L(1.0) + sine));
    const Vec3<L> around = disc_support(1.0, dir);
    const Vec3<L> on_arc{across * around.x, across * around.y, L(arc_radius_) * unit.z};
    const Vec3<L> tip{L(0.0), L(0.0), copy_sign(L(half_), dir.z)};
    return select<L>(cosine_sq > L(tip_cosine_sq_), tip, on_arc);
  }
  double support_error() const { return 48.0 * kUnitRoundoff * (radius_ + half_); }  // E2
  Vec3d centre() const { return {}; }
  double circumradius() const { return half_; }
  double inradius() const { return radius_; }

  double length() const { return 2.0 * half_; }
  double radius() const { return radius_; }

  /// With the arc's points at R_arc (cos t - cos a, sin t), |t| <= a = 2 atan(2R/L): V and S by Gauss's rule of thirty
  /// nodes, of analytic integrands that are nowhere negative, to rounding; M = 2 pi (L - (R_arc - R) a). The tips,
  /// points as an apex is, have no mean curvature.
  Measures measures() const;
  SolidMoments solid_moments() const;
  NormalMeasure area_measure() const;
  NormalMeasure mean_curvature_measure() const;

 private:
  double half_, radius_;
  double arc_radius_ = 0.0, half_angle_rad_ = 0.0, tip_cosine_sq_ = 0.0;
};

}  // namespace vex
