#include "engine/sampling/fitted_domain.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vex {
namespace {

constexpr std::array<Vec3d, 3> kFrame = {Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, 0.0, 1.0}};

// Below this sine of the angle between u_A and u_B the two choices that are made of their product are left alone: A's
// axes serve as well, and positions keep more than half of their digits.
constexpr double kLeastSine = 0x1p-20;

// The rounding of `Parallelepiped::position` and of the dual vectors, relative to the lengths summed (E13).
constexpr double kPositionError = 0x1p-48;

double reach_along(const ConvexBody& body, const Vec3d& dir) { return dot(dir, body.support(dir)); }

// The long axis, the short one, or both: each where it is unlike the middle one. Of a body whose widths are all much
// the same, and of a needle, whose widths but one are nothing, the one that differs more, as a ratio.
template <class Intervals>
std::vector<std::size_t> axes_of_their_own(const Intervals& own) {
  constexpr double kUnlike = 1.5;
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::ranges::stable_sort(order, {}, [&own](std::size_t k) { return own[k].upper - own[k].lower; });
  const auto width = [&](std::size_t rank) { return own[order[rank]].upper - own[order[rank]].lower; };
  const bool is_rather_long = width(2) * width(0) >= width(1) * width(1);
  const bool has_long = width(2) > kUnlike * width(1), has_short = width(1) > kUnlike * width(0);
  if (has_long && has_short) return {order[2], order[0]};
  return {is_rather_long ? order[2] : order[0]};
}

}  // namespace

FittedDomain::FittedDomain(const ConvexBody& a, const ConvexBody& b)
    : a_(a), b_(b), margin_(2.0 * (a.support_error() + b.support_error()) + 0x1p-43 * (a.reach() + b.reach())) {
  for (std::size_t k = 0; k < 3; ++k) {
    own_a_[k] = {-reach_along(a, -kFrame[k]), reach_along(a, kFrame[k])};
    own_b_[k] = {-reach_along(b, -kFrame[k]), reach_along(b, kFrame[k])};
  }
  axes_a_ = axes_of_their_own(own_a_);
  axes_b_ = axes_of_their_own(own_b_);
  // A's axes with the largest that B can add, whose circumscribed ball is about its centre; slightly enlarged, so that
  // rounding cannot make it the smaller one.
  const auto half_extent = [&](std::size_t k) {
    return (0.5 * (own_a_[k].upper - own_a_[k].lower) + b.circumradius() + 2.0 * margin_) * (1.0 + 0x1p-40);
  };
  largest_half_extent_ = {half_extent(0), half_extent(1), half_extent(2)};
}

FittedDomain::Interval FittedDomain::along(const Vec3d& normal, const Transformd& rotation) const {
  const Vec3d normal_in_b = rotation.direction_to_b(normal);
  return {-(reach_along(a_, -normal) + reach_along(b_, normal_in_b)),
          reach_along(a_, normal) + reach_along(b_, -normal_in_b)};
}

Parallelepiped FittedDomain::at(const Transformd& rotation) const {
  const std::array<Vec3d, 3> rows = {rotation.row_x, rotation.row_y, rotation.row_z};
  const std::array<Vec3d, 3> axes_b = {Vec3d{rows[0].x, rows[1].x, rows[2].x}, Vec3d{rows[0].y, rows[1].y, rows[2].y},
                                       Vec3d{rows[0].z, rows[1].z, rows[2].z}};
  Intervals along_a, along_b;
  for (std::size_t k = 0; k < 3; ++k) {
    along_a[k] = {own_a_[k].lower - reach_along(b_, rows[k]), own_a_[k].upper + reach_along(b_, -rows[k])};
    along_b[k] = {-reach_along(a_, -axes_b[k]) - own_b_[k].upper, reach_along(a_, axes_b[k]) - own_b_[k].lower};
  }

  Parallelepiped best;
  const auto consider = [&](const std::array<Vec3d, 3>& normals, const Intervals& intervals) {
    const double determinant = dot(normals[0], cross(normals[1], normals[2]));
    Parallelepiped set;
    const auto widen = [&](double margin) {
      set.volume = 1.0 / std::fabs(determinant);
      for (std::size_t k = 0; k < 3; ++k) {
        const double along_normal = margin * norm_1(normals[k]);
        set.lower[k] = intervals[k].lower - along_normal;
        set.width[k] = (intervals[k].upper - intervals[k].lower) + 2.0 * along_normal;
        set.volume *= set.width[k];
      }
      return !(best.volume > 0.0) || set.volume < best.volume;
    };
    if (!widen(margin_)) return;
    double longest = 0.0;  // what a position is summed from, none of its terms longer
    for (std::size_t k = 0; k < 3; ++k) {
      set.dual[k] = (1.0 / determinant) * cross(normals[(k + 1) % 3], normals[(k + 2) % 3]);
      longest += std::max(std::fabs(intervals[k].lower), std::fabs(intervals[k].upper)) * norm_1(set.dual[k]);
    }
    if (widen(margin_ + kPositionError * longest)) best = set;
  };

  consider(kFrame, along_a);
  consider(axes_b, along_b);
  for (const std::size_t axis_a : axes_a_) {
    for (const std::size_t axis_b : axes_b_) {
      const Vec3d& u_a = kFrame[axis_a];
      const Vec3d& u_b = axes_b[axis_b];
      const Vec3d c = cross(u_a, u_b);
      if (!(dot(c, c) > kLeastSine * kLeastSine)) continue;
      const Interval along_c = along(c, rotation);
      consider({u_a, u_b, c}, {along_a[axis_a], along_b[axis_b], along_c});
      const Vec3d across_a = cross(c, u_a), across_b = cross(c, u_b);
      consider({across_a, across_b, c}, {along(across_a, rotation), along(across_b, rotation), along_c});
    }
  }
  return best;
}

Domain fitted_domain(const ConvexBody& a, const ConvexBody& b) {
  Domain domain;
  domain.kind = Domain::Kind::fitted;
  domain.half_extent = FittedDomain(a, b).largest_half_extent();
  domain.volume = 8.0 * (domain.half_extent.x * domain.half_extent.y * domain.half_extent.z);
  return domain;
}

}  // namespace vex
