// What is not a body is refused where it is made, in every build: a proof about a box of NaN edges proves nothing.
#pragma once

#include "engine/numeric/vec3.h"

namespace vex {

/// `size`, where it is positive and finite. Throws InputError; `what`: "the radius of a sphere".
double checked_size(double size, const char* what);
/// The same, and 0 will do.
double checked_size_or_zero(double size, const char* what);

namespace detail {
/// What a support mapping says of itself, asked once, when it becomes a ConvexBody.
struct BodyClaims {
  Vec3d centre;
  double circumradius, inradius, support_error, core_support_error, ball_radius, rolling_radius;
};
/// Throws InputError where a claim is not finite or negative, where nothing of the body is finite, or where the ball
/// inside is larger than the one around.
void check_claims(const BodyClaims& claims);
}  // namespace detail

}  // namespace vex
