// How far apart are two convex bodies, or how deep in each other: distance and penetration depth with bounds on both
// sides, witness points and the direction between them.
//
// Both are one number, the signed distance: the distance where the bodies are apart; where they meet, minus the depth,
// the length of the shortest translation of B that leaves them touching. With K = A - B and its support function h,
// that is the largest of -h(n) over all unit vectors n, so every n gives a bound from below; points of K give one from
// above (docs/derivations.md, E20, E21).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "engine/numeric/pose.h"
#include "engine/query/overlap.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

/// What is known of a signed distance. Points are in A's frame.
struct Separation {
  /// Of the question whether the bodies share a point, proven or said to be undecided: as `overlap` answers it, which
  /// of a body without exact form may know less.
  Verdict verdict;
  /// The true value is between `lower` and `upper`, rounding included; so is `signed_distance`.
  double signed_distance = 0.0, lower = -HUGE_VAL, upper = HUGE_VAL;
  /// Whether upper - lower is more than was asked for (`relative_gap`; where that is 0, 1e-12 of |signed distance| +
  /// R_A + R_B for polytopes and 1e-9 for curved bodies): a search was given up, `max_distance` ended it, or rounding
  /// left no more; or, of a search with few `max_support_calls` or digits (`relative_gap`), or of bodies without exact
  /// forms, the normal shows less than the value, or the points are not opposite each other along it, by more than that
  /// part and more than the bounds are apart (`promised_accuracy`). Value and points are then as rough as the bounds,
  /// or as `relative_gap`, and the normal may show less than `lower`.
  bool is_rough = false;
  /// False where a query has nothing to tell but the verdict: `distance` of bodies that overlap, `penetration_depth` of
  /// bodies that do not. Normal and points are zero then, and of the bounds one is infinite.
  bool has_witnesses = false;
  /// A unit vector from A towards B: along it the bodies are `signed_distance` apart. Moving B by -signed_distance *
  /// normal brings them into contact.
  Vec3d normal;
  /// Points of A and of B with point_b - point_a = signed_distance * normal, all as well as the bounds were asked to be
  /// near: to 1e-12 of |signed distance| + R_A + R_B for polytopes, to 1e-9 for curved bodies, or to `relative_gap`; no
  /// nearer than the bounds are, nor than 16 roundings of coordinates in A's frame (`promised_accuracy`).
  Vec3d point_a, point_b;
  /// The same point of B in B's frame, where it is known as well however far B is from A: no farther out of B than
  /// 1e-12 of B's circumradius and 16 roundings of coordinates in B's frame, as point_a is of A.
  Vec3d point_b_in_b;
  int n_support_calls = 0;
};

/// What was found of a pair, for the next query of the same pair in a pose not far from this one: directions alone, of
/// which the bodies are asked again. Nothing of it is believed: of another pair, of long ago, copied, stored or
/// overwritten, it costs time and changes the last digits, and never what is proven. Empty at first.
class WarmStart {
  friend class WarmMemory;

  static constexpr int kMostPoints = 63, kMostFaces = 2 * kMostPoints - 4;

  Vec3d normal_;       // unit, in A's frame, from A towards B; zero where nothing is known
  Vec3d normal_in_b_;  // the same in B's
  Vec3d x_, y_;        // across it, in A's frame; and how it turns along these (low_place.h)
  float turn_x_ = 0.0f, turn_y_ = 0.0f;
  std::uint8_t n_points_ = 0;           // of the nearest simplex, or of a hull that holds the origin
  std::uint8_t n_faces_ = 0;            // of that hull
  std::uint8_t n_points_at_first_ = 0;  // when the hull was last made from nothing
  std::uint8_t n_failed_ = 0;           // how often in turn a hull was of no use, and how often none was kept since
  std::uint8_t are_corners_ = 0;        // whether points are corners, each by its number, and no directions
  std::array<std::uint32_t, kMostPoints> dirs_{};  // direction_code.h, about the normal
  std::array<std::array<std::uint8_t, 3>, kMostFaces> faces_{};
};
static_assert(std::is_trivially_copyable_v<WarmStart>);

struct SeparationSettings {
  /// The search ends once upper - lower is below this times |signed distance| + R_A + R_B, the circumradii. 0: as near
  /// as double precision gets for polytopes, rounded or not, and 2^-32 for curved bodies. A simulation may ask for
  /// less, 1e-3 or even 0.1: the bounds tell what it got, and the verdict is proven all the same.
  double relative_gap = 0.0;
  int max_support_calls = kMaxSupportCalls;  // of each search
  /// `distance` ends once it is known to be larger: `lower` is then above it, and value, normal and points are no more
  /// than how near the search had come.
  double max_distance = HUGE_VAL;
};

/// Distance or depth, as the case is. For bodies of points and balls (polytopes, spheres, capsules, rounded polytopes)
/// the answer is that of the nearest features, and upper - lower within 1e-12 of |signed distance| + R_A + R_B; for
/// curved bodies within 1e-9 of that, unless ever so many directions are the shortest way out (as for two discs with
/// one axis): then the bounds tell. Never a guess: where rounding would decide the sign, the verdict comes from
/// `overlap`, and bounds from twice the precision.
///
/// Of polytopes without a ball B is what its vertices are once each is placed and rounded to double, as `overlap` has
/// it: at coordinates of 1e16 that may be a body of another shape. Others are R x + t without rounding.
///
/// R of the pose must be a rotation to within 1e-6. Coordinates between 1e-40 and 1e40, or 0, are answered at full
/// speed, others by twice the precision.
Separation signed_distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                           const SeparationSettings& settings = {}, WarmStart* warm_start = nullptr);

/// The same of bodies that are apart. Of bodies that overlap no depth is looked for: signed_distance and upper are 0,
/// lower is -infinity.
Separation distance(const ConvexBody& a, const ConvexBody& b, const Pose& pose, const SeparationSettings& settings = {},
                    WarmStart* warm_start = nullptr);

/// The same of bodies that overlap; signed_distance is minus the depth. Of bodies that are apart no distance is looked
/// for: signed_distance and lower are 0, upper is infinity.
Separation penetration_depth(const ConvexBody& a, const ConvexBody& b, const Pose& pose,
                             const SeparationSettings& settings = {}, WarmStart* warm_start = nullptr);

/// The body with a ball of this radius, 0 or more, about each of its points: a margin. `overlap` of it and another body
/// asks whether their gap is at most the radius, and computes no distance. A margin that is used often is made once.
/// Of a body with a ball of its own the sum of both radii is rounded to nearest, and the margin is of that body: put it
/// on the other one if that has none.
ConvexBody with_margin(const ConvexBody& body, double margin);

}  // namespace vex
