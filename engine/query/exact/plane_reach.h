// Whether a body reaches a plane, decided in rational numbers, without an error (docs/derivations.md, E29).
#pragma once

#include <optional>

#include "engine/numeric/whole.h"
#include "engine/query/first_contact.h"
#include "engine/query/half_space.h"
#include "engine/query/search/plane_sweep.h"

namespace vex {

/// Whether the body, moved by as much as raises all its heights (times the length of the normal) by `raised`, shares a
/// point with the half-space. Nothing where it has no exact form, or where a placed coordinate is not finite.
std::optional<bool> meets_plane_exactly(const HalfSpace& a, const ConvexBody& b, const Transformd& a_from_b,
                                        const whole::Dyadic& raised);

/// Of the body at rest, of which the least height is known already.
Verdict plane_verdict(const HalfSpace& a, const ConvexBody& b, const Transformd& a_from_b, const LeastHeight& height);

/// Whether the body, which does not meet the half-space at the start, is proven not to at any time until `time`, moving
/// and turning; without rounding its vertices, too. False where it has no exact form.
bool is_clear_until(const HalfSpace& a, const ConvexBody& b, const Transformd& a_from_b, const RigidMotion& motion,
                    double time);

}  // namespace vex
