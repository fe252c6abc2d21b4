// A function on the unit cube whose mean is an average excluded volume: what every estimator is but hit or miss.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace vex {

/// A value whose bounds stayed apart: what it may be off by, beyond rounding.
struct Doubt {
  std::size_t k;      // values[k]
  double half_width;  // half of what lies between the bounds, length^3
};
/// One for each such value, in their order.
using Doubts = std::vector<Doubt>;

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

  /// Whether the mean may be below 0, as no volume is: errors are relative to its size then.
  virtual bool may_be_negative() const { return false; }

  /// What a value is off by, relative to the mean, besides its doubts: a proven bound.
  virtual double relative_rounding() const = 0;
  /// And, where values are differences of larger ones, what it is off by besides that, length^3.
  virtual double absolute_rounding() const { return 0.0; }

  /// Of a value, about, in nanoseconds of one thread: counted, not measured (trial_cost.h).
  virtual double cost() const = 0;

  /// values[k] from the point of the open unit cube with the coordinates points[c * values.size() + k]: in length^3, a
  /// function of these coordinates alone, to the last bit. It hangs neither on the other points, nor on how often this
  /// or another instance was asked before: what is made on the way (tables, caches) changes no bit.
  virtual Doubts evaluate(std::span<const double> points, std::span<double> values) = 0;

  /// Adds to `counted` (Tally::kNCounted places) what the values since the last call took, each a function of its point
  /// alone: for integrands that count something.
  virtual void count(std::span<std::uint64_t> counted);
};

using MakeIntegrand = std::function<std::unique_ptr<Integrand>()>;

}  // namespace vex
