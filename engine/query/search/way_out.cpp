#include "engine/query/search/way_out.h"

#include <cmath>

#include "engine/numeric/directions.h"
#include "engine/query/search/ray_search.h"

namespace vex {
namespace {

constexpr int kMostRays = 8;

}  // namespace

WayOut shorter_way_out(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                       const CoreDifference& difference, const Vec3d& normal, double height, double least_gain) {
  WayOut best;
  best.normal = normal;
  best.height = height;
  const double size = a.circumradius() + b.circumradius();
  const double radii = difference.radius_a() + difference.radius_b();
  for (int k = 0; k < kMostRays; ++k) {
    // B beyond A, about as far as it was in it, and cast back.
    Transformd beyond = a_from_b;
    const Vec3d way = (2.0 * (best.height + radii) + 0x1p-20 * size) * best.normal;
    beyond.translation = beyond.translation + way;
    RaySearch search(a, b, beyond, -scaled_to_unit_exponent(best.normal));
    const RayBounds bounds = search.run(best.normal, true);
    const RaySearch::Touch touch = search.touch();
    best.n_support_calls += search.n_support_calls() + 1;
    if (!bounds.is_hit || !(norm_1(touch.normal) > 0.0)) break;
    // Where the ray leaves: without the balls, and without what rolls on the surfaces.
    const double rolling_a = difference.radius_a() - a.ball_radius(),
                 rolling_b = difference.radius_b() - b.ball_radius();
    best.core_a = (touch.point_a - a.ball_radius() * touch.normal) - rolling_a * best.normal;
    best.core_b = ((touch.point_b - way) + b.ball_radius() * touch.normal) + rolling_b * best.normal;
    best.own_core_b = (touch.point_b_in_b + b.ball_radius() * a_from_b.direction_to_b(touch.normal)) +
                      rolling_b * a_from_b.direction_to_b(best.normal);
    const double along = dot(touch.normal, difference.support(touch.normal).w);
    if (!(along < best.height - least_gain) || k + 1 == kMostRays) break;
    best.is_shorter = true;
    best.normal = touch.normal;
    best.height = along;
  }
  return best;
}

}  // namespace vex
