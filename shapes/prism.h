// A right prism on a regular polygon, axis z, its middle at the origin.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/numeric/rounding.h"
#include "shapes/faced_polytope.h"

namespace vex {

/// The body is the hull of the stored doubles, which are the regular prism's corners to rounding.
class Prism : public FacedPolytope {
 public:
  /// `n_sides` from 3 to 1000, the edge of the base and the height. A side faces along +x.
  Prism(int n_sides, double edge, double height)
      : FacedPolytope(two_polygons(n_sides, edge, height, 0, "a prism"), faces_of(n_sides), {},
                      inner_radius(n_sides, edge, height)) {}

 private:
  static std::vector<Face> faces_of(int n_sides) {
    const auto n = static_cast<std::uint32_t>(n_sides);
    std::vector<Face> sides;
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t next = (k + 1) % n;
      sides.push_back({k, next, n + next, n + k});
    }
    return between_polygons(n_sides, std::move(sides));
  }
  /// Corners that are 16 u of the circumradius off in x and in y leave a ball smaller by less than twice that.
  static double inner_radius(int n_sides, double edge, double height) {
    const double off = 32.0 * kUnitRoundoff * polygon_circumradius(n_sides, edge);
    return std::max(0.0, std::min(0.5 * height, polygon_inradius(n_sides, edge)) * (1.0 - gamma(32)) - off);
  }
};

}  // namespace vex
