// Do two bodies of any kind share a point? Found in twice the precision of a double, proven in exact arithmetic.
//
// Disjoint is proven by a direction along which the exact difference of the bodies lies behind the origin, overlap by
// four points of that difference, none of them rounded, whose tetrahedron holds the origin. The search for them is
// Gilbert, Johnson and Keerthi's descent in its textbook form (1988), by nearest points of simplices; it uses nothing
// of the engine's queries, and what it finds counts only once it is proven.
#pragma once

#include <optional>

#include "engine/numeric/transform.h"
#include "engine/query/verdict.h"
#include "engine/support/convex_body.h"

namespace vex {

namespace exact {
class DifferenceBody;
}

/// Judges poses of one pair of bodies.
class GeneralReferee {
 public:
  /// Holds copies of the bodies' exact forms. The bodies must outlive it.
  GeneralReferee(const ConvexBody& a, const ConvexBody& b);

  /// Disjoint or overlap, which touching is; `undecided` where neither could be proven. That happens only where bodies
  /// with curved parts touch to within some 1e-25 of their size, where a body has no exact form, and where the search
  /// fails. `hint`: a direction that may separate A from B, or zero.
  Outcome judge(const Transformd& a_from_b, const Vec3d& hint) const;

  /// How far the bodies are from contact: of disjoint ones the largest gap found along a direction, which the distance
  /// is not below; of others the least overlap along one, which the depth is not above. Looked for along the hint, the
  /// axes of both bodies, and what a search ends with; in double, to a few parts in 1e16 of the pair's reach.
  double gap_bound(const Transformd& a_from_b, const Vec3d& hint) const;

  /// Two polytopes, rounded or not.
  bool is_rational() const;

 private:
  std::optional<Outcome> by_rational_numbers(const exact::DifferenceBody& difference, const Transformd& pose) const;

  const ConvexBody& body_a_;
  const ConvexBody& body_b_;
  std::optional<ExactForm> a_, b_;
  bool has_exact_outcome_;
};

}  // namespace vex
