// How far apart two bodies are, or how deep in each other, from a search in their cores' difference (core_search.h): in
// double precision or in twice that. Which is asked, and what the sign is where bounds leave it open: separation.cpp.
#pragma once

#include <algorithm>

#include "engine/query/exact/placed_forms.h"
#include "engine/query/search/core_search.h"
#include "engine/query/separation_from_guess.h"

namespace vex {

/// What is asked of a pair. Nothing is copied: all of it is the caller's.
struct SeparationQuery {
  const ConvexBody& a;
  const ConvexBody& b;
  const Transformd& a_from_b;
  SeparationGoal goal;
  const SeparationSettings& settings;
  const NearestGuess* guess = nullptr;
  bool asks_sign = true;

  double circumradii() const { return a.circumradius() + b.circumradius(); }
  bool are_rounded_polytopes() const { return a.is_rounded_polytope() && b.is_rounded_polytope(); }
  /// What is promised of bounds where nothing else is asked for, of |signed distance| + R_A + R_B.
  double usual_gap() const { return are_rounded_polytopes() ? 1e-12 : 1e-9; }
  /// How near bounds are brought, of |signed distance| + R_A + R_B: as near as is asked for, but no nearer than this.
  double relative_gap(double of_polytopes, double of_curved) const {
    return std::max(settings.relative_gap, are_rounded_polytopes() ? of_polytopes : of_curved);
  }
  /// How near a search in double precision brings bounds, rounding apart. Polytopes end by themselves; what is left of
  /// curved bodies halves with every other support call.
  static constexpr double kCurvedGap = 0x1p-32;
  double searched_gap() const { return relative_gap(0x1p-44, kCurvedGap); }
  /// The gap with which an answer in double precision will do.
  double settled_gap() const { return relative_gap(0x1p-40, 0x1p-31); }
  /// Hulls of polytopes come to an end by themselves, if it takes all of their vertices.
  int max_hull_points() const {
    constexpr int kMost = 1 << 14;
    const bool ends = are_rounded_polytopes() && settings.max_support_calls == kMaxSupportCalls;
    return ends ? kMost : settings.max_support_calls;
  }
};

/// What is known of a search beside the separation that it found.
struct SearchedSeparation {
  bool is_out_of_range = false;  // nothing was searched: the pair is too large or too small for double precision
  bool is_capped = false;        // more support calls would bring the bounds nearer
  double signed_distance = 0.0;  // as it was found
  double missing = 0.0;          // of that, in what the normal alone shows,
  bool tells_missing = false;    // where this is true
  /// What rounding alone leaves between bounds is more than was asked for, as of bodies far from the origins of their
  /// frames: the search shows a direction to begin with, and no more.
  bool is_coarse = false;
};

/// Whether the distance of this pair is known without a search: of zonotopes of few vectors.
bool is_known_without_search(const ConvexBody& a, const ConvexBody& b);
/// Into `found`, which is new, all but the verdict.
SearchedSeparation search_in_double(const SeparationQuery& query, WarmStart* warm_start, Separation& found);

/// In twice the precision, along a unit vector first.
Separation search_in_extended(const SeparationQuery& query, const PlacedForms& placed, const Vec3d& first_dir);

}  // namespace vex
