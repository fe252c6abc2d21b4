#include "engine/query/exact/plane_reach.h"

#include <cmath>

namespace vex {
namespace {

using whole::Dyadic;
using whole::DyadicVector;

DyadicVector scaled_by(const Dyadic& s, const DyadicVector& v) { return {s * v.x, s * v.y, s * v.z}; }
DyadicVector exact_cross(const DyadicVector& p, const DyadicVector& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

// Whether centre - sqrt(spread) <= radius sqrt(length), for a spread from 0 up: an ellipsoid whose centre is that high
// over the plane (times the length of the normal), and goes down from there by the root of the spread, with a ball.
bool reaches_plane(const Dyadic& centre, const Dyadic& spread, double radius, const Dyadic& length_sq) {
  if (sign(centre) <= 0) return true;
  // centre^2 <= spread + radius^2 length^2 + 2 sqrt(spread) radius length
  const Dyadic ball_sq = Dyadic(radius) * Dyadic(radius) * length_sq;
  const Dyadic rest = centre * centre - spread - ball_sq;
  if (sign(rest) <= 0) return true;
  return sign(rest * rest - Dyadic(4.0) * spread * ball_sq) <= 0;
}

// The same of the whole body, of which no point is lower than along `up_in_b`, a direction of its own frame; `origin`
// is the height of its frame's origin.
bool reaches_plane(const ExactForm& form, const DyadicVector& up_in_b, const Dyadic& origin, const Dyadic& length_sq) {
  for (const Vec3d& point : form.points) {
    const Dyadic height = dot(up_in_b, whole::exactly(point)) + origin;
    if (reaches_plane(height, Dyadic(), form.ball_radius, length_sq)) return true;
  }
  for (const ExactForm::Piece& piece : form.pieces) {
    const auto stretch = [](double semi_axis, const Dyadic& along) {
      const Dyadic part = Dyadic(semi_axis) * along;
      return part * part;
    };
    Dyadic spread = stretch(piece.semi_axes.x, up_in_b.x) + stretch(piece.semi_axes.y, up_in_b.y);
    // A dome has nothing below its centre: where down is -z of it, its rim is the lowest.
    if (!piece.is_dome || sign(up_in_b.z) < 0) spread = spread + stretch(piece.semi_axes.z, up_in_b.z);
    const Dyadic centre = dot(up_in_b, whole::exactly(piece.centre)) + origin;
    if (reaches_plane(centre, spread, form.ball_radius, length_sq)) return true;
  }
  return false;
}

}  // namespace

std::optional<bool> meets_plane_exactly(const HalfSpace& a, const ConvexBody& b, const Transformd& a_from_b,
                                        const Dyadic& raised) {
  const std::optional<ExactForm> form = b.exact_form();
  if (!form || !is_finite(a_from_b.translation)) return std::nullopt;
  const DyadicVector normal = whole::exactly(a.dir_normal());
  const Dyadic length_sq = dot(normal, normal), base = raised - Dyadic(a.offset());
  const bool is_rounded = form->is_polytope();
  for (const Vec3d& point : form->points) {
    const Vec3d placed = a_from_b(point);
    if (!is_finite(placed)) return std::nullopt;
    if (is_rounded && sign(dot(normal, whole::exactly(placed)) + base) <= 0) return true;
  }
  if (is_rounded) return false;
  return reaches_plane(*form, whole::direction_to_b(a_from_b, normal),
                       dot(normal, whole::exactly(a_from_b.translation)) + base, length_sq);
}

Verdict plane_verdict(const HalfSpace& a, const ConvexBody& b, const Transformd& a_from_b, const LeastHeight& height) {
  if (height.lower() > 0.0) return Verdict::disjoint(DecidedBy::gjk);
  if (height.upper() <= 0.0) return Verdict::overlap(DecidedBy::gjk);
  const std::optional<bool> meets = meets_plane_exactly(a, b, a_from_b, Dyadic());
  if (!meets) return Verdict::undecided(DecidedBy::gjk, UndecidedReason::rounding);
  return *meets ? Verdict::overlap(DecidedBy::exact) : Verdict::disjoint(DecidedBy::exact);
}

bool is_clear_until(const HalfSpace& a, const ConvexBody& b, const Transformd& a_from_b, const RigidMotion& motion,
                    double time) {
  const std::optional<ExactForm> form = b.exact_form();
  const double bent = PlaneSweep(a, b, a_from_b, motion).fall_by_bending(time);
  if (!form || !std::isfinite(bent) || !std::isfinite(time)) return false;
  const DyadicVector normal = whole::exactly(a.dir_normal()), w = whole::exactly(motion.angular_velocity);
  const Dyadic length_sq = dot(normal, normal), t(time);
  const Dyadic at_first = dot(normal, whole::exactly(a_from_b.translation)) - Dyadic(a.offset());
  // What is linear in time is the least of linear functions, so concave, and so is that less what bends: it is above 0
  // where it is so at both ends.
  const Dyadic at_last = at_first + t * dot(normal, whole::exactly(motion.velocity)) - Dyadic(bent);
  const DyadicVector leaning = normal + scaled_by(t, exact_cross(normal, w));
  return !reaches_plane(*form, whole::direction_to_b(a_from_b, normal), at_first, length_sq) &&
         !reaches_plane(*form, whole::direction_to_b(a_from_b, leaning), at_last, length_sq);
}

}  // namespace vex
