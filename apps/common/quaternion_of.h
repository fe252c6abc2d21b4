// The quaternion of a rotation.
#pragma once

#include <array>

#include "engine/numeric/transform.h"

namespace vex {

/// w, x, y, z of length 1, of R without its translation. The largest component is found first (S. W. Shepperd, J.
/// Guidance and Control 1, 223, 1978), so that it is none that rounding leaves nothing of.
std::array<double, 4> quaternion_of(const Transformd& pose);

}  // namespace vex
