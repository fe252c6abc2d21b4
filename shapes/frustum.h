// A frustum of a right circular cone, axis z, its two discs at z = -H/2 and z = H/2.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/support/checked_input.h"
#include "engine/support/combinators.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"
#include "shapes/solid_moments.h"

namespace vex {

class Frustum {
 public:
  /// `lower_radius` at z = -H/2, `upper_radius` at z = H/2. One of them may be 0: a cone.
  Frustum(double height, double lower_radius, double upper_radius)
      : height_(checked_size(height, "the height of a cone or frustum")),
        lower_radius_(checked_size_or_zero(lower_radius, "a radius of a cone or frustum")),
        upper_radius_(checked_size_or_zero(upper_radius, "a radius of a cone or frustum")) {
    checked_size(lower_radius + upper_radius, "the larger radius of a cone or frustum");
    place_centre();
  }

  /// A point of one of the two rims: the upper one where H d_z > (R_lower - R_upper) |(d_x, d_y)|.
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    const Vec3<L> unit_rim = disc_support(1.0, dir);
    const L across = unit_rim.x * dir.x + unit_rim.y * dir.y;
    const MaskOf<L> is_upper = L(height_) * dir.z > L(lower_radius_ - upper_radius_) * across;
    const L radius = select(is_upper, L(upper_radius_), L(lower_radius_));
    return {radius * unit_rim.x, radius * unit_rim.y, select(is_upper, L(0.5 * height_), L(-0.5 * height_))};
  }
  /// The rim's rounding, and what the wrong rim can cost where the two tie (E2).
  double support_error() const { return 16.0 * kUnitRoundoff * (std::max(lower_radius_, upper_radius_) + height_); }
  ExactForm exact_form() const {
    const double h = 0.5 * height_;
    return {
        {},
        {{{0.0, 0.0, -h}, {lower_radius_, lower_radius_, 0.0}}, {{0.0, 0.0, h}, {upper_radius_, upper_radius_, 0.0}}},
        0.0};
  }
  Vec3d centre() const { return {0.0, 0.0, centre_z_}; }
  double circumradius() const { return circumradius_; }
  double inradius() const { return inradius_; }

  double height() const { return height_; }
  double lower_radius() const { return lower_radius_; }

  /// With tan(alpha) = (R_lower - R_upper) / H, M = pi H + pi R_lower (pi/2 + alpha) + pi R_upper (pi/2 - alpha): the
  /// exterior angles of the two rims, and the axial section's height for the mantle.
  Measures measures() const {
    constexpr double pi = std::numbers::pi;
    const double h = height_, p = lower_radius_, q = upper_radius_;
    const double slant = std::hypot(h, p - q);
    const double lower_angle = std::atan2(h, q - p), upper_angle = std::atan2(h, p - q);  // pi/2 +- alpha
    return {pi / 3.0 * h * (p * p + p * q + q * q), pi * (p * p + q * q + (p + q) * slant),
            pi * (h + p * lower_angle + q * upper_angle)};
  }

  /// Disc by disc, of radius p + (q - p) s at the height s H above the base: the integrals of r^2, s r^2 and s^2 r^2,
  /// and of r^4 / 4 across.
  SolidMoments solid_moments() const {
    constexpr double pi = std::numbers::pi;
    const double h = height_, p = lower_radius_, q = upper_radius_;
    const double zeroth = (p * p + p * q + q * q) / 3.0, first = (p * p + 2.0 * p * q + 3.0 * q * q) / 12.0;
    const double second = (p * p + 3.0 * p * q + 6.0 * q * q) / 30.0, mean = first / zeroth;
    const double across =
        pi * h / 20.0 * (p * p * p * p + p * p * p * q + p * p * q * q + p * q * q * q + q * q * q * q);
    return SolidMoments::diagonal(measures().volume, {0.0, 0.0, h * (mean - 0.5)},
                                  {across, across, pi * h * h * h * (second - mean * first)});
  }

  NormalMeasure area_measure() const {
    constexpr double pi = std::numbers::pi;
    const double p = lower_radius_, q = upper_radius_;
    const double slant = std::hypot(height_, p - q);
    NormalMeasure area;
    if (p > 0.0) area.add(NormalAtom{{0.0, 0.0, -1.0}, pi * p * p});
    if (q > 0.0) area.add(NormalAtom{{0.0, 0.0, 1.0}, pi * q * q});
    area.add(NormalRing{(p - q) / slant, height_ / slant, pi * (p + q) * slant});
    return area;
  }
  /// The mantle's pi H, and the two rims, edges of exterior angle pi/2 +- alpha. An apex has none.
  NormalMeasure mean_curvature_measure() const {
    constexpr double pi = std::numbers::pi;
    const double p = lower_radius_, q = upper_radius_;
    const double slant = std::hypot(height_, p - q);
    const double lower_angle = std::atan2(height_, q - p), upper_angle = std::atan2(height_, p - q);
    NormalMeasure curvature;
    curvature.add(NormalRing{(p - q) / slant, height_ / slant, pi * height_});
    if (p > 0.0) curvature.add(NormalRim{upper_angle, pi, pi * p * lower_angle});
    if (q > 0.0) curvature.add(NormalRim{0.0, upper_angle, pi * q * upper_angle});
    return curvature;
  }

 private:
  /// The middle of the smallest ball around the frustum, but not so near a flat end that no ball is left inside: the
  /// closer the circumscribed ball, the fewer samples are wasted.
  void place_centre() {
    const double p = lower_radius_, q = upper_radius_;
    const double margin = std::min(height_, std::max(p, q)) / 8.0;
    const double equidistant = 0.5 * (height_ + (q - p) / height_ * (q + p));  // from both rims; above the lower disc
    centre_z_ = std::clamp(equidistant, margin, height_ - margin) - 0.5 * height_;
    const double below = centre_z_ + 0.5 * height_, above = 0.5 * height_ - centre_z_;
    circumradius_ = std::max(std::hypot(p, below), std::hypot(q, above)) * (1.0 + gamma(16));
    double across = (p * above + q * below) / height_;  // the radius at the centre's height
    if (!std::isfinite(across)) across = p * (above / height_) + q * (below / height_);
    const double to_mantle = across * (height_ / std::hypot(height_, p - q));
    inradius_ = std::min({below, above, to_mantle}) * (1.0 - gamma(32));
  }

  double height_, lower_radius_, upper_radius_;
  double centre_z_ = 0.0, circumradius_ = 0.0, inradius_ = 0.0;
};

}  // namespace vex
