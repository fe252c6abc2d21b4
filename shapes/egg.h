// An egg: two half spheroids of one equator, which is in the plane z = 0 about the origin. Axis z.
#pragma once

#include <algorithm>
#include <numbers>

#include "engine/support/checked_input.h"
#include "engine/support/combinators.h"
#include "shapes/ellipsoid.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"
#include "shapes/solid_moments.h"

namespace vex {

class Egg {
 public:
  /// The radius at the equator, and the heights below and above it.
  Egg(double radius, double below, double above) : lower_(radius, radius, below), upper_(radius, radius, above) {}

  /// Of the spheroid that the direction looks at.
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return select<L>(dir.z > L(0.0), upper_.support(dir), lower_.support(dir));
  }
  ProfileForm profile_form() const { return EggProfile(radius(), below(), above()); }
  double support_error() const { return std::max(lower_.support_error(), upper_.support_error()); }  // E2
  Vec3d centre() const { return {}; }
  double circumradius() const { return std::max(lower_.circumradius(), upper_.circumradius()); }
  double inradius() const { return std::min(lower_.inradius(), upper_.inradius()); }
  double rolling_radius() const { return std::min(lower_.rolling_radius(), upper_.rolling_radius()); }

  double radius() const { return upper_.semi_axes().x; }
  double below() const { return lower_.semi_axes().z; }
  double above() const { return upper_.semi_axes().z; }

  /// Half of each spheroid's: their surfaces meet with one tangent.
  Measures measures() const {
    const Measures p = lower_.measures(), q = upper_.measures();
    return {0.5 * (p.volume + q.volume), 0.5 * (p.surface_area + q.surface_area),
            0.5 * (p.integrated_mean_curvature + q.integrated_mean_curvature)};
  }

  /// The centroid of a half is at 3/8 of its height.
  SolidMoments solid_moments() const {
    const double p = below(), q = above(), volume = measures().volume;
    const double lower = volume * (p / (p + q)), upper = volume * (q / (p + q)), mean = 0.375 * (q - p);
    const double across = volume * (0.2 * radius() * radius());
    return SolidMoments::diagonal(volume, {0.0, 0.0, mean},
                                  {across, across, 0.2 * (lower * p * p + upper * q * q) - volume * mean * mean});
  }

  NormalMeasure area_measure() const {
    NormalMeasure area;
    area.add(HalfSpheroidNormals{radius(), above(), true, false, 0.5 * upper_.measures().surface_area});
    area.add(HalfSpheroidNormals{radius(), below(), false, false, 0.5 * lower_.measures().surface_area});
    return area;
  }
  NormalMeasure mean_curvature_measure() const {
    NormalMeasure curvature;
    curvature.add(
        HalfSpheroidNormals{radius(), above(), true, true, 0.5 * upper_.measures().integrated_mean_curvature});
    curvature.add(
        HalfSpheroidNormals{radius(), below(), false, true, 0.5 * lower_.measures().integrated_mean_curvature});
    return curvature;
  }

 private:
  Ellipsoid lower_, upper_;
};

}  // namespace vex
