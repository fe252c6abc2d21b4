// A bound from above of distances and depths that asks for no witness: a ball in either body (docs/derivations.md,
// E25). For concentric spheres that are given as ellipsoids, whose difference no hull of points fills.
#pragma once

#include "engine/numeric/transform.h"
#include "engine/numeric/whole.h"
#include "engine/support/exact_form.h"

namespace vex::checker {

/// The signed distance is `upper` at most, for it is of two balls, one in A and one in B as it is placed.
bool balls_come_as_near_as(const ExactForm& a, const ExactForm& b, const Transformd& a_from_b,
                           const whole::Dyadic& upper);

}  // namespace vex::checker
