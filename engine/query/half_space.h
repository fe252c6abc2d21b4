// A half-space: everything on one side of a plane, such as a floor. It is a body without bounds, which no ConvexBody
// can be (a support mapping has no point to give along the normal), so it has queries of its own. They are closed
// forms: along the plane's normal a body reaches as far as its support point does.
#pragma once

#include <cmath>

#include "engine/numeric/pose.h"
#include "engine/query/first_contact.h"
#include "engine/query/separation.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

/// The points x with dir_normal . x <= offset, the doubles being taken as exact reals: the plane need not be one that a
/// unit vector of doubles tells.
class HalfSpace {
 public:
  /// `dir_normal` points out of the half-space, and has any length but 0. Throws InputError where it is 0 or a number
  /// is not finite, or where the offset, scaled as the normal is to a length near 1, is out of a double's range.
  HalfSpace(const Vec3d& dir_normal, double offset);
  /// The plane through a point: the offset is their product, rounded, and that plane is what is meant from then on.
  static HalfSpace through(const Vec3d& point, const Vec3d& dir_normal);

  /// Scaled by a power of two, so that the largest coordinate of the normal is from 1 to 2.
  const Vec3d& dir_normal() const { return dir_normal_; }
  double offset() const { return offset_; }
  /// The length of `dir_normal()`, and the normal of length 1; both to within 4 u.
  double length() const { return length_; }
  const Vec3d& unit_normal() const { return unit_normal_; }

 private:
  Vec3d dir_normal_;
  double offset_;
  double length_ = 1.0;
  Vec3d unit_normal_;
};

// A is the half-space and B the body; the pose is B's in the frame of the half-space, which usually is the world.
// Normals are the half-space's, point_a is on its plane, opposite point_b. Everything else is as of two bodies, and
// what B is as well: of a polytope without a ball its placed, rounded vertices (docs/derivations.md, E29).

/// Proven. A body with an exact form, of whatever parts, is always decided: the question is one of rational numbers.
/// Undecided are bodies without one, within rounding of contact, and bodies of which a placed coordinate is not finite.
Verdict overlap(const HalfSpace& a, const ConvexBody& b, const Pose& a_from_b);

/// Distance or depth, as the case is: one support point. The depth is how far B goes into the half-space, the shortest
/// way out of it. Bounds are as near as some 40 roundings of what is along the normal: the body's reach, the offset,
/// and |n| . |t|, coordinate by coordinate; so far from the origin across the normal nothing is lost. `is_rough` where
/// they are wider than 1e-12 of |signed distance| + R_B, of curved bodies 1e-9.
Separation signed_distance(const HalfSpace& a, const ConvexBody& b, const Pose& a_from_b);

namespace detail {
/// Whether the bounds of B and a half-space are wider than an answer that is not rough may have.
bool are_wide_beside(const ConvexBody& b, const Separation& found);
}  // namespace detail

/// B moving without turning. Bodies with an exact form are undecided only where a time or a coordinate is larger than
/// any double. Times are as near as the height at the start and the speed along the normal are known. Throws
/// InputError for a motion that is zero or not finite, UsageError for an end that is negative or no number.
FirstContact linear_cast(const HalfSpace& a, const ConvexBody& b, const Pose& a_from_b, const Vec3d& motion,
                         double until = HUGE_VAL);

/// B moving and turning about its origin, as `time_of_impact` of two bodies has it: `time` is `lower`, at which the
/// points are measured, and a B that leaves or grazes the plane within rounding may be undecided, as may one that turns
/// hundreds of times while it falls by its size. Heights that rise, or stay but for B's turning, are looked at until
/// nothing can come.
FirstContact time_of_impact(const HalfSpace& a, const ConvexBody& b, const Pose& a_from_b, const RigidMotion& motion,
                            double until = HUGE_VAL);

/// The ray origin + t dir.
FirstContact cast_ray(const HalfSpace& a, const Vec3d& origin, const Vec3d& dir, double until = HUGE_VAL);

}  // namespace vex
