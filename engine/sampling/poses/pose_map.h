// The inversion map: a point of the unit cube to a relative pose, without rejection.
//   coordinates 0, 1, 2   the position of B's centre in the sampling domain
//   coordinates 3 ...     B's orientation in A's frame, as many as the law uses (orientation_law.h)
#pragma once

#include <array>
#include <optional>
#include <span>

#include "engine/numeric/elementary.h"
#include "engine/numeric/transform.h"
#include "engine/sampling/domain.h"
#include "engine/sampling/points/trial_points.h"
#include "engine/sampling/poses/fitted_domain.h"
#include "engine/sampling/poses/orientation_law.h"

namespace vex {

inline constexpr int kPoseDimension = 3 + OrientationLaw::kMaxDimension;

/// A uniform point of the unit ball: the cosine of the polar angle and the cube of the radius are uniform.
template <class L>
Vec3<L> in_unit_ball(const L& u, const SinCos<L>& azimuth, const L& radius) {
  const L cos_polar = L(1.0) - (u + u);
  const L sin_polar = L(2.0) * square_root(u * (L(1.0) - u));
  const L across = radius * sin_polar;
  return {across * azimuth.cos, across * azimuth.sin, radius * cos_polar};
}
template <class L>
Vec3<L> uniform_in_unit_ball(const L& u, const L& v, const L& w) {
  return in_unit_ball(u, sincospi(v + v), cube_root(w));
}

/// Where B's centre may lie, in A's frame: a ball or a box.
template <class L>
Vec3<L> position_in_ball(const Domain& domain, const Vec3<L>& in_unit_ball) {
  return broadcast<L>(domain.middle) + L(domain.radius) * in_unit_ball;
}
template <class L>
Vec3<L> position_in_box(const Domain& domain, const L& u, const L& v, const L& w) {
  const Vec3<L> middle = broadcast<L>(domain.middle);
  return {middle.x + L(domain.half_extent.x) * ((u + u) - L(1.0)),
          middle.y + L(domain.half_extent.y) * ((v + v) - L(1.0)),
          middle.z + L(domain.half_extent.z) * ((w + w) - L(1.0))};
}
/// For a point of the unit cube.
template <class L>
Vec3<L> position_in(const Domain& domain, const L& u, const L& v, const L& w) {
  if (domain.kind == Domain::Kind::ball) return position_in_ball(domain, uniform_in_unit_ball(u, v, w));
  return position_in_box(domain, u, v, w);
}

/// The rotation, with the translation that puts B's centre there.
template <class L>
Transform<L> placed(Transform<L> rotation, const Vec3<L>& position, const Vec3d& centre_b) {
  const Vec3<L> turned_centre = rotation(broadcast<L>(centre_b));  // no translation yet
  rotation.translation = position - turned_centre;
  return rotation;
}

/// a_from_b for a point of the unit cube: B turned about its centre, which is then put into the ball or box.
template <class L>
Transform<L> pose_at(const std::array<L, kPoseDimension>& point, const OrientationLaw& law, const Domain& domain,
                     const Vec3d& centre_b) {
  return placed(law.rotation(std::span<const L>(point).subspan(3)), position_in(domain, point[0], point[1], point[2]),
                centre_b);
}

/// A trial: where B is put, and how large the set was that its position was drawn from.
struct PosedTrial {
  Transformd a_from_b;
  Vec3d position;  // of B's centre: as drawn, where it is drawn in A's frame, or as placed
  /// Volume of that set, in units of Domain::volume: 1 for a ball or a box, at most 1 for others but for rounding, if
  /// the bodies keep what they claim.
  double domain_share = 1.0;
};

/// The trials of one pair of bodies under (points, law, domain), each a function of its index. Holds references.
class PoseSampler {
 public:
  /// Of points of 3 + law.dimension() coordinates.
  PoseSampler(const ConvexBody& a, const ConvexBody& b, TrialPoints points, const OrientationLaw& law,
              const Domain& domain);
  /// Random ones.
  PoseSampler(const ConvexBody& a, const ConvexBody& b, std::uint64_t seed, const OrientationLaw& law,
              const Domain& domain)
      : PoseSampler(a, b, TrialPoints(seed, Sequence::random, 3 + law.dimension()), law, domain) {}

  PosedTrial operator()(std::uint64_t index) const;
  /// Null where the domain is none.
  const FittedDomain* fitted() const { return fitted_ ? &*fitted_ : nullptr; }

 private:
  TrialPoints points_;
  const OrientationLaw& law_;
  const Domain& domain_;
  Vec3d centre_b_;
  std::optional<FittedDomain> fitted_;  // where the domain is one
};

}  // namespace vex
