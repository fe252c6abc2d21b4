// Half a ball: the flat face in the plane z = 0 about the origin, the dome on the side of +z.
#pragma once

#include <cmath>
#include <numbers>

#include "engine/support/checked_input.h"
#include "engine/support/combinators.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"
#include "shapes/solid_moments.h"

namespace vex {

class Hemisphere {
 public:
  explicit Hemisphere(double radius) : radius_(checked_size(radius, "the radius of a hemisphere")) {}

  /// On the dome for directions upwards, on the rim for all others.
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return select<L>(dir.z > L(0.0), ball_support(L(radius_), dir), disc_support(radius_, dir));
  }
  double support_error() const { return 8.0 * kUnitRoundoff * radius_; }  // the ball's and the disc's (E2)
  ExactForm exact_form() const { return {{}, {{{}, {radius_, radius_, radius_}, true}}, 0.0}; }
  /// Not far above the flat face: the ball of radius R about the origin is the smallest around it, but leaves no ball
  /// inside. An eighth costs 2 % of volume of the outer ball.
  Vec3d centre() const { return {0.0, 0.0, 0.125 * radius_}; }
  double circumradius() const { return std::hypot(1.0, 0.125) * radius_ * (1.0 + gamma(4)); }
  double inradius() const { return 0.125 * radius_; }

  /// The dome's 2 pi R; the rim, an edge of length 2 pi R with exterior angle pi/2, adds half of that times pi/2.
  Measures measures() const {
    constexpr double pi = std::numbers::pi;
    const double r = radius_;
    return {2.0 / 3.0 * pi * r * r * r, 3.0 * pi * r * r, pi * r * (2.0 + 0.5 * pi)};
  }

  /// About the flat face's middle as of the whole ball; the centroid is 3/8 R above it.
  SolidMoments solid_moments() const {
    const double volume = measures().volume, square = radius_ * radius_, across = volume * (0.2 * square);
    return SolidMoments::diagonal(volume, {0.0, 0.0, 0.375 * radius_},
                                  {across, across, volume * (19.0 / 320.0 * square)});
  }

  NormalMeasure area_measure() const {
    constexpr double pi = std::numbers::pi;
    NormalMeasure area;
    area.add(NormalAtom{{0.0, 0.0, -1.0}, pi * radius_ * radius_});
    area.add(NormalZone{0.0, 1.0, 2.0 * pi * radius_ * radius_});
    return area;
  }
  NormalMeasure mean_curvature_measure() const {
    constexpr double pi = std::numbers::pi;
    NormalMeasure curvature;
    curvature.add(NormalZone{0.0, 1.0, 2.0 * pi * radius_});
    curvature.add(NormalRim{0.5 * pi, pi, 0.5 * pi * pi * radius_});
    return curvature;
  }

 private:
  double radius_;
};

}  // namespace vex
