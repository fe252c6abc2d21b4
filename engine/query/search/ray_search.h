// Where a ray from outside first meets K = A - B: what `cast_ray` and `linear_cast` ask (docs/derivations.md, E22).
//
// Seen along the ray, K is its shadow, and the ray a point of it. Three points of K whose shadow has the point inside,
// a portal, prove that the ray is in K where it passes their plane; the support point of the plane's normal, against
// the ray, proves that it is not in K before the plane there. That point takes the place of one of the three, and the
// bounds close in: the portals of portal_refinement.h with their inner point infinitely far behind K. So K may be flat.
#pragma once

#include <array>
#include <optional>

#include "engine/numeric/transform.h"
#include "engine/query/cast_from_guess.h"
#include "engine/query/search/query_error.h"
#include "engine/support/convex_body.h"

namespace vex {

/// All coordinates of the pair are below 2^1000: farther from the origins sums of a few lengths are no longer finite,
/// and nothing is proven of casts.
bool are_within_range(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b);

/// A point of K, in A's frame, and the points of the cores that it comes from; all times the search's power of two. It
/// is the farthest one along `dir`, which no proof asks for. B's point in B's frame, not scaled.
struct DifferencePoint {
  Vec3d at, core_a, core_b, dir, own_b;
};

/// What is known of {t : t dir in K}.
struct RayBounds {
  double lower = 0.0, upper = HUGE_VAL;  // of its least t; where `upper` is finite there is a t of at most that
  bool is_hit = false;                   // there is a t from 0 on, proven: that one may be before the start
  bool is_miss = false;                  // there is none from 0 on, or until the end that was given, proven
  double latest = HUGE_VAL;              // no t is above it
};

/// One ray from the origin, of a direction whose largest coordinate is between 1 and 2, against K times a power of two.
class RaySearch {
 public:
  RaySearch(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, const Vec3d& dir);

  /// What is later counts as a miss; of t as it is searched for.
  void look_until(double latest) { until_ = latest; }
  /// Bounds that are no farther apart than this part of the lower one will do.
  void look_roughly(double relative_gap) { relative_gap_ = relative_gap; }

  /// Closes in as far as rounding allows. `separating_dir`: one that is known to separate the bodies, or zero.
  RayBounds run(const Vec3d& separating_dir, bool is_apart_at_start);

  /// The same from a guess, of bodies that are apart at the start: what is neither a miss nor a hit is to be searched
  /// for anew.
  RayBounds run_from(const CastGuess& guess);

  /// Where the bodies meet first: a unit normal, that of the plane that proved `lower`, or zero; and the points of A
  /// and of B that meet there, each where it is at the start of the motion.
  struct Touch {
    Vec3d normal, point_a, point_b, point_b_in_b;
  };
  Touch touch() const;

  /// Along it the bodies are apart until `lower`, or for ever where one support mapping has shown that; or zero.
  const Vec3d& separating_normal() const { return normal_; }

  /// K is multiplied by 2^exponent().
  int exponent() const { return exponent_; }
  int n_support_calls() const { return n_support_calls_; }

 private:
  /// Beside the ray, in the plane across it.
  struct Shadow {
    double x = 0.0, y = 0.0;
  };
  /// Points of K whose shadow holds that of a line, to rounding.
  using Corners = std::array<DifferencePoint, 3>;
  struct Line {
    Shadow at;     // of all its points
    Vec3d offset;  // the line is offset + t dir
    double upper = HUGE_VAL;
    double least = -HUGE_VAL;  // K has a point of the line at this t or a larger one
    bool is_settled = false;   // the upper bound is that of the last portal
  };

  DifferencePoint support(const Vec3d& dir);
  DifferencePoint cut(const Vec3d& normal);
  Shadow shadow(const DifferencePoint& point, const Line& line) const;
  double turn(const Shadow& p, const Shadow& q) const { return p.x * q.y - p.y * q.x; }
  bool turns_beyond_doubt(const Shadow& p, const Shadow& q) const;
  Line line_at(double x, double y) const;
  std::optional<Corners> corners_around(const Line& line);
  bool bound_crossing(Line& line, const Corners& corners, const Vec3d& normal) const;
  bool narrow(const Line& line, Corners& corners, const DifferencePoint& w) const;
  std::optional<Corners> shrunk(const Line& line, const Corners& corners, double ratio);
  std::optional<Corners> close_in(Line& line);
  void close_in(Line& line, Corners& corners, int round, double ratio);
  void look_behind(Line& line, const Corners& corners);
  double width_of_rounding() const;
  void keep(const Corners& corners) { contact_[n_portals_++] = corners; }
  std::optional<std::array<double, 3>> weights_by_shadow(double time) const;
  bool is_known_well(double upper) const {
    return bounds_.lower > 0.0 && upper - bounds_.lower < relative_gap_ * bounds_.lower;
  }

  const ConvexBody& a_;
  const ConvexBody& b_;
  Transformd a_from_b_;
  Vec3d dir_;
  int exponent_;
  double scale_;
  double until_ = HUGE_VAL, relative_gap_ = 0.0;
  QueryError<double> error_;
  double shadow_error_;
  Vec3d across_x_, across_y_, along_;
  RayBounds bounds_;
  Vec3d normal_;
  std::array<std::optional<Corners>, 3> contact_;  // the last portal, or those of three lines around the ray
  std::size_t n_portals_ = 0;
  int n_support_calls_ = 0;
};

}  // namespace vex
