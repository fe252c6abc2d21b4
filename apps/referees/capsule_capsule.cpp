#include "apps/referees/capsule_capsule.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/numeric/rounding.h"

namespace vex {
namespace {

// A's axis: s e_z, |s| <= half_a. B's: t + q v, |q| <= half_b.
struct Axes {
  Vec3d t, v;
  double half_a, half_b;
  double v_sq;

  // How far apart the axes are along `dir`, times its length: dir separates balls of total radius r about them where
  // this is above r |dir|.
  double gap(const Vec3d& dir) const {
    return (dot(dir, t) - std::fabs(dir.z) * half_a) - std::fabs(dot(dir, v)) * half_b;
  }
  // dir without its part along v; the second pass takes away what rounding left of it.
  Vec3d across_v(Vec3d dir) const {
    for (int pass = 0; pass < 2; ++pass) dir = dir - (dot(dir, v) / v_sq) * v;
    return dir;
  }
};

}  // namespace

Outcome capsules_overlap(const CapsuleSize& a, const CapsuleSize& b, const Transformd& a_from_b) {
  Axes axes{
      a_from_b.translation, {a_from_b.row_x.z, a_from_b.row_y.z, a_from_b.row_z.z}, a.half_length, b.half_length, 0.0};
  const Vec3d &t = axes.t, &v = axes.v;
  axes.v_sq = dot(v, v);
  const double radii = a.radius + b.radius;
  const double error = 20.0 * kUnitRoundoff * ((axes.half_a + 2.0 * axes.half_b) + norm_1(t) + radii);

  // The closest points. A's axis being e_z, the lines' common perpendicular is a matter of x and y, without the
  // cancellation of the textbook's ac - b^2 for nearly parallel ones.
  const double across_sq = v.x * v.x + v.y * v.y;
  double q = across_sq > 0x1p-900 ? -(t.x * v.x + t.y * v.y) / across_sq : 0.0;
  q = std::clamp(q, -axes.half_b, axes.half_b);
  const double s_of_line = t.z + q * v.z;
  const double s = std::clamp(s_of_line, -axes.half_a, axes.half_a);
  if (s != s_of_line) {
    q = std::clamp((v.z * (s - t.z) - (v.x * t.x + v.y * t.y)) / axes.v_sq, -axes.half_b, axes.half_b);
  }
  const Vec3d between{t.x + q * v.x, t.y + q * v.y, (t.z + q * v.z) - s};
  const double distance = norm(between);
  if (distance <= radii - error) return Outcome::overlap;
  const auto separates = [&](const Vec3d& dir, double length) {
    return axes.gap(dir) - radii * length > error * length;
  };
  if (separates(between, distance)) return Outcome::disjoint;
  // Near contact: directions that are across an axis to the last bit, not only to rounding.
  const Vec3d flat{between.x, between.y, 0.0};
  const Vec3d across_both = copy_sign(1.0, v.x * t.y - v.y * t.x) * Vec3d{-v.y, v.x, 0.0};
  for (const Vec3d& dir : std::array{flat, axes.across_v(between), across_both, axes.across_v(flat)}) {
    const Vec3d scaled = scaled_to_unit_exponent(dir);
    if (separates(scaled, norm(scaled))) return Outcome::disjoint;
  }
  return Outcome::undecided;
}

}  // namespace vex
