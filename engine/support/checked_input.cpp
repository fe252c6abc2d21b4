#include "engine/support/checked_input.h"

#include <cmath>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"

namespace vex {
double checked_size(double size, const char* what) {
  if (size > 0.0 && std::isfinite(size)) return size;
  throw InputError(std::string(what) + " is not positive and finite (" + shortest_number(size) +
                   ") - every size of a body must be");
}

double checked_size_or_zero(double size, const char* what) {
  if (size >= 0.0 && std::isfinite(size)) return size;
  throw InputError(std::string(what) + " is negative or not finite (" + shortest_number(size) +
                   ") - give a length from 0 up");
}

namespace detail {

void check_claims(const BodyClaims& claims) {
  if (!is_finite(claims.centre)) {
    throw InputError("the centre of a body is not finite - sizes are too large, or no numbers");
  }
  checked_size_or_zero(claims.circumradius, "the circumradius of a body");
  checked_size_or_zero(claims.inradius, "the inradius of a body");
  checked_size_or_zero(claims.support_error, "the support error of a body");
  checked_size_or_zero(claims.core_support_error, "the support error of a body's core");
  checked_size_or_zero(claims.ball_radius, "the radius of the ball about a body's core");
  checked_size_or_zero(claims.rolling_radius, "the rolling radius of a body");
  // Both are bounds that are rounded outwards: of a ball they are equal.
  if (claims.inradius > claims.circumradius) {
    throw InputError("a body's inradius exceeds its circumradius (" + shortest_number(claims.inradius) + " and " +
                     shortest_number(claims.circumradius) + ") - mend what the support mapping says of itself");
  }
}

}  // namespace detail
}  // namespace vex
