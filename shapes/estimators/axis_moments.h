// Legendre moments of one body's axis under an orientation law.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/sampling/poses/axis_law.h"
#include "shapes/estimators/legendre_series.h"

namespace vex {

inline constexpr std::size_t kMaxDegreeOfMoments = 2048;  // even

struct AxisMoments {
  LegendreSeries by_degree;      // <P_l(cos theta)>, from 0 up; of degree 1 it is 0, for no body has a part of it
  double tail = 0.0;             // bounds on the sums over the degrees above of |<P_l>| / l
  double tail_of_squares = 0.0;  // and of <P_l>^2 / l
  double rounding = 0.0;         // of each beyond some 1e-12
};

/// Nothing where a series of them is of no use or would take more than some tenths of a second: isotropic, a cone of 0
/// degrees, alpha above 500, tables of more than some 50 000 points. Those of odd degree are 0 where up and down are
/// alike.
std::optional<AxisMoments> axis_moments(const AxisLaw& law);

}  // namespace vex
