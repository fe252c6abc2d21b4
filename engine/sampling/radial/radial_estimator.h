// The radial estimator: the excluded volume as the mean of a volume that a ray cast gives for each point of the unit
// cube. No trial misses, and the values are continuous: quasi-random points gain on random ones.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "engine/numeric/instruction_set.h"
#include "engine/sampling/integrand.h"
#include "engine/sampling/radial/radial_map.h"
#include "engine/sampling/radial/radial_steps.h"
#include "engine/sampling/radial/ray_columns.h"
#include "engine/sampling/trial_cost.h"

namespace vex {

/// Of one pair and law. One instance serves one thread.
class RadialEstimator final : public Integrand {
 public:
  RadialEstimator(const ConvexBody& a, const ConvexBody& b, const OrientationLaw& law,
                  InstructionSet set = best_instruction_set());

  int dimension() const override { return map_.dimension(); }
  /// The pick.
  int n_independent_coordinates() const override { return 1; }
  double scale() const override;
  /// Of r three times; and of bounds that are as close as they come, with what is added to them for rounding.
  double relative_rounding() const override { return 8.0 * kRadialRounding; }

  double cost() const override { return ray_cost(a_, b_, map_); }

  /// With <V_ex> of the law as the mean over the cube. The same bits for every set. What packets leave open is found by
  /// `radial_function`; undecided are those whose bounds it cannot close, where verdicts are undecided or coordinates
  /// too large beside the bodies.
  ///
  /// Not where RadialMap::is_too_thin.
  Doubts evaluate(std::span<const double> points, std::span<double> values) override;

  /// Rays so far that packets left open.
  std::uint64_t n_one_by_one() const { return n_one_by_one_; }

 private:
  ConvexBody a_, b_;
  RadialMap map_;
  MakeRays make_rays_;
  std::unique_ptr<PacketRays> packets_;
  std::uint64_t n_one_by_one_ = 0;
  RayColumns columns_;
  RadialAnswers answers_;
};

}  // namespace vex
