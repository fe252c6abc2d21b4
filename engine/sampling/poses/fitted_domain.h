// The sampling domain of hit-or-miss-fitted: for each relative orientation the smallest of a few parallelepipeds that
// hold every translation at which B can meet A.
#pragma once

#include <optional>
#include <vector>

#include "engine/numeric/transform.h"
#include "engine/query/packets/core_form.h"
#include "engine/sampling/domain.h"
#include "engine/sampling/poses/fitted_set.h"
#include "engine/support/convex_body.h"

namespace vex {

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

  /// No set is larger, whatever the rotation: proven (E27), and of rods near to what the largest one is, where the box
  /// that `fitted_domain` has for a volume is larger by as much as they are long.
  double largest_volume() const;

  const FittedPair& pair() const { return pair_; }

  /// Half the width along x, y and z of a box that no parallelepiped's volume exceeds.
  const Vec3d& largest_half_extent() const { return largest_half_extent_; }

 private:
  const ConvexBody& a_;
  const ConvexBody& b_;
  FittedPair pair_;
  Vec3d largest_half_extent_;
};

/// The heights of a body as kernels find them: bit for bit those of its own support mapping, which answers where no
/// kernel has it (ConvexBody::rounds_as_kernels). Holds a reference.
class KernelHeights {
 public:
  explicit KernelHeights(const ConvexBody& body);

  /// Null where `of_body` has to be asked.
  const CoreForm* core() const;
  double ball_radius() const { return body_->ball_radius(); }
  /// h(-n) has the bits of h(n).
  bool is_symmetric() const { return is_symmetric_; }

  void of_body(const ConvexBody::Columns& dirs, std::size_t n, double* along, double* against) const;

 private:
  void take_vertices(const std::vector<Vec3d>& vertices);

  const ConvexBody* body_;
  std::optional<CoreForm> form_;
  bool is_symmetric_ = false;
};

/// The domain of this kind; its volume is what no trial's exceeds.
Domain fitted_domain(const ConvexBody& a, const ConvexBody& b);

}  // namespace vex
