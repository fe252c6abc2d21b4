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

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return profile_.support(dir);
  }
  ProfileForm profile_form() const { return profile_; }
  double support_error() const { return profile_.support_error(); }
  Vec3d centre() const { return {}; }
  double circumradius() const { return profile_.half; }
  double inradius() const { return profile_.radius; }

  double length() const { return 2.0 * profile_.half; }
  double radius() const { return profile_.radius; }

  /// With the arc's points at R_arc (cos t - cos a, sin t), |t| <= a = 2 atan(2R/L): V and S by Gauss's rule of thirty
  /// nodes, of analytic integrands that are nowhere negative, to rounding; M = 2 pi (L - (R_arc - R) a). The tips,
  /// points as an apex is, have no mean curvature.
  Measures measures() const;
  SolidMoments solid_moments() const;
  NormalMeasure area_measure() const;
  NormalMeasure mean_curvature_measure() const;

 private:
  SpindleProfile profile_;
  double half_angle_rad_ = 0.0;
};

}  // namespace vex
