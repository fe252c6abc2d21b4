#include "engine/sampling/radial/radial_function.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/rounding.h"
#include "engine/numeric/scaled_bound.h"
#include "engine/query/overlap.h"
#include "engine/query/packets/packet_overlap.h"
#include "engine/sampling/radial/radial_steps.h"

namespace vex {
namespace {

constexpr int kMostWedges = 32, kMostPortalsInside = 128, kMostAttempts = 3;

// K, moved so that the difference of the points is the origin.
class CentredDifference {
 public:
  CentredDifference(const ConvexBody& a, const ConvexBody& b, const BodyPoints& points, const Transformd& rotation)
      : a_(a), b_(b), points_(points), rotation_(rotation) {
    rotation_.translation = {};
  }

  Vec3d support(const Vec3d& dir) {
    ++n_calls_;
    const Vec3d at_b = b_.support(-rotation_.direction_to_b(dir)) - points_.of_b;
    return (a_.support(dir) - points_.of_a) - rotation_(at_b);
  }
  RadialError error() const {
    const double reach = a_.reach() + 2.0 * b_.reach();
    return {a_.support_error() + 2.0 * b_.support_error() + 80.0 * kUnitRoundoff * reach, 2.0 * reach};
  }
  int n_calls() const { return n_calls_; }

 private:
  const ConvexBody& a_;
  const ConvexBody& b_;
  BodyPoints points_;
  Transformd rotation_;
  int n_calls_ = 0;
};

// Of support points along three directions about the ray's, as it is for a ball; or a wedge, turned until the ray
// passes.
std::optional<Portal<double>> portal_around(CentredDifference& difference, const Vec3d& dir, const RadialError& error) {
  const Vec3d aside = std::fabs(dir.x) < std::fabs(dir.y) ? Vec3d{1.0, 0.0, 0.0} : Vec3d{0.0, 1.0, 0.0};
  const Vec3d across_1 = cross(dir, aside);
  const Vec3d across_2 = (1.0 / norm(dir)) * cross(dir, across_1);
  const auto leaning = [&](double x, double y) {
    return difference.support(dir + kRadialSpread * (x * across_1 + y * across_2));
  };
  constexpr double kSide = 0.5 * std::numbers::sqrt3;
  const Portal<double> first{leaning(1.0, 0.0), leaning(-0.5, kSide), leaning(-0.5, -kSide)};
  if (is_portal(first, dir, error)) return first;
  Vec3d v1 = difference.support(dir);
  Vec3d v2 = difference.support(towards_ray(v1, dir));
  // In a plane with the ray, as opposite points are: none of the wedge's sides is the ray's.
  if (!(std::fabs(turn_of(v1, v2, dir)) > error.of_turn(dir))) v2 = difference.support(cross(v1, dir));
  if (turn_of(v1, v2, dir) < 0.0) std::swap(v1, v2);
  for (int round = 0; round < kMostWedges; ++round) {
    const Portal<double> portal{v1, v2, difference.support(cross(v1, v2))};
    const Wedge<double> wedge = turned(v1, v2, portal.v3, dir);
    if (!wedge.turns) return is_portal(portal, dir, error) ? std::optional(portal) : std::nullopt;
    v1 = wedge.v1;
    v2 = wedge.v2;
  }
  return std::nullopt;
}

// Bounds as near to each other as asked for: true; or as near as the portals get, which are beyond doubt as long as the
// ray is not within rounding of an edge of them.
bool close_in_by_portals(CentredDifference& difference, const Vec3d& dir, double wanted, RadialBounds& bounds) {
  const RadialError error = difference.error();
  std::optional<Portal<double>> portal = portal_around(difference, dir, error);
  for (int round = 0; portal && round < kMostPortalsInside; ++round) {
    const Vec3d normal = normal_of(*portal);
    const Vec3d w = difference.support(normal);
    const RadialSection<double> found = section(*portal, normal, w, dir, error);
    if (!found.is_sound) break;
    bounds.lower = std::fmax(bounds.lower, found.lower * (1.0 - kRadialRounding));
    bounds.upper = std::fmin(bounds.upper, found.upper * (1.0 + kRadialRounding));
    if (found.upper - found.lower <= wanted * found.upper) return true;
    NarrowedPortal<double> next = narrowed(*portal, w, dir, error);
    // Where the ray passes w, as of every ball, another point there may be beside it.
    for (int attempt = 1; !next.is_sound && attempt <= kMostAttempts; ++attempt) {
      const Vec3d aside = 0.37 * (portal->v2 - portal->v1) + 0.61 * (portal->v3 - portal->v1);
      const Vec3d tilted = normal + (norm(normal) / (8.0 * attempt * norm(aside))) * aside;
      next = narrowed(*portal, difference.support(tilted), dir, error);
    }
    if (!next.is_sound) break;
    portal = next.portal;
  }
  return false;
}

// By proven verdicts. Where one is undecided, the bounds go on apart: from it to where the bodies meet beyond doubt,
// and to where they are apart.
class Bisection {
 public:
  Bisection(const ConvexBody& a, const ConvexBody& b, const BodyPoints& points, const Transformd& rotation,
            const Vec3d& dir)
      : a_(a), b_(b), points_(points), rotation_(rotation), dir_(dir) {
    rotation_.translation = {};
    inner_radius_ = (a.inradius() - norm(points.of_a - a.centre())) + (b.inradius() - norm(points.of_b - b.centre()));
  }

