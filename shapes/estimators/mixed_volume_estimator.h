// The excluded volume from mixed volumes: at each orientation a sum of support values, its mean over the orientations
// <V_ex>. No overlap query, no position, and for polytopes and ellipsoids nothing random but the orientation.
//
// V_ex(R) = |A + (-R B)| = V_A + V_B + integral of h_(-RB) over S_A + integral of h_A over S_(-RB), with the surface
// area measures of shapes/normal_measure.h (H. Minkowski, Math. Ann. 57, 447, 1903; R. Schneider, Convex Bodies: The
// Brunn-Minkowski Theory, 2nd ed., section 5.1).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/sampling/integrand.h"
#include "engine/sampling/poses/orientation_law.h"
#include "shapes/any_shape.h"
#include "shapes/estimators/normal_nodes.h"

namespace vex {

/// Of one pair and law. A copy shares what the bodies' faces were sorted into, and serves another thread.
class MixedVolumeEstimator final : public Integrand {
 public:
  /// Throws UsageError where a body comes without its measures on normals.
  MixedVolumeEstimator(const Body& a, const Body& b, const OrientationLaw& law);

  /// Those of the law, and then for each body one that picks where it has too many faces, and up to two for the normals
  /// of its curved parts; 1 where there is none. What a law or a body makes superfluous is not among them: laws that
  /// spin each body about its z axis, as uniform rotations do, do what the angle about z of a ring's or a rim's normal
  /// would do; the integral of h over the uniform normals of a ball is M of the other body; two ellipsoids have a
  /// closed form at each orientation.
  int dimension() const override { return is_one_sum() ? 1 : n_coordinates_; }
  /// Whether no value hangs on the point: one orientation, of polytopes or of ellipsoids.
  bool is_one_sum() const { return n_coordinates_ == 0; }

  /// An upper bound of V_ex(R), short of what picks and curved parts let a value exceed it by.
  double scale() const override;
  /// `rounding` of the least that the mean can be, or of 2^-20 of `scale` where that is more: for averages that are
  /// smaller yet, as of flat bodies that are all but aligned, it is no bound.
  double relative_rounding() const override;
  /// What the mean over points is off by besides their choice, for a mean of this size; length^3. V, S and the masses
  /// of a mesh are good to 1e-12; to that come the additions and, times the other body's surface area, each body's
  /// support error and what its height changes by where a drawn matrix is off a rotation.
  double rounding(double mean) const;
  double cost() const override;

  Doubts evaluate(std::span<const double> points, std::span<double> values) override;

 private:
  struct Plan;

  double value_at(std::span<const double> point);

  std::shared_ptr<const Plan> plan_;
  int n_coordinates_ = 0;
  NormalColumns normals_a_, normals_b_;
  std::vector<double> buffer_;  // directions and heights
  std::vector<double> point_;
};

}  // namespace vex
