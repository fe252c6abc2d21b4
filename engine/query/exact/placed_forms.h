// Two bodies' exact forms, placed: what the stages behind the filter work on.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/numeric/transform.h"
#include "engine/support/convex_body.h"

namespace vex {

/// Finitely many points, of which those are wanted that are farthest in some direction. Kept as doubles, less the first
/// point and times a power of two: so however small and however far from the origin the set is, doubles tell its points
/// apart.
class VertexSet {
 public:
  /// `offsets`: from one of the points; coordinates up to 1.8, each within 16 u of what is meant.
  explicit VertexSet(const std::vector<Vec3d>& offsets);

  /// Every index that may be the farthest one in a direction that is within 2^-52 of each coordinate of `dir`, whose
  /// largest coordinate is between 1/4 and 2: computed values within 2^-45 of the largest (E15).
  const std::vector<std::size_t>& farthest(const Vec3d& dir) const;

 private:
  std::vector<double> x_, y_, z_;  // of the offsets
  mutable std::vector<std::size_t> found_;
  mutable std::vector<double> values_, most_of_block_;
};

/// A's and B's exact forms with B's pose. One instance serves one query.
struct PlacedForms {
  ExactForm a, b;
  Transformd a_from_b;
  /// B's points in A's frame.
  std::vector<Vec3d> placed_b;
  VertexSet points_a{{}}, points_b{{}};  // those of B placed
  /// The rounded points above are the body: of a polytope, unless it or A turns as they move (E25).
  bool is_b_rounded;

  bool are_rounded_polytopes() const { return a.is_rounded_polytope() && b.is_rounded_polytope(); }
};

/// None where a body has no exact form, or a placed coordinate is not finite. `turns`: no point of B is rounded, for
/// the pose is where a motion begins in which a body turns.
std::optional<PlacedForms> placed_forms(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                        bool turns = false);

}  // namespace vex
