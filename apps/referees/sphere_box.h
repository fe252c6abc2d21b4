// Do a sphere and a box share a point? The distance from the sphere's centre to the nearest point of the box.
#pragma once

#include "engine/numeric/transform.h"
#include "engine/query/verdict.h"
#include "shapes/box.h"

namespace vex {

/// J. Arvo, "A simple method for box-sphere intersection testing", Graphics Gems, 1990: clamp the centre to the box.
/// Undecided within rounding of contact (E10).
Outcome box_and_sphere_overlap(const Box& a, double radius, const Transformd& a_from_b);
Outcome sphere_and_box_overlap(double radius, const Box& b, const Transformd& a_from_b);

}  // namespace vex
