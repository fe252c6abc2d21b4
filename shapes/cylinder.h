// A right circular cylinder about the origin, axis z: a disc along a needle.
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

class Cylinder {
 public:
  Cylinder(double length, double radius)
      : half_length_(0.5 * checked_size(length, "the length of a cylinder")),
        radius_(checked_size(radius, "the radius of a cylinder")) {}

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    const Vec3<L> rim = disc_support(radius_, dir);
    return {rim.x, rim.y, copy_sign(L(half_length_), dir.z)};
  }
  double support_error() const { return 8.0 * kUnitRoundoff * radius_; }  // the disc's; the end is exact (E2)
  ExactForm exact_form() const {
    const Vec3d disc{radius_, radius_, 0.0};
    return {{}, {{{0.0, 0.0, -half_length_}, disc}, {{0.0, 0.0, half_length_}, disc}}, 0.0};
  }
  Vec3d centre() const { return {}; }
  double circumradius() const { return safe_norm(Vec3d{radius_, 0.0, half_length_}) * (1.0 + gamma(4)); }
  double inradius() const { return std::min(half_length_, radius_); }

  double length() const { return 2.0 * half_length_; }
  double radius() const { return radius_; }

  Measures measures() const {
    constexpr double pi = std::numbers::pi;
    const double l = length(), r = radius_;
    return {pi * r * r * l, 2.0 * pi * r * (l + r), pi * (l + pi * r)};
  }

  SolidMoments solid_moments() const {
    const double volume = measures().volume, across = volume * (0.25 * radius_ * radius_);
    return SolidMoments::diagonal(volume, {}, {across, across, volume * (half_length_ * half_length_ / 3.0)});
  }

  NormalMeasure area_measure() const {
    constexpr double pi = std::numbers::pi;
    NormalMeasure area;
    area.add(NormalAtom{{0.0, 0.0, -1.0}, pi * radius_ * radius_});
    area.add(NormalAtom{{0.0, 0.0, 1.0}, pi * radius_ * radius_});
    area.add(NormalRing{0.0, 1.0, 2.0 * pi * radius_ * length()});
    return area;
  }
  /// The needle's, and the disc's in two halves, for the two rims: of a sum of bodies it is the sum.
  NormalMeasure mean_curvature_measure() const {
    constexpr double pi = std::numbers::pi;
    NormalMeasure curvature;
    curvature.add(NormalRing{0.0, 1.0, pi * length()});
    curvature.add(NormalRim{0.0, 0.5 * pi, 0.5 * pi * pi * radius_});
    curvature.add(NormalRim{0.5 * pi, pi, 0.5 * pi * pi * radius_});
    return curvature;
  }

 private:
  double half_length_, radius_;
};

}  // namespace vex
