// What is not a body is refused where it is made, in every build: a proof about a box of NaN edges proves nothing.
#pragma once

#include <optional>

#include "engine/numeric/vec3.h"
#include "engine/support/exact_form.h"
#include "engine/support/generators.h"

namespace vex {

/// Sizes of bodies: halves of them are exact, and their products with u are no subnormal numbers.
inline constexpr double kLeastBodySize = 1e-300, kLargestBodySize = 1e300;

/// `size`, where it is in the range. Throws InputError; `what`: "the radius of a sphere".
double checked_size(double size, const char* what);
/// The same, and 0 will do.
double checked_size_or_zero(double size, const char* what);

namespace detail {
/// What a support mapping says of itself, asked once, when it becomes a ConvexBody.
struct BodyClaims {
  Vec3d centre;
  double circumradius, inradius, support_error, core_support_error, ball_radius, rolling_radius;
};
/// Throws InputError where a claim is not finite or negative, where the ball inside is larger than the one around, or
/// where the exact form or the generators hold what is no number, or nothing.
void check_claims(const BodyClaims& claims, const std::optional<ExactForm>& form,
                  const std::optional<Generators>& generators);
}  // namespace detail

}  // namespace vex
