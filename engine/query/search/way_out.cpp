#include "engine/query/search/way_out.h"

#include <cmath>

#include "engine/numeric/directions.h"
#include "engine/query/search/ray_search.h"

namespace vex {
namespace {

constexpr int kMostRays = 8;

}  // namespace

WayOut shorter_way_out(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b,
                       const CoreDifference& difference, const Vec3d& first_normal, double first_height,
                       double least_gain) {
  WayOut best;
  Vec3d normal = first_normal;
  double height = first_height;
  const double size = a.circumradius() + b.circumradius();
  const double radii = difference.radius_a() + difference.radius_b();
  for (int k = 0; k < kMostRays; ++k) {
    // B beyond A, about as far as it was in it, and cast back.
    Transformd beyond = a_from_b;
    const Vec3d way = (2.0 * (height + radii) + 0x1p-20 * size) * normal;
    beyond.translation = beyond.translation + way;
    RaySearch search(a, b, beyond, -scaled_to_unit_exponent(normal));
    const RayBounds bounds = search.run(normal, true);
    const RaySearch::Touch touch = search.touch();
    best.n_support_calls += search.n_support_calls();
    if (!bounds.is_hit || !(norm_1(touch.normal) > 0.0)) break;
    best.is_found = true;
    best.normal = normal;
    best.height = height;
    best.point_a = touch.point_a;
    best.point_b = touch.point_b - way;
    best.point_b_in_b = touch.point_b_in_b;
    normal = touch.normal;
    height = dot(normal, difference.support(normal).w);
    ++best.n_support_calls;
    if (!(height < best.height - least_gain)) break;
  }
  return best;
}

}  // namespace vex
