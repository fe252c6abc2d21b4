// How deep the way between two bodies' centres is in what is known of their Minkowski difference (internal).
#pragma once

#include <array>
#include <cmath>

#include "engine/numeric/lane.h"
#include "engine/numeric/vec3.h"

namespace vex {

/// The hull of a ball about 0 and of a tip, or a half-space, by the normals of its supporting planes: those of the ball
/// but for the ones that look to the tip, n·axis <= sine; of a half-space the one that is `axis`. In floats, which are
/// rounded so that the set is never larger than it is (E26).
struct KnownHull {
  std::array<float, 3> axis{};
  float sine = 1.0f, cosine = 0.0f;

  /// Of a ball of this radius about 0. Where the tip is in the ball, or hardly out of it, that is all.
  static KnownHull around_core(double core, const Vec3d& tip) {
    const double length = norm(tip);
    if (!(length > (1.0 + 0x1p-10) * core)) return {};
    const double sine = core / length;
    const auto above = [](double x) { return static_cast<float>(x * (1.0 + 0x1p-19)); };
    return {floats((1.0 / length) * tip), above(sine), above(std::sqrt(1.0 - sine * sine))};
  }
  static std::array<float, 3> floats(const Vec3d& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  }
  static Vec3d vector(const std::array<float, 3>& v) {
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  }

  /// The most of n·x over the normals, or a trifle more: x is inside by the ball's radius less this. Of the half-space
  /// axis·x.
  double most_of(const Vec3d& x, bool is_half_space) const {
    const Vec3d u = vector(axis);
    const double along = dot(u, x), away = norm(x - along * u), length = norm(x);
    // Nothing foretells which of the two a pair has, nor on which side it is.
    const double least_along = blend(is_half_space, -2.0, static_cast<double>(sine));
    const double by_edge = along * static_cast<double>(sine) + away * static_cast<double>(cosine);
    return blend(along > least_along * length, by_edge, length);
  }
};

/// A triangle in the difference, seen from that of the centres, in floats. Nothing is asked of its shape.
struct KnownFacet {
  std::array<std::array<float, 3>, 3> corners{};

  /// A point of it, in the direction of x where the triangle is: a mean of its corners with weights that are not below
  /// 0, whatever rounding makes of them. Where there is none, nothing.
  Vec3d towards(const Vec3d& x) const {
    const Vec3d p = KnownHull::vector(corners[0]), q = KnownHull::vector(corners[1]), r = KnownHull::vector(corners[2]);
    const Vec3d across = cross(p, q);
    const double side = dot(across, r) < 0.0 ? -1.0 : 1.0;
    const double of_p = std::fmax(side * dot(cross(q, r), x), 0.0), of_q = std::fmax(side * dot(cross(r, p), x), 0.0),
                 of_r = std::fmax(side * dot(across, x), 0.0), all = of_p + of_q + of_r;
    if (!(all > 0.0)) return {};
    return (of_p / all) * p + ((of_q / all) * q + (of_r / all) * r);
  }
};

}  // namespace vex
