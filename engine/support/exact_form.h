// What a body is, exactly: the nominal set that a verdict is about, for arithmetic of more digits than a double has.
#pragma once

#include <vector>

#include "engine/numeric/vec3.h"

namespace vex {

/// The convex hull of `points` and `pieces`, with a ball of `ball_radius` about each of its points. The doubles are
/// taken as they are. Most bodies that ship with vex have this form; a lens, a superball and some others,
/// and a user's own body, have none, and then end undecided where double precision proves nothing.
struct ExactForm {
  /// {c + D x : |x| <= 1}, D = diag(semi_axes): an ellipsoid, flat where a semi-axis is 0. Of a dome only the half with
  /// x_z >= 0. Its support function is c . d + |D d|; of a dome, D_z d_z counts as 0 where it is negative.
  struct Piece {
    Vec3d centre;
    Vec3d semi_axes;
    bool is_dome = false;
  };

  std::vector<Vec3d> points;
  std::vector<Piece> pieces;
  double ball_radius = 0.0;

  /// The convex hull of points: placed as B, each of them is rounded once (docs/derivations.md, "What the input is").
  bool is_polytope() const { return pieces.empty() && ball_radius == 0.0; }
  /// Points and a ball: sphere, capsule, rounded polytope. Whether two of these meet is a question of rational numbers.
  bool is_rounded_polytope() const { return pieces.empty(); }
};

}  // namespace vex
