// The Minkowski difference A - B of two placed bodies, from their exact forms: what it is to the last bit, and its
// support points in twice the precision of a double.
//
// Shared by the search for a proof and the proof itself (general_referee.h). Independent of the engine: nothing of the
// bodies' support mappings is used.
#pragma once

#include <optional>
#include <vector>

#include "apps/referees/dyadic.h"
#include "engine/numeric/transform.h"
#include "engine/support/exact_form.h"

namespace vex::exact {

using Vec3dd = Vec3<DoubleDouble>;

/// A point of a body without its ball: vertex `index` of its points, or the point c + D x of its piece `index`.
struct CorePoint {
  bool is_vertex = true;
  std::size_t index = 0;
  Vec3dd x;  // |x| <= 1 but for the shrinking that `DifferenceBody::exactly` adds
};

/// A point of A - B: a - b + ball_part times the sum of the radii, |ball_part| <= 1.
struct DifferencePoint {
  CorePoint a, b;
  Vec3dd ball_part;
  Vec3dd approximately;  // scaled as DifferenceBody::scale says
};

class DifferenceBody {
 public:
  /// The forms must outlive it.
  DifferenceBody(const ExactForm& a, const ExactForm& b, const Transformd& a_from_b);

  /// Two bodies without curved parts; then the verdict is one of rational numbers.
  bool is_rounded_polytope() const { return a_.is_rounded_polytope() && b_.is_rounded_polytope(); }
  bool is_polytope() const { return a_.is_polytope() && b_.is_polytope(); }

  /// The farthest point in a direction, up to a few parts in 2^100.
  DifferencePoint support(const Vec3dd& dir) const;
  /// The same without the balls: of A's core less B's, each placed as it is under its ball.
  DifferencePoint support_of_cores(const Vec3dd& dir) const;

  /// A point that is in A - B beyond doubt, in the bodies' own units: curved parts are shrunk by 2^-96.
  DyadicPoint exactly(const DifferencePoint& point) const;

  /// Whether dir . w < 0 for every w of A - B: proven, square roots being taken from above.
  bool lies_behind(const Vec3dd& dir) const;

  /// The support function along a direction over the direction's length, in double: what is left of it is the gap.
  double support_value(const Vec3d& dir) const;

  const ExactForm& form_a() const { return a_; }
  /// B's vertices in A's frame: as placed, each rounded once, where B is a polytope, and exact otherwise.
  std::vector<DyadicPoint> placed_points() const;
  Dyadic ball_radius() const { return Dyadic(a_.ball_radius) + Dyadic(b_.ball_radius); }

  /// Points of the search are the true ones times this power of two, so that no product over- or underflows.
  double scale() const { return scale_; }

 private:
  CorePoint core_support(const ExactForm& form, const std::vector<Vec3d>& points, const Vec3dd& dir) const;
  Vec3dd approximate(const ExactForm& form, const std::vector<Vec3d>& points, const CorePoint& at) const;
  DyadicPoint exactly_of(const ExactForm& form, const CorePoint& at) const;
  DyadicPoint placed_exactly(const DyadicPoint& in_b) const;

  const ExactForm& a_;
  const ExactForm& b_;
  Transformd pose_;
  std::vector<Vec3d> rounded_b_;  // where B is a polytope: its placed vertices
  double scale_ = 1.0;
  std::vector<Vec3d> scaled_a_, scaled_b_;  // of B in A's frame where it is a polytope, in its own otherwise
};

}  // namespace vex::exact
