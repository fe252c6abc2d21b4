// A pair of bodies as the kernels take it.
#pragma once

#include <optional>

#include "engine/sampling/domain.h"
#include "engine/support/convex_body.h"
#include "tests/opencl/pair.h"

namespace vex {

/// Of isotropic orientations. None for a pair that the kernels do not take: cores other than boxes (plates, needles and
/// points among them), ellipsoids, and hulls of up to VEX_MOST_VERTICES points; lengths whose products could over- or
/// underflow; a domain that is fitted.
std::optional<VexPair> pair_of_bodies(const ConvexBody& a, const ConvexBody& b, const Domain& domain);

}  // namespace vex
