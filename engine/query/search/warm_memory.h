// What a WarmStart (separation.h) knows of a pair, put to use: directions are asked of the bodies again, as they are
// now.
//
// Of bodies that are apart it is the directions that gave the corners of the nearest simplex: a descent that begins
// with their points is at its end at once, if little has moved. Of bodies that overlap it is the hull in which an
// expanding polytope ended: its directions give points of the bodies as they are now, and where its triangles, of
// these, go around the origin still, the polytope goes on from there. Around a smooth minimum of the height the hull is
// as fine as the bounds are near, and has to be moved along with it: the new minimum is found first, by a secant
// method from the last one's second derivative, and the directions, which are about it, turn as it did.
//
// A memory shall cost no more than it saves. What a search from nothing takes is known of the last ones, and a memory
// that takes more twice in turn is given up, and made again after 4, 8 ... 128 searches from nothing; where these are
// short none is made.
#pragma once

#include <optional>

#include "engine/query/search/core_difference.h"
#include "engine/query/search/core_search.h"
#include "engine/query/search/direction_code.h"
#include "engine/query/search/low_place.h"
#include "engine/query/separation.h"

namespace vex {

/// Holds references.
class WarmMemory {
 public:
  using Point = CoreDifference::Point;
  using Polytope = ExpandingPolytope<double, Point, CoreDifference>;
  using Found = CoreSeparation<double, Point>;
  struct CornersOfBoth {
    const CornerTable& a;
    const CornerTable& b;
  };

  WarmMemory(WarmStart& state, const CoreDifference& difference, const QueryError<double>& error);

  /// A unit vector that parts the bodies, or nearly so, or zero: of bodies that overlap the way out of each other is no
  /// good beginning.
  Vec3d parting_dir() const { return holds_hull_ && !is_parted_ ? Vec3d{} : normal_; }
  bool holds_hull() const { return holds_hull_; }
  /// Points of the difference near its nearest one, as the bodies are now; empty where none is known.
  NearestSimplex<double, Point> simplex(const CoreSearchSettings<double>& settings, bool is_smooth);
  /// The cores' depth, by the hull that is known: false where that does not lead to bounds as near as asked for.
  /// `is_smooth`: the bodies are not polytopes, and so may be where they are in each other.
  bool find_depth(const CoreSearchSettings<double>& settings, bool is_smooth, Found& found);
  int n_support_calls() const { return n_support_calls_; }

  void forget();
  /// Of bodies that are apart, after a descent of so many support calls, with or without what was known.
  void remember_nearest(const Found& found, const CoreSearchSettings<double>& settings, bool is_smooth, int n_calls);
  /// Of a polytope that began with nothing, and has ended with near bounds after so many support calls in all.
  void remember_hull(const Polytope& polytope, bool is_smooth, double size, int n_calls);

 private:
  // Of corners by their numbers, or along a direction; none of numbers that the bodies do not have.
  std::optional<Point> point_of(std::uint32_t code, const DirectionCode& frame);
  bool are_corners(std::uint32_t code) const;
  Point corner_of(std::uint32_t code) const;
  std::optional<std::uint32_t> code_of(const Point& point, const DirectionCode& frame) const;
  // Corners by their numbers need none.
  DirectionCode frame_of(const Vec3d& middle, const Vec3d& x, const Vec3d& y) const;
  template <class Visit>
  bool visit_foot(const Polytope& polytope, const Vec3d& normal, const Visit& visit) const;
  LowPlace find_lowest(LowPlaceSearch& search) const;
  void keep_nearest(const Found& found, const CoreSearchSettings<double>& settings, bool is_smooth);
  bool keep_place(const LowPlace& place);
  void keep_normal(const Vec3d& unit_normal);
  // Triangles and their corners, about the normal as it is kept. `has_kept`: the first points are those that are known.
  void keep_hull(const Polytope& polytope, bool has_kept);
  void keep_grown_hull(const Polytope& polytope);

  // Whether none is to be made, for it has failed in turn, and this is not one of the searches after which it is: the
  // `first` one since, and each that is a power of two.
  bool rests(int first);
  // Whether it has failed in turn so often that it is given up.
  bool fails(bool is_of_use);
  // Of bodies that are apart, who have no triangles, the first one's bytes are the account: how many quarters of a
  // support call a search from nothing takes, a mean of the last few, and how often what it has left was of use since.
  std::uint8_t& quarters_from_nothing() { return state_.faces_[0][0]; }
  std::uint8_t& n_used() { return state_.faces_[0][1]; }

  WarmStart& state_;
  const CoreDifference& difference_;
  const QueryError<double>& error_;
  Vec3d normal_;
  std::optional<CornersOfBoth> corners_;  // of bodies whose corners have numbers
  bool holds_hull_, is_parted_ = false, has_begun_apart_ = false;
  std::optional<LowPlace> nearest_;  // of smooth bodies that are apart
  int n_support_calls_ = 0;
  int place_cost_ = 0;  // of finding the place again
};

}  // namespace vex
