// An ellipsoid about the origin, semi-axes along x, y and z.
#pragma once

#include <algorithm>

#include "engine/support/checked_input.h"
#include "engine/support/combinators.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"
#include "shapes/solid_moments.h"

namespace vex {

class Ellipsoid {
 public:
  Ellipsoid(double semi_axis_x, double semi_axis_y, double semi_axis_z)
      : axes_{checked_size(semi_axis_x, "a semi-axis of an ellipsoid"),
              checked_size(semi_axis_y, "a semi-axis of an ellipsoid"),
              checked_size(semi_axis_z, "a semi-axis of an ellipsoid")} {
    scaled_axes_ = scaled_to_unit_exponent(axes_);
  }

  /// The image of the unit ball under D = diag(a, b, c): s(d) = D (D d / |D d|), where the inner D's are divided by a
  /// power of two, so that no square overflows (E14).
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    Vec3<L> image{L(scaled_axes_.x) * dir.x, L(scaled_axes_.y) * dir.y, L(scaled_axes_.z) * dir.z};
    if (any(norm_1(image) < L(0x1p-400))) image = scaled_to_unit_exponent(image);  // or its square would underflow
    const Vec3<L> unit = ball_support(L(1.0), image);
    return {L(axes_.x) * unit.x, L(axes_.y) * unit.y, L(axes_.z) * unit.z};
  }
  bool rounds_as_kernels() const { return true; }
  /// Each coordinate within 7.6 u of its own size: D d, its length, the quotient, and D again (E2).
  double support_error() const { return 8.0 * kUnitRoundoff * circumradius(); }
  Vec3d centre() const { return {}; }
  double circumradius() const { return std::max({axes_.x, axes_.y, axes_.z}); }
  double inradius() const { return std::min({axes_.x, axes_.y, axes_.z}); }

  /// a_min^2 / a_max. A rotation to within 1e-6 stretches the axes by no more than that.
  double rolling_radius() const { return inradius() * (inradius() / circumradius()) * (1.0 - 1e-5); }

  ExactForm exact_form() const { return {{}, {{{}, axes_}}, 0.0}; }
  /// Semi-axes along x, y, z.
  Vec3d semi_axes() const { return axes_; }

  /// S = 4 pi R_G(a^2 b^2, a^2 c^2, b^2 c^2) and M = 4 pi R_G(a^2, b^2, c^2), Carlson's symmetric integral
  /// (DLMF 19.33).
  Measures measures() const;

  SolidMoments solid_moments() const {
    const double volume = measures().volume;
    const auto square = [volume](double semi_axis) { return volume * (0.2 * semi_axis * semi_axis); };
    return SolidMoments::diagonal(volume, {}, {square(axes_.x), square(axes_.y), square(axes_.z)});
  }

  NormalMeasure area_measure() const {
    NormalMeasure area;
    area.add(EllipsoidNormals{axes_, measures().surface_area});
    return area;
  }
  NormalMeasure mean_curvature_measure() const {
    NormalMeasure curvature;
    curvature.add(EllipsoidCurvature{axes_, measures().integrated_mean_curvature});
    return curvature;
  }

 private:
  Vec3d axes_;
  Vec3d scaled_axes_;  // the longest between 1 and 2
};

}  // namespace vex
