// Is an answer about distance or depth right? Judged one by one, in some tens of microseconds, in twice the precision
// of a double and by other means than the engine's: the truth between bounds of 1e-18 of the bodies' size, then
// everything the answer claims.
#pragma once

#include <string>
#include <vector>

#include "engine/query/separation.h"
#include "engine/support/exact_form.h"

namespace vex {

/// Lengths are relative to `size`.
struct SeparationJudgement {
  double lower = 0.0, upper = 0.0;  // of the true signed distance, this one in the bodies' units
  double size = 0.0;                // R_A + R_B + |true signed distance|
  double error = 0.0;               // of the signed distance: what it is out of those bounds by
  double width = 0.0;               // of the answer's own bounds
  double points_off = 0.0;          // from their bodies, or from where the normal leads
  bool is_known = true;             // the truth is known to a tenth of what is asked
  bool bounds_hold = true;
  std::vector<std::string> faults;  // none: the answer is right

  bool is_right() const { return faults.empty(); }
};

/// Judges answers about one pair of bodies.
class SeparationJudge {
 public:
  /// Copies the bodies' exact forms; std::bad_optional_access where there is none.
  SeparationJudge(const ConvexBody& a, const ConvexBody& b);

  /// What is asked of answers at full precision, relative to the size: 1e-12 of polytopes, rounded or not, spheres and
  /// capsules among them, 1e-9 where a part is curved.
  double accuracy() const { return is_rounded_polytope_ ? 1e-12 : 1e-9; }

  /// Of an answer of `signed_distance`: value, points and normal to within `accuracy` of the size, bounds to nothing
  /// but the judge's own, about 1e-25. That is for bodies of ordinary shape: with a needle 1e9 times as long as the
  /// other body, or a hull 1e-17 thick, the judge's own search loses its digits, and exact_distance.h has the last
  /// word. An answer that was asked for less is given its relative gap. Where the truth is not known to the accuracy,
  /// which happens where ever so many ways out are the shortest, the answer's own bounds take its place; they must
  /// hold.
  SeparationJudgement judge(const Transformd& a_from_b, const Separation& answer) const {
    return judge(a_from_b, answer, accuracy());
  }
  SeparationJudgement judge(const Transformd& a_from_b, const Separation& answer, double accuracy) const;

 private:
  ExactForm a_, b_;
  double radii_;
  bool is_rounded_polytope_;
};

}  // namespace vex
