#include "engine/sampling/radial/radial_map.h"

#include <array>
#include <cmath>
#include <utility>

namespace vex {

RadialNumbers::RadialNumbers(const ConvexBody& a, const ConvexBody& b, const OrientationLaw* law)
    : law_(law), a_(radial_body(a)), b_(radial_body(b)) {
  using Form = RadialBody::Form;
  is_swapped_ = a_.form == Form::lump && b_.form != Form::lump;
  if (is_swapped_) std::swap(a_, b_);
  if (a_.form == Form::rod && b_.form == Form::rod) {
    long_body_ = LongBody::both;
  } else if (a_.form == Form::rod && b_.form == Form::slab) {
    long_body_ = LongBody::a;
  } else if (a_.form == Form::slab && b_.form == Form::rod) {
    long_body_ = LongBody::b;
  }
}

bool RadialNumbers::is_too_thin() const {
  constexpr int kRays = 63;
  constexpr double kThinnest = 0x1p-44;  // of squares
  int n_thin = 0;
  for (int k = 0; k < kRays; ++k) {
    std::array<double, kMaxDimension> point;
    // Multiples of the powers of a root of x^9 = x + 1, which spread over every coordinate.
    constexpr double kRatio = 1.0 / 1.0850702454914508;
    double step = 1.0;
    for (double& coordinate : point) {
      step *= kRatio;
      const double at = 0.5 + (k + 1) * step;
      coordinate = at - std::floor(at);
    }
    Transformd r = (*this)(std::span<const double>(point)).rotation;
    if (is_swapped_) r = transposed(r);
    const std::array<double, 3> squares = principal_values(of_difference(in_own_axes(r)));
    if (!(squares[2] > kThinnest * squares[0])) ++n_thin;
  }
  return 2 * n_thin > kRays;
}

}  // namespace vex
