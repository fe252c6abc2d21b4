// When two polytopes, one of them moving straight, first meet: decided in whole numbers, always.
//
// B moved by t m meets A where t m is in K = A - B, a convex hull of finitely many points. The least t >= 0 is that of
// a linear programme of four rows, t m = sum of weight_i point_i and sum of weight_i = 1, whose columns are the points:
// solved by the simplex method, the columns found by support mappings, in exact arithmetic (E22).
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/numeric/vec3.h"
#include "engine/numeric/whole.h"
#include "engine/query/exact/placed_forms.h"

namespace vex {

struct FirstMeeting {
  bool is_hit = false;
  bool is_late = false;             // after the end that was given
  double lower = 0.0, upper = 0.0;  // of the least t, a few roundings apart; 0 only where it is 0
  int n_support_calls = 0;
};

/// What proves it: along `dir` the polytopes are apart until they meet, or for ever; and where they do, t m is in the
/// hull of at most three differences of these vertices of A and of B.
struct FirstMeetingProof {
  whole::Vector dir;
  std::vector<std::pair<std::size_t, std::size_t>> carriers;
};

/// Of polytopes, without balls: K is of A's points and of B's as they are placed. Everything is exact: flat bodies, and
/// motions along faces, edges, or past them by any little, are answered as they are.
FirstMeeting first_meeting(const PlacedForms& forms, const Vec3d& motion, FirstMeetingProof* proof = nullptr,
                           double until = HUGE_VAL);

}  // namespace vex
