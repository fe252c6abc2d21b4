// The sampling domain of hit-or-miss-fitted: for each relative orientation the smallest of a few parallelepipeds that
// hold every translation at which B can meet A.
#pragma once

#include <array>
#include <vector>

#include "engine/numeric/transform.h"
#include "engine/sampling/domain.h"
#include "engine/support/convex_body.h"

namespace vex {

/// The translations t with lower_i <= n_i . t <= lower_i + width_i for three normals n_i.
struct Parallelepiped {
  std::array<Vec3d, 3> dual;  // n_i . dual_j = 1 for i = j, otherwise 0
  std::array<double, 3> lower{}, width{};
  double volume = 0.0;  // length^3

  /// For a point of the unit cube.
  Vec3d position(double u, double v, double w) const {
    return ((lower[0] + u * width[0]) * dual[0] + (lower[1] + v * width[1]) * dual[1]) +
           (lower[2] + w * width[2]) * dual[2];
  }
};

/// Made for one pair of bodies, asked for many orientations. Holds references.
///
/// B at R x + t meets A only if, for every n, -(h_A(-n) + h_RB(n)) <= n . t <= h_A(n) + h_RB(-n), h being the support
/// functions; three normals make a parallelepiped. With u_A and u_B the axes in which the bodies are unlike the others
/// (the long axis of a rod, the short one of a plate, either of a strip) and c = u_A x u_B there are tried
///   A's axes;  B's axes;  (u_A, u_B, c);  (c x u_A, c x u_B, c).
/// A body's axes are those of its frame. The third fits two plates, which along a plate's normal are no farther apart
/// than the other plate reaches; the last fits two rods, which meet only where the parallelogram of their axes is: its
/// volume tends to the excluded volume of thin rods, where every other choice has a part that tends to nothing.
class FittedDomain {
 public:
  FittedDomain(const ConvexBody& a, const ConvexBody& b);

  /// For B turned by R, a rotation to within kDrawnRotationError; the translation is not looked at.
  Parallelepiped at(const Transformd& rotation) const;

  /// Half the width along x, y and z of a box that no parallelepiped's volume exceeds.
  const Vec3d& largest_half_extent() const { return largest_half_extent_; }

 private:
  struct Interval {
    double lower, upper;
  };
  using Intervals = std::array<Interval, 3>;

  Interval along(const Vec3d& normal, const Transformd& rotation) const;

  const ConvexBody& a_;
  const ConvexBody& b_;
  double margin_;            // what rounding, and R not being quite a rotation, can change of n . t, |n| = 1 (E13)
  Intervals own_a_, own_b_;  // of each body along its own axes
  std::vector<std::size_t> axes_a_, axes_b_;
  Vec3d largest_half_extent_;
};

/// The domain of this kind; its volume is what no trial's exceeds.
Domain fitted_domain(const ConvexBody& a, const ConvexBody& b);

}  // namespace vex
