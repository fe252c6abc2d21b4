// The ball of radius R about the origin.
#pragma once

#include <numbers>

#include "engine/support/checked_input.h"
#include "engine/support/combinators.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"
#include "shapes/solid_moments.h"

namespace vex {

class Sphere {
 public:
  explicit Sphere(double radius) : radius_(checked_size(radius, "the radius of a sphere")) {}

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return ball_support(L(radius_), dir);
  }
  bool rounds_as_kernels() const { return true; }
  /// Length of dir within 3 u, quotient and product each u (E2).
  double support_error() const { return 8.0 * kUnitRoundoff * radius_; }
  Vec3d centre() const { return {}; }

  /// A point with a ball about it.
  template <class L>
  Vec3<L> core_support(const Vec3<L>&) const {
    return {};
  }
  double core_support_error() const { return 0.0; }
  double ball_radius() const { return radius_; }
  ExactForm exact_form() const { return {{Vec3d{}}, {}, radius_}; }
  Generators generators() const { return {}; }
  double circumradius() const { return radius_; }
  double inradius() const { return radius_; }

  Measures measures() const {
    constexpr double pi = std::numbers::pi;
    return {4.0 / 3.0 * pi * radius_ * radius_ * radius_, 4.0 * pi * radius_ * radius_, 4.0 * pi * radius_};
  }

  SolidMoments solid_moments() const {
    const double volume = measures().volume, square = volume * (0.2 * radius_ * radius_);
    return SolidMoments::diagonal(volume, {}, {square, square, square});
  }

  NormalMeasure area_measure() const { return uniform_normals(measures().surface_area); }
  NormalMeasure mean_curvature_measure() const { return uniform_normals(measures().integrated_mean_curvature); }

 private:
  double radius_;
};

}  // namespace vex
