// The radial estimator: the excluded volume as the mean of a volume that a ray cast gives for each point of the unit
// cube. No trial misses, and the values are continuous: quasi-random points gain on random ones.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "engine/numeric/instruction_set.h"
#include "engine/sampling/radial_map.h"
#include "engine/sampling/ray_columns.h"

namespace vex {

/// Of one pair and law; holds references. One instance serves one thread.
class RadialEstimator {
 public:
  RadialEstimator(const ConvexBody& a, const ConvexBody& b, const OrientationLaw& law,
                  InstructionSet set = best_instruction_set());

  int dimension() const { return map_.dimension(); }

  /// values[k] from the point of the open unit cube with the coordinates points[c * values.size() + k]: in length^3,
  /// with <V_ex> of the law as its mean over the cube, to kRadialRounding (2^-26), relative. The same bits for every
  /// set but `scalar`, whose values differ by what PacketRays picks. What packets leave open is found by
  /// `radial_function`.
  ///
  /// Not for an A - B that is thinner than 2^-24 of its length at most orientations, as that of a needle and a ball of
  /// 1e-8: double precision does not tell the frame in which it is round (RadialMap), and few rays have most of the
  /// volume.
  void evaluate(std::span<const double> points, std::span<double> values);

  /// Rays so far that were.
  std::uint64_t n_one_by_one() const { return n_one_by_one_; }
  /// Of those the sum of half of what the bounds of r leave open of the value: where verdicts are undecided, or
  /// coordinates too large beside the bodies, more than kRadialRounding. No more than this over the number of all
  /// values can their mean be off by it.
  double half_width_sum() const { return half_width_sum_; }

 private:
  const ConvexBody& a_;
  const ConvexBody& b_;
  RadialMap map_;
  MakeRays make_rays_;
  std::unique_ptr<PacketRays> packets_;
  std::uint64_t n_one_by_one_ = 0;
  double half_width_sum_ = 0.0;
  RayColumns columns_;
  RadialAnswers answers_;
};

}  // namespace vex
