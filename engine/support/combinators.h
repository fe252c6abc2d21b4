// Support mappings made of others: posed, inflated by a ball, Minkowski difference.
#pragma once

#include <optional>
#include <utility>

#include "engine/numeric/rounding.h"
#include "engine/numeric/transform.h"
#include "engine/support/checked_input.h"
#include "engine/support/convex_body.h"
#include "engine/support/revolved.h"
#include "engine/support/support_mapping.h"

namespace vex {

/// Body B as it stands in A's frame, each lane under its own pose. Holds a reference: B must outlive it.
template <class Body, class L>
class Posed {
 public:
  Posed(const Body& body, const Transform<L>& a_from_b) : body_(body), a_from_b_(a_from_b) {}

  Vec3<L> support(const Vec3<L>& dir) const { return a_from_b_(body_.support(a_from_b_.direction_to_b(dir))); }

 private:
  const Body& body_;
  const Transform<L>& a_from_b_;
};

/// A - B = {a - b}: it contains the origin exactly where A and B share a point. Holds references.
template <class A, class B>
class MinkowskiDifference {
 public:
  MinkowskiDifference(const A& a, const B& b) : a_(a), b_(b) {}

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return a_.support(dir) - b_.support(-dir);
  }

 private:
  const A& a_;
  const B& b_;
};

/// Body + ball of radius r about the origin: every point within r of the body.
template <SupportMapping Body>
class Inflated {
 public:
  Inflated(Body body, double radius)
      : body_(std::move(body)), radius_(checked_size_or_zero(radius, "the radius of the ball about a body's points")) {}

  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return body_.support(dir) + ball_support(L(radius_), dir);
  }

  /// Not of a body with a ball, whose radii kernels add up; nor of a polytope, of whose vertices that tie a kernel may
  /// take another: of different points the sums with the ball's round differently.
  bool rounds_as_kernels() const {
    if constexpr (MayRoundAsKernels<Body> && !HasBallPart<Body> && !HasDirectionTable<Body>) {
      return body_.rounds_as_kernels();
    } else {
      return false;
    }
  }

  /// The ball's point is off by at most 8 u r, and the sum's rounding by u of its size (E2).
  double support_error() const {
    const Vec3d c = body_.centre();
    return body_.support_error() + 8.0 * kUnitRoundoff * (radius_ + body_.circumradius() + norm_1(c));
  }
  Vec3d centre() const { return body_.centre(); }
  double circumradius() const { return (body_.circumradius() + radius_) * (1.0 + 2.0 * kUnitRoundoff); }
  double inradius() const { return (body_.inradius() + radius_) * (1.0 - 2.0 * kUnitRoundoff); }

  const Body& body() const { return body_; }
  double radius() const { return radius_; }

  template <class L>
  Vec3<L> core_support(const Vec3<L>& dir) const {
    if constexpr (HasBallPart<Body>) {
      return body_.core_support(dir);
    } else {
      return body_.support(dir);
    }
  }
  double core_support_error() const {
    if constexpr (HasBallPart<Body>) {
      return body_.core_support_error();
    } else {
      return body_.support_error();
    }
  }
  /// Of a body with a ball part of its own the radii add up, rounded to nearest.
  double ball_radius() const {
    if constexpr (HasBallPart<Body>) {
      return body_.ball_radius() + radius_;
    } else {
      return radius_;
    }
  }
  double rolling_radius() const requires HasRollingRadius<Body> { return body_.rolling_radius(); }
  std::optional<Generators> generators() const requires HasGenerators<Body> { return body_.generators(); }
  std::optional<PowerForm> power_form() const requires HasPowerForm<Body> { return body_.power_form(); }
  std::optional<ProfileForm> profile_form() const requires HasProfileForm<Body> { return body_.profile_form(); }
  std::optional<ExactForm> exact_form() const {
    std::optional<ExactForm> form;
    if constexpr (HasExactForm<Body>) form = body_.exact_form();
    if (form) form->ball_radius += radius_;
    return form;
  }
  /// The core's.
  std::optional<DirectionTable> direction_table() const requires HasDirectionTable<Body> {
    return body_.direction_table();
  }

 private:
  Body body_;
  double radius_;
};

}  // namespace vex