  void close_in(double wanted, RadialBounds& bounds) {
    // The bodies as placed are off by some u of their reach, in any direction. A part in a thousand of that is as near
    // as is worth while, where r is next to 0: else it is halved for ever.
    const double shift = 8.0 * kUnitRoundoff *
                         ((a_.reach() + 2.0 * b_.reach()) + norm(points_.of_a - rotation_(points_.of_b))) / norm(dir_);
    const auto is_wide = [&](double from, double to) {
      return to - from > std::fmax(wanted * bounds.upper, 0x1p-10 * shift);
    };
    std::optional<double> undecided;
    while (!undecided && is_wide(bounds.lower, bounds.upper)) {
      const std::optional<double> middle = between(bounds.lower, bounds.upper);
      if (!middle) break;
      switch (outcome_at(*middle)) {
        case Outcome::overlap: bounds.lower = *middle; break;
        case Outcome::disjoint: bounds.upper = *middle; break;
        case Outcome::undecided: undecided = middle; break;
      }
    }
    if (undecided) {
      double apart = *undecided, meeting = *undecided;
      for (std::optional<double> m; is_wide(bounds.lower, meeting) && (m = between(bounds.lower, meeting));) {
        (outcome_at(*m) == Outcome::overlap ? bounds.lower : meeting) = *m;
      }
      for (std::optional<double> m; is_wide(apart, bounds.upper) && (m = between(apart, bounds.upper));) {
        (outcome_at(*m) == Outcome::disjoint ? bounds.upper : apart) = *m;
      }
    }
    // Along the ray that is more where K's surface is nearly along it, by |x| / s at most about a point with a ball of
    // radius s in K.
    const double reach = bounds.upper * norm(dir_);
    const double rounding = inner_radius_ > 0.0 ? shift * std::fmax(1.0, reach / inner_radius_) : shift;
    bounds.lower = std::fmax(0.0, bounds.lower - rounding);
    bounds.upper += rounding;
    bounds.is_bisected = true;
  }

 private:
  static std::optional<double> between(double from, double to) {
    const double middle = from + 0.5 * (to - from);
    return middle > from && middle < to ? std::optional(middle) : std::nullopt;
  }
  Outcome outcome_at(double r) { return outcome_along(a_, b_, points_, rotation_, dir_, r); }

  const ConvexBody& a_;
  const ConvexBody& b_;
  BodyPoints points_;
  Transformd rotation_;
  Vec3d dir_;
  double inner_radius_;  // of a ball about the origin of K; below zero where none is known
};

}  // namespace

Outcome outcome_along(const ConvexBody& a, const ConvexBody& b, const BodyPoints& points, const Transformd& rotation,
                      const Vec3d& dir, double r) {
  Transformd pose = rotation;
  pose.translation = {};
  pose.translation = (points.of_a - pose(points.of_b)) + r * dir;
  return overlap(a, b, Pose::unchecked(pose)).outcome;
}

RadialBounds radial_function(const ConvexBody& a, const ConvexBody& b, const BodyPoints& points, const Pose& pose,
                             const Vec3d& dir, double relative_gap) {
  if (!(norm_1(dir) > 0.0 && is_finite(dir))) {
    throw InputError("a direction is zero or not finite - give a finite vector of any other length");
  }
  if (!is_finite(points.of_a) || !is_finite(points.of_b)) {
    throw InputError("a point of a body is not finite - give a point inside of it");
  }
  const Transformd& rotation = pose.a_from_b();
  // Powers of two in and out again: products of a direction of length 1 to 3.5 with normals, which are areas.
  const int exponent = std::ilogb(std::fmax(std::fabs(dir.x), std::fmax(std::fabs(dir.y), std::fabs(dir.z))));
  const Vec3d scaled_dir = times_power_of_two(dir, -exponent);
  const double wanted = std::fmax(relative_gap, kRadialRounding);
  // The bodies meet where the points coincide, and are apart where these are farther apart than the diameters.
  RadialBounds bounds;
  bounds.upper = 2.0 * (a.circumradius() + b.circumradius()) / norm(scaled_dir) * (1.0 + kRadialRounding);
  CentredDifference difference(a, b, points, rotation);
  const double reach = a.reach() + b.reach();
  const bool is_usual = reach > kLeastPacketReach && reach < kLargestPacketReach;
  if (!is_usual || !close_in_by_portals(difference, scaled_dir, wanted, bounds)) {
    Bisection(a, b, points, rotation, scaled_dir).close_in(wanted, bounds);
  }
  bounds.lower = scaled_down(bounds.lower, -exponent);
  bounds.upper = scaled_up(bounds.upper, -exponent);
  bounds.n_support_calls = difference.n_calls();
  return bounds;
}

}  // namespace vex
