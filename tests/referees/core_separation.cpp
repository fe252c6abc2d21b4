#include "tests/referees/core_separation.h"

#include "apps/referees/origin_simplex.h"

namespace vex::exact {
namespace {

constexpr int kMaxSteps = 1000;
// Points are of size 1; shorter than this, a vector is nothing but rounding.
constexpr double kNothing = 0x1p-96;

}  // namespace

Bounds distance_of_cores(const DifferenceBody& difference, const Vec3dd& start) {
  Bounds bounds;
  OriginSimplex simplex;
  simplex.points.push_back(difference.support_of_cores(start));
  for (int step = 0; step < kMaxSteps; ++step) {
    Vec3dd v;
    const bool is_inside = !simplex.reduce(v);
    const DoubleDouble length = is_inside ? DoubleDouble() : norm(v);
    if (length.value() <= kNothing) {
      bounds.lower = bounds.upper = 0.0;
      return bounds;
    }
    if (!(length < bounds.upper)) return bounds;  // no nearer than before
    bounds.upper = length;
    const Vec3dd dir{-v.x / length, -v.y / length, -v.z / length};
    const DifferencePoint w = difference.support_of_cores(dir);
    const DoubleDouble lower = -dot(w.approximately, dir);
    if (lower > bounds.lower) {
      bounds.lower = lower;
      bounds.direction = dir;
    }
    if ((bounds.upper - bounds.lower).value() <= kNearEnough || has_point(simplex, w)) return bounds;
    simplex.points.push_back(w);
  }
  return bounds;
}

Bounds signed_distance_of_cores(const DifferenceBody& difference, const Vec3dd& start) {
  const Bounds distance = distance_of_cores(difference, start);
  if (distance.lower.value() > 0.0) return distance;
  const Bounds depth = depth_of_cores(difference);
  // The descent's own bound from below, where it has one, is as good as any direction's.
  const DoubleDouble lower = distance.upper.value() > 0.0 ? larger(-depth.upper, distance.lower) : -depth.upper;
  return {lower, depth.lower.value() > 0.0 ? -depth.lower : distance.upper, depth.direction};
}

}  // namespace vex::exact
