// A control variate of clusters: functions of a neighbour's place whose means are known.
//
// The weight of a cluster hangs first of all on how far each body is from the one before: near ones overlap the same
// others. Of neighbours that are drawn uniformly from all poses at which they overlap, whose measure is <V_ex>, the
// distance r of the centres has the density 4 pi r^2 / <V_ex> up to R, the sum of the inscribed balls' radii, for there
// they overlap whatever their orientations. So the mean of (1 - (r/R)^2)^k, 0 beyond R, is known for every k.
//
// Neighbours that count for a factor, of mean 1 (turned_neighbours.h), have one function more: the factor itself.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/numeric/vec3.h"
#include "engine/support/convex_body.h"

namespace vex {

class DistanceControl {
 public:
  static constexpr std::size_t kN = 4;
  using Values = std::array<double, kN>;

  /// `excluded_volume`, length^3, to within the relative error. Its functions are all 0 where that is not known (NaN),
  /// or the inscribed balls are so small that nothing is gained; but for the last one, where neighbours have a factor.
  DistanceControl(const ConvexBody& a, const ConvexBody& b, double excluded_volume, double relative_error,
                  bool has_factors = false);

  bool is_usable() const { return share_ > 0.0 || has_factors_; }
  /// Adds the functions times the neighbour's factor, less their means, of B's centre as it is seen from A's.
  void add(const Vec3d& from_a_to_b, Values& sums, double factor = 1.0) const;
  /// What a mean of them may be off by, since <V_ex>, R and r are rounded.
  double rounding() const { return rounding_; }

 private:
  double inner_sq_ = 0.0, share_ = 0.0, rounding_ = 0.0;
  bool has_factors_;
};

/// What is taken off a value: factors times the means of the functions over a bunch's poses. Any factors leave its mean
/// as it is; good ones are those of a regression (VirialIntegrand::control_of).
struct VirialControl {
  DistanceControl functions;
  DistanceControl::Values factors{};

  /// The factors of the least squares of `values`, given the functions' means beside each.
  void fit(std::vector<double> values, std::span<const DistanceControl::Values> means);

  double absolute_rounding() const;
};

}  // namespace vex
