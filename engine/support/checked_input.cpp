#include "engine/support/checked_input.h"

#include <cmath>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"

namespace vex {
namespace {

void check_bound(double claim, const char* what) {
  if (claim >= 0.0 && std::isfinite(claim)) return;
  throw InputError(std::string(what) + " is negative or not finite (" + shortest_number(claim) +
                   ") - mend what the support mapping says of itself");
}

void check_form(const ExactForm& form) {
  bool is_good =
      form.ball_radius >= 0.0 && std::isfinite(form.ball_radius) && form.points.size() + form.pieces.size() > 0;
  for (const Vec3d& p : form.points) is_good = is_good && is_finite(p);
  for (const ExactForm::Piece& piece : form.pieces) {
    const auto& [x, y, z] = piece.semi_axes;
    is_good = is_good && is_finite(piece.centre) && is_finite(piece.semi_axes) && x >= 0.0 && y >= 0.0 && z >= 0.0;
  }
  if (!is_good) {
    throw InputError(
        "the exact form of a body has no points, or some that are not finite - mend what the body says of itself");
  }
}

void check_generators(const Generators& generators) {
  bool is_good = is_finite(generators.centre) && generators.n_vectors >= 0 && generators.n_vectors <= 3;
  for (const Vec3d& v : generators.vectors) is_good = is_good && is_finite(v);
  if (!is_good) {
    throw InputError("the generators of a body are not up to three finite vectors - mend what the body says of itself");
  }
}

}  // namespace

double checked_size(double size, const char* what) {
  if (!(size > 0.0 && std::isfinite(size))) {
    throw InputError(std::string(what) + " is not positive and finite (" + shortest_number(size) +
                     ") - every size of a body must be");
  }
  if (size >= kLeastBodySize && size <= kLargestBodySize) return size;
  throw InputError(std::string(what) + " is out of range (" + shortest_number(size) + ") - use sizes from " +
                   shortest_number(kLeastBodySize) + " to " + shortest_number(kLargestBodySize));
}

double checked_size_or_zero(double size, const char* what) {
  if (size == 0.0) return size;
  if (size > 0.0) return checked_size(size, what);
  throw InputError(std::string(what) + " is negative or no number (" + shortest_number(size) +
                   ") - give a length from 0 up");
}

namespace detail {

void check_claims(const BodyClaims& claims, const std::optional<ExactForm>& form,
                  const std::optional<Generators>& generators) {
  if (!is_finite(claims.centre)) {
    throw InputError("the centre of a body is not finite - sizes are too large, or no numbers");
  }
  checked_size_or_zero(claims.circumradius, "the circumradius of a body");
  check_bound(claims.inradius, "the inradius of a body");
  check_bound(claims.support_error, "the support error of a body");
  check_bound(claims.core_support_error, "the support error of a body's core");
  check_bound(claims.ball_radius, "the radius of the ball about a body's core");
  check_bound(claims.rolling_radius, "the rolling radius of a body");
  if (form) check_form(*form);
  if (generators) check_generators(*generators);
  // Both are bounds that are rounded outwards: of a ball they are equal.
  if (claims.inradius > claims.circumradius) {
    throw InputError("a body's inradius exceeds its circumradius (" + shortest_number(claims.inradius) + " and " +
                     shortest_number(claims.circumradius) + ") - mend what the support mapping says of itself");
  }
}

}  // namespace detail
}  // namespace vex
