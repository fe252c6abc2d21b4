// The average excluded volume over uniform rotations from support values alone: for bodies whose V and S are known, but
// not M.
//
// <V_ex> = V_A + V_B + S_B hbar_A + S_A hbar_B, hbar being the mean of the support function over all directions, which
// is M / 4 pi: half the mean width (T. Kihara, Rev. Mod. Phys. 25, 831, 1953).
#pragma once

#include <span>

#include "engine/sampling/integrand.h"
#include "engine/sampling/poses/orientation_law.h"
#include "shapes/any_shape.h"
#include "shapes/estimators/core_heights.h"

namespace vex {

/// What is asked of a body besides its support values. Length^3 and length^2.
struct VolumeAndSurface {
  double volume = 0.0, surface_area = 0.0;
};

/// Each point of the unit square is a direction u of the 48th part of the sphere in which x >= y >= z >= 0; the value
/// is made of the mean of h over the 48 directions that reflections and exchanges of the axes make of u, the same for
/// both bodies. Together they are uniform on the sphere, so the mean is exact for every body, with whatever symmetry;
/// and what is left to vary is little, for needles and plates too: no spherical harmonic but those of the cube's
/// symmetry, of degree 4 and more.
///
/// Of a body that is not nearly about the origin of its frame values lose digits by its distance over its size.
class MeanWidthEstimator final : public Integrand {
 public:
  /// V and S as given, taken for exact. Where `a` and `b` are one object it is asked once a direction. Throws
  /// UsageError for a law that is not isotropic.
  MeanWidthEstimator(const ConvexBody& a, const VolumeAndSurface& of_a, const ConvexBody& b,
                     const VolumeAndSurface& of_b, const OrientationLaw& law = {});
  /// M of `measures` is not looked at.
  MeanWidthEstimator(const Body& a, const Body& b, const OrientationLaw& law = {});

  int dimension() const override { return 2; }
  /// V_A + V_B + S_B R_A + S_A R_B, R the circumradius: an upper bound of every value.
  double scale() const override { return scale_; }
  double relative_rounding() const override { return relative_rounding_; }
  double cost() const override;

  Doubts evaluate(std::span<const double> points, std::span<double> values) override;

 private:
  CoreHeights heights_a_, heights_b_;
  VolumeAndSurface of_a_, of_b_;
  bool is_one_body_;
  double certain_ = 0.0, scale_ = 0.0, relative_rounding_ = 0.0;
};

}  // namespace vex
