// The truth about a placed pair, where exact arithmetic knows it, and where a pair comes into contact.
#pragma once

#include <optional>
#include <vector>

#include "apps/referees/exact_overlap.h"
#include "apps/referees/exact_referee.h"
#include "engine/query/overlap.h"

namespace vex {

/// B's points as docs/derivations.md defines them: of a polytope rounded, under a ball exact.
inline std::vector<exact::Point> exactly_placed(const ExactForm& b, const Transformd& a_from_b) {
  std::vector<exact::Point> points;
  if (b.is_polytope()) {
    for (const Vec3d& p : exact::placed(b.points, a_from_b)) points.push_back(exact::exactly(p));
    return points;
  }
  for (const Vec3d& p : b.points) {
    exact::Point at = exact::exactly(a_from_b.translation);
    const exact::Point own = exact::exactly(p);
    at[0] += exact::inner(exact::exactly(a_from_b.row_x), own);
    at[1] += exact::inner(exact::exactly(a_from_b.row_y), own);
    at[2] += exact::inner(exact::exactly(a_from_b.row_z), own);
    points.push_back(at);
  }
  return points;
}

/// Two sets of points with a ball about each: their hulls come as near as the sum of the radii.
inline Outcome rounded_polytopes_outcome(const ExactForm& a, const ExactForm& b, const Transformd& a_from_b) {
  if (a.is_polytope() && b.is_polytope()) {
    const bool meets = exact::overlap(a.points, exact::placed(b.points, a_from_b));
    return meets ? Outcome::overlap : Outcome::disjoint;
  }
  std::vector<exact::Point> differences;
  for (const exact::Point& q : exactly_placed(b, a_from_b)) {
    for (const Vec3d& p : a.points) differences.push_back(exact::minus(exact::exactly(p), q));
  }
  const exact::Rational radii = exact::Rational(a.ball_radius) + exact::Rational(b.ball_radius);
  return exact::distance_sq_from_origin(differences) <= radii * radii ? Outcome::overlap : Outcome::disjoint;
}

/// None where no referee knows the pair.
inline std::optional<Outcome> true_outcome(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b) {
  const std::optional<ExactForm> form_a = a.exact_form(), form_b = b.exact_form();
  if (form_a && form_b && form_a->is_rounded_polytope() && form_b->is_rounded_polytope()) {
    return rounded_polytopes_outcome(*form_a, *form_b, a_from_b);
  }
  if (has_exact_outcome(a, b)) return exact_outcome(a, b, a_from_b);
  return std::nullopt;
}

/// How far along `dir` B can be moved, turned as `pose` says, and is not seen to be disjoint from A: the contact, to
/// the last bit for pairs that are always decided. It only chooses where a test looks; what the test claims of the
/// neighbourhood it must learn from a referee or a certificate.
inline double contact_along(const ConvexBody& a, const ConvexBody& b, Transformd pose, const Vec3d& dir) {
  double together = 0.0, apart = 4.0 * (a.reach() + b.reach()) / norm(dir);
  for (int step = 0; step < 64; ++step) {
    const double middle = 0.5 * (apart + together);
    pose.translation = middle * dir;
    (overlap(a, b, pose).outcome == Outcome::disjoint ? apart : together) = middle;
  }
  return together;
}

}  // namespace vex
