// The checker of distances and depths (docs/derivations.md, E24).
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/numeric/rounding.h"
#include "engine/query/checker/exact_hull.h"
#include "engine/query/checker/exact_pair.h"
#include "engine/query/checker/inner_balls.h"
#include "engine/query/checker/witness_proof.h"
#include "engine/query/separation_certificate.h"

namespace vex {
namespace {

using checker::ExactPair;
using whole::Dyadic;
using whole::DyadicVector;

// Of its circumradius: no point of an answer is farther out of its own body, rounding apart.
constexpr double kOfOwnBody = 1e-12;

// The verdict and both bounds.
std::string fault_of_bounds(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const ExactPair& pair,
                            const Separation& claimed, const SeparationCertificate& certificate) {
  const Outcome outcome = claimed.verdict.outcome;
  switch (outcome) {
    case Outcome::disjoint:
    case Outcome::overlap:
    case Outcome::undecided: break;
    default: return "the verdict is none";
  }
  const bool sign_is_proven =
      outcome != Outcome::undecided && check_certificate(a, b, pose.a_from_b(), outcome, certificate.sign).is_proven;
  const bool is_apart = outcome == Outcome::disjoint, meets = outcome == Outcome::overlap;
  // A sign that is not proven by itself is one that a bound proves.
  const double lower = is_apart && !sign_is_proven ? std::max(claimed.lower, kLeastGap) : claimed.lower;
  const double upper = meets && !sign_is_proven ? std::min(claimed.upper, -kLeastGap) : claimed.upper;
  const bool lower_by_sign = is_apart && sign_is_proven && lower <= 0.0;
  const bool upper_by_sign = meets && sign_is_proven && upper >= 0.0;
  if (!lower_by_sign && lower > -HUGE_VAL) {
    if (!std::isfinite(lower)) return "the lower bound is no number";
    if (!is_apart_by(pair, certificate.dir, Dyadic(lower))) return "the direction does not prove the lower bound";
  }
  if (!upper_by_sign && upper < HUGE_VAL) {
    if (!std::isfinite(upper)) return "the upper bound is no number";
    if (!comes_as_near_as(pair, certificate.hull, Dyadic(upper)) &&
        !checker::balls_come_as_near_as(pair.a(), pair.b(), pose.a_from_b(), Dyadic(upper))) {
      return "the witnesses do not prove the upper bound";
    }
  }
  return {};
}

// Points that are where they are said to be: of their bodies, and apart along the normal.
std::string fault_of_points(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const ExactPair& pair,
                            const Separation& claimed, const SeparationCertificate& certificate) {
  for (const Vec3d& v : {claimed.normal, claimed.point_a, claimed.point_b, claimed.point_b_in_b}) {
    if (!is_finite(v)) return "a point or the normal is not finite";
  }
  const double far =
      norm_1(claimed.point_a) + norm_1(claimed.point_b) + b.reach() + norm_1(pose.a_from_b().translation);
  const double promised = promised_accuracy(a, b, claimed);
  const auto rounding = [](const Vec3d& point, const ConvexBody& body) {
    return kOfOwnBody * body.circumradius() + 16.0 * kUnitRoundoff * (norm_1(point) + body.reach());
  };
  const double own_a = rounding(claimed.point_a, a), own_b = rounding(claimed.point_b_in_b, b);
  for (const double allowance : {promised, far, own_a, own_b}) {
    if (!std::isfinite(allowance)) return "points are so far that no double tells what rounding allows them";
  }
  const Dyadic accuracy(promised), one(1.0), few(0x1p-48);
  const DyadicVector normal = whole::exactly(claimed.normal), point_a = whole::exactly(claimed.point_a),
                     point_b = whole::exactly(claimed.point_b);
  const Dyadic stretch = dot(normal, normal) - one;
  if (few < stretch || stretch < -few) return "the normal is no unit vector";
  const Dyadic near_enough = accuracy + Dyadic(16.0 * kUnitRoundoff * far);
  const Dyadic distance(claimed.signed_distance);
  // Or any points of the bodies as far apart would do.
  if (!is_apart_by(pair, {{{claimed.normal, 0}}}, distance - near_enough)) {
    return "along the normal the bodies are not apart by the distance, or in each other by the depth";
  }
  const DyadicVector off =
      point_b - point_a - DyadicVector{distance * normal.x, distance * normal.y, distance * normal.z};
  if (near_enough * near_enough < dot(off, off)) return "the points are not the distance apart along the normal";
  if (!is_near_a(pair, certificate.near_a, point_a, near_enough)) return "point_a is not proven to be near A";
  if (!is_near_b(pair, certificate.near_b, point_b, near_enough)) return "point_b is not proven to be near B";
  // In its own body, too, however far the other one is.
  if (!is_near_a(pair, certificate.near_a, point_a, Dyadic(own_a))) return "point_a is not in A";
  if (!is_near_b(pair.moved(checker::exactly(Transformd{})), certificate.near_b, whole::exactly(claimed.point_b_in_b),
                 Dyadic(own_b))) {
    return "point_b_in_b is not in B";
  }
  return {};
}

}  // namespace

double promised_accuracy(const ConvexBody& a, const ConvexBody& b, const Separation& found) {
  const double size = std::fabs(found.signed_distance) + (a.circumradius() + b.circumradius());
  const double relative = a.is_rounded_polytope() && b.is_rounded_polytope() ? 1e-12 : 1e-9;
  const double width = found.upper - found.lower;
  return std::fmax(relative * size, width < HUGE_VAL ? width : 0.0);
}

CertificateCheck check_certificate(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                                   const Separation& claimed, const SeparationCertificate& certificate) {
  std::string fault;
  const std::optional<ExactPair> pair = ExactPair::of(a, b, pose.a_from_b(), fault);
  if (fault.empty() && !(claimed.lower <= claimed.upper)) fault = "the bounds exclude each other";
  if (fault.empty() && !(claimed.lower <= claimed.signed_distance && claimed.signed_distance <= claimed.upper)) {
    fault = "the value is not between its bounds";
  }
  if (fault.empty() && !std::isfinite(claimed.signed_distance)) fault = "the value is no number";
  if (fault.empty()) fault = fault_of_bounds(a, b, pose, *pair, claimed, certificate);
  if (fault.empty() && claimed.has_witnesses) fault = fault_of_points(a, b, pose, *pair, claimed, certificate);
  return {fault.empty(), std::move(fault)};
}

}  // namespace vex
