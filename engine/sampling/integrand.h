// A function on the unit cube whose mean is an average excluded volume: what every estimator is but hit or miss.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace vex {

/// What the values of some points may be off by, beyond rounding.
struct Doubts {
  std::uint64_t n_undecided = 0;  // values whose bounds stayed apart
  double half_width_sum = 0.0;    // of those, half of what lies between the bounds; length^3
};

/// One instance serves one thread.
class Integrand {
 public:
  virtual ~Integrand();

  /// Coordinates of a point, at least 1.
  virtual int dimension() const = 0;

  /// A length^3 of the order of the mean: no value is larger than 2^64 times it, up or down.
  virtual double scale() const = 0;

  /// What a value is off by, relative to the mean, besides its doubts: a proven bound.
  virtual double relative_rounding() const = 0;

  /// values[k] from the point of the open unit cube with the coordinates points[c * values.size() + k]: in length^3, a
  /// function of these coordinates alone.
  virtual Doubts evaluate(std::span<const double> points, std::span<double> values) = 0;
};

using MakeIntegrand = std::function<std::unique_ptr<Integrand>()>;

}  // namespace vex
