// A right antiprism on a regular polygon, axis z, its middle at the origin: the upper polygon is turned by half a side.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/numeric/rounding.h"
#include "shapes/faced_polytope.h"

namespace vex {

/// The body is the hull of the stored doubles, which are the antiprism's corners to rounding.
class Antiprism : public FacedPolytope {
 public:
  /// `n_sides` of each polygon, from 3 to 1000, their edge, and the height. A side of the lower polygon, and a corner
  /// of the upper one, are towards +x.
  Antiprism(int n_sides, double edge, double height)
      : FacedPolytope(two_polygons(n_sides, edge, height, 1, "an antiprism"), faces_of(n_sides), {},
                      inner_radius(n_sides, edge, height)) {}

 private:
  /// Upper corner k is half a side after lower corner k.
  static std::vector<Face> faces_of(int n_sides) {
    const auto n = static_cast<std::uint32_t>(n_sides);
    std::vector<Face> sides;
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t next = (k + 1) % n;
      sides.push_back({k, next, n + k});
      sides.push_back({next, n + next, n + k});
    }
    return between_polygons(n_sides, std::move(sides));
  }
  /// Half the height, or from the origin to a triangle: to the line through the middle of a lower side, at (r, -H/2) in
  /// a half plane of the axis, and the upper corner, at (R, H/2). Corners that are 16 u of R off in x and in y leave a
  /// ball smaller by less than twice that.
  static double inner_radius(int n_sides, double edge, double height) {
    const double outer = polygon_circumradius(n_sides, edge), inner = polygon_inradius(n_sides, edge);
    const double to_triangle = 0.5 * (outer + inner) * (height / std::hypot(height, outer - inner));
    return std::max(0.0, std::min(0.5 * height, to_triangle) * (1.0 - gamma(32)) - 32.0 * kUnitRoundoff * outer);
  }
};

}  // namespace vex
