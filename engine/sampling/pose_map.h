// The inversion map: a point of the unit cube to a relative pose, without rejection.
//
// Without rejection every trial uses the same coordinates for the same purpose, so random and quasi-random points share
// the map. No C library function and no fused operation: the pose is the same bits everywhere (elementary.h).
//   coordinates 0, 1, 2   the position of B's centre in the sampling domain
//   coordinates 3, 4, 5   B's orientation in A's frame
#pragma once

#include <array>
#include <string_view>

#include "engine/numeric/elementary.h"
#include "engine/numeric/transform.h"
#include "engine/sampling/domain.h"

namespace vex {

inline constexpr int kPoseDimension = 6;

/// The matrices drawn below are rotations to within this (E6).
inline constexpr double kDrawnRotationError = 0x1p-46;

/// How the relative orientation R of B in A's frame is distributed.
enum class OrientationLaw {
  isotropic,  // uniform over all rotations
  aligned,    // R = I
};

constexpr std::string_view name_of(OrientationLaw law) {
  return law == OrientationLaw::isotropic ? "isotropic" : "aligned";
}

/// The rows of a uniformly distributed rotation (K. Shoemake, "Uniform random rotations", Graphics Gems III, 1992).
template <class L>
Transform<L> uniform_rotation(const L& u, const L& v, const L& w) {
  const SinCos<L> first = sincospi(v + v);
  const SinCos<L> second = sincospi(w + w);
  const L short_leg = square_root(L(1.0) - u);
  const L long_leg = square_root(u);
  const L qx = short_leg * first.sin, qy = short_leg * first.cos;
  const L qz = long_leg * second.sin, qw = long_leg * second.cos;
  const L one = L(1.0), two = L(2.0);
  return {{one - two * (qy * qy + qz * qz), two * (qx * qy - qw * qz), two * (qx * qz + qw * qy)},
          {two * (qx * qy + qw * qz), one - two * (qx * qx + qz * qz), two * (qy * qz - qw * qx)},
          {two * (qx * qz - qw * qy), two * (qy * qz + qw * qx), one - two * (qx * qx + qy * qy)},
          {}};
}

/// A uniform point of the unit ball: the cosine of the polar angle and the cube of the radius are uniform.
template <class L>
Vec3<L> uniform_in_unit_ball(const L& u, const L& v, const L& w) {
  const L radius = cube_root(w);
  const L cos_polar = L(1.0) - (u + u);
  const L sin_polar = L(2.0) * square_root(u * (L(1.0) - u));
  const SinCos<L> azimuth = sincospi(v + v);
  const L across = radius * sin_polar;
  return {across * azimuth.cos, across * azimuth.sin, radius * cos_polar};
}

/// Where B's centre may lie, in A's frame, for a point of the unit cube.
template <class L>
Vec3<L> position_in(const Domain& domain, const L& u, const L& v, const L& w) {
  const Vec3<L> middle = broadcast<L>(domain.middle);
  if (domain.kind == Domain::Kind::ball) return middle + L(domain.radius) * uniform_in_unit_ball(u, v, w);
  return {middle.x + L(domain.half_extent.x) * ((u + u) - L(1.0)),
          middle.y + L(domain.half_extent.y) * ((v + v) - L(1.0)),
          middle.z + L(domain.half_extent.z) * ((w + w) - L(1.0))};
}

/// a_from_b for a point of the unit cube: B turned about its centre, which is then put into the domain.
template <class L>
Transform<L> pose_at(const std::array<L, kPoseDimension>& point, OrientationLaw law, const Domain& domain,
                     const Vec3d& centre_b) {
  Transform<L> a_from_b;
  if (law == OrientationLaw::isotropic) a_from_b = uniform_rotation(point[3], point[4], point[5]);
  const Vec3<L> turned_centre = a_from_b(broadcast<L>(centre_b));  // no translation yet
  a_from_b.translation = position_in(domain, point[0], point[1], point[2]) - turned_centre;
  return a_from_b;
}

}  // namespace vex
