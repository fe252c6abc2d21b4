// The signed distance of two placed bodies' cores, the bodies without their balls, between bounds: the distance by
// Gilbert, Johnson and Keerthi's descent in its textbook form (1988), the depth by a growing polytope. In twice the
// precision of a double; independent of the engine's queries.
#pragma once

#include "tests/referees/difference_hull.h"

namespace vex::exact {

/// The signed distance of the cores: where they share a point, minus the depth. `start`: a direction near the normal,
/// any but zero, which only saves time.
Bounds signed_distance_of_cores(const DifferenceBody& difference, const Vec3dd& start);

/// The distance alone, 0 where they share a point.
Bounds distance_of_cores(const DifferenceBody& difference, const Vec3dd& start);

}  // namespace vex::exact
