// A flat circular disc in the plane z = 0 about the origin. It has no thickness.
#pragma once

#include <numbers>

#include "engine/support/checked_input.h"
#include "engine/support/combinators.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"

namespace vex {

class Disc {
 public:
  explicit Disc(double radius) : radius_(checked_size(radius, "the radius of a disc")) {}

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return disc_support(radius_, dir);
  }
  double support_error() const { return 8.0 * kUnitRoundoff * radius_; }  // E2
  ExactForm exact_form() const { return {{}, {{{}, {radius_, radius_, 0.0}}}, 0.0}; }
  Vec3d centre() const { return {}; }
  double circumradius() const { return radius_; }
  double inradius() const { return 0.0; }

  /// Both sides count: S = 2 pi R^2, and M = pi^2 R.
  Measures measures() const {
    constexpr double pi = std::numbers::pi;
    return {0.0, 2.0 * pi * radius_ * radius_, pi * pi * radius_};
  }

  NormalMeasure area_measure() const {
    NormalMeasure area;
    for (const double side : {-1.0, 1.0}) {
      area.add(NormalAtom{{0.0, 0.0, side}, std::numbers::pi * radius_ * radius_});
    }
    return area;
  }
  /// The rim, an edge of length 2 pi R with exterior angle pi.
  NormalMeasure mean_curvature_measure() const {
    constexpr double pi = std::numbers::pi;
    NormalMeasure curvature;
    curvature.add(NormalRim{0.0, pi, pi * pi * radius_});
    return curvature;
  }

 private:
  double radius_;
};

}  // namespace vex
