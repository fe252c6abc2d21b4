// Two bodies' exact forms, placed, as the checker of certificates sees them: supports bounded from above, and the
// points that witnesses mean. Shares nothing with the searches but whole numbers.
#pragma once

#include <optional>
#include <vector>

#include "engine/numeric/transform.h"
#include "engine/numeric/whole.h"
#include "engine/query/certificate.h"
#include "engine/support/convex_body.h"

namespace vex::checker {

/// Square roots and quotients are taken to so many bits.
inline constexpr int kBits = 256;

/// A bound from above of the root, within 2^-(kBits - 1) of it.
whole::Dyadic root_from_above(const whole::Dyadic& square);
/// numerator / denominator, off by at most 2^-kBits of itself; denominator > 0.
whole::Dyadic quotient(const whole::Dyadic& numerator, const whole::Dyadic& denominator);

/// x >= c |d|, or x > c |d|, where d . d = `dir_sq` > 0.
bool is_at_least(const whole::Dyadic& x, const whole::Dyadic& c, const whole::Dyadic& dir_sq);
bool is_more_than(const whole::Dyadic& x, const whole::Dyadic& c, const whole::Dyadic& dir_sq);

whole::DyadicVector exactly(const ExactVector& vector);

/// x -> R x + t, its coefficients off by no more than `error` as an operator; 0 where they are what is meant.
struct ExactPose {
  whole::DyadicVector row_x, row_y, row_z, translation;
  whole::Dyadic error{};

  whole::DyadicVector operator()(const whole::DyadicVector& point) const;
  whole::DyadicVector direction_to_b(const whole::DyadicVector& dir) const;
};
ExactPose exactly(const Transformd& pose);

class ExactPair {
 public:
  /// As `overlap` has them: of a polytope the vertices of B, rounded once as they are placed, are the body. None, and a
  /// reason, where there is nothing to be proven of such a pair.
  static std::optional<ExactPair> of(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                                     std::string& fault);
  /// B as it stands elsewhere, and no vertex rounded.
  ExactPair moved(ExactPose pose) const;

  const ExactForm& a() const { return a_; }
  const ExactForm& b() const { return b_; }
  bool are_rounded_polytopes() const { return a_.is_rounded_polytope() && b_.is_rounded_polytope(); }
  whole::Dyadic radii() const { return whole::Dyadic(a_.ball_radius) + whole::Dyadic(b_.ball_radius); }

  /// A lower bound of the gap of the bodies without their balls along a direction from A towards B, times the length of
  /// this; exact of rounded polytopes at rest.
  whole::Dyadic gap_of_cores(const whole::DyadicVector& dir) const;
  whole::Dyadic support_of_a(const whole::DyadicVector& dir) const;  // without the ball, from above
  whole::Dyadic support_of_b(const whole::DyadicVector& dir) const;  // as it stands; `dir` in A's frame

  /// Everything of A is behind everything of B along `dir`, both as they stand.
  bool is_separated_by(const whole::DyadicVector& dir) const;

  /// Points of the bodies without their balls, in A's frame; and of A - B.
  whole::DyadicVector point_of_a(const Witness& witness) const;
  whole::DyadicVector point_of_b(const Witness& witness) const;
  whole::DyadicVector core_point(const Witness& witness) const;

  /// More than any of these points is off by, for 2^-240 of all lengths that are rounded, and for the pose (E16). 0 of
  /// rounded polytopes at rest.
  whole::Dyadic margin() const;
  /// Of B's core, from the origin of its frame; and a bound of |axis x R x| over it, by a ball about `centre` where
  /// that is less.
  whole::Dyadic reach_of_b() const;
  whole::Dyadic reach_of_b_across(const whole::DyadicVector& axis, const whole::DyadicVector& centre) const;
  /// The same of A, which lies in its own frame.
  whole::Dyadic reach_of_a_across(const whole::DyadicVector& axis, const whole::DyadicVector& centre) const;
  /// No point of A is farther from `centre`.
  whole::Dyadic reach_of_a_from(const whole::DyadicVector& centre) const;

 private:
  ExactPair(ExactForm a, ExactForm b, ExactPose pose);

  whole::DyadicVector placed_vertex(std::size_t i) const;

  ExactForm a_, b_;
  ExactPose pose_;
  std::vector<whole::DyadicVector> points_a_;
  std::vector<whole::DyadicVector> placed_b_;  // where B's vertices are those of a polytope as placed
  std::vector<whole::DyadicVector> points_b_;  // in B's frame
};

}  // namespace vex::checker
