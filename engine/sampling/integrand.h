// A function on the unit cube whose mean is an average excluded volume: what every estimator is but hit or miss.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "engine/numeric/fixed_point_sum.h"

namespace vex {

/// What the values of some points may be off by, beyond rounding.
struct Doubts {
  std::uint64_t n_undecided = 0;  // values whose bounds stayed apart
  FixedPointSum half_widths;      // of those, half of what lies between the bounds, in units of Integrand::scale()
};

/// One instance serves one thread.
class Integrand {
 public:
  virtual ~Integrand();

  /// Coordinates of a point, at least 1.
  virtual int dimension() const = 0;

  /// How many of the last coordinates must be random on their own, also where the points are a net. A coordinate that
  /// only decides with a probability is one: of a net the share of points below the probability is always nearly the
  /// same, in every scrambling, and their means would agree on a number that is off.
  virtual int n_independent_coordinates() const { return 0; }

  /// A length^3 that few values exceed, and none more than kLargestValue times, up or down. Sums keep 2^-448 of it.
  virtual double scale() const = 0;
  static constexpr double kLargestValue = 0x1p23;

  /// What a value is off by, relative to the mean, besides its doubts: a proven bound.
  virtual double relative_rounding() const = 0;

  /// values[k] from the point of the open unit cube with the coordinates points[c * values.size() + k]: in length^3, a
  /// function of these coordinates alone.
  virtual Doubts evaluate(std::span<const double> points, std::span<double> values) = 0;
};

using MakeIntegrand = std::function<std::unique_ptr<Integrand>()>;

}  // namespace vex
