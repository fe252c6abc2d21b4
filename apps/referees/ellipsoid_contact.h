// Do two ellipsoids share a point? By their contact function.
//
// F = max over 0 <= l <= 1 of l (1 - l) r^T [(1 - l) A + l B]^-1 r, with the ellipsoids' matrices A and B (squares of
// the semi-axes, turned) and the vector r between the centres, is at most 1 where they do (J. W. Perram, M. S.
// Wertheim, J. Comput. Phys. 58, 409 (1985); J. Vieillard-Baron, J. Chem. Phys. 56, 4729 (1972)). It is concave in l,
// and its maximum is where the two ellipsoids, grown by the same factor, touch.
#pragma once

#include "engine/numeric/transform.h"
#include "engine/query/verdict.h"

namespace vex {

class EllipsoidContact {
 public:
  /// Semi-axes along each body's x, y, z.
  EllipsoidContact(const Vec3d& axes_a, const Vec3d& axes_b);

  /// Ends as soon as one l proves F > 1, or the tangents on both sides of the maximum prove F <= 1 (E11). Undecided
  /// within rounding of contact, or where the search was given up.
  Verdict operator()(const Transformd& a_from_b) const;

 private:
  Vec3d axes_a_, axes_b_;
  double inradius_a_, inradius_b_, reach_;
  double cross_factor_a_, cross_factor_b_;
  double least_ratio_, largest_ratio_;
};

}  // namespace vex
