// A right pyramid on a regular polygon, axis z, the base at z = -H/2 and the apex at z = H/2.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/numeric/rounding.h"
#include "engine/support/checked_input.h"
#include "shapes/faced_polytope.h"
#include "shapes/frustum.h"

namespace vex {

/// The body is the hull of the stored doubles, which are the pyramid's corners to rounding.
class Pyramid : public FacedPolytope {
 public:
  /// `n_sides` of the base, from 3 to 1000, its edge, and the height. A side of the base is towards +x.
  Pyramid(int n_sides, double edge, double height)
      : FacedPolytope(corners(n_sides, edge, height), sides(n_sides), middle(n_sides, edge, height),
                      inner_radius(n_sides, edge, height)) {}

 private:
  static std::vector<Vec3d> corners(int n_sides, double edge, double height) {
    checked_n_sides(n_sides, "a pyramid");
    checked_size(edge, "the edge of a pyramid");
    checked_size(height, "the height of a pyramid");
    std::vector<Vec3d> all = regular_polygon(n_sides, edge, -0.5 * height);
    all.push_back({0.0, 0.0, 0.5 * height});
    return all;
  }
  static std::vector<Face> sides(int n_sides) {
    const auto n = static_cast<std::uint32_t>(n_sides);
    std::vector<Face> faces;
    Face base;
    for (std::uint32_t k = 0; k < n; ++k) {
      base.push_back(n - 1 - k);
      faces.push_back({k, (k + 1) % n, n});
    }
    faces.push_back(std::move(base));
    return faces;
  }
  /// That of the cone about it.
  static Vec3d middle(int n_sides, double edge, double height) {
    return Frustum(height, polygon_circumradius(n_sides, edge), 0.0).centre();
  }
  /// To the base, or to a side, whose plane touches the cone on the circle in the base. Corners that are 16 u of the
  /// circumradius off in x and in y leave a ball smaller by less than twice that.
  static double inner_radius(int n_sides, double edge, double height) {
    const double outer = polygon_circumradius(n_sides, edge), inner = polygon_inradius(n_sides, edge);
    const double below = middle(n_sides, edge, height).z + 0.5 * height;
    const double to_side = inner * ((height - below) / std::hypot(height, inner));
    return std::max(0.0, std::min(below, to_side) * (1.0 - gamma(32)) - 32.0 * kUnitRoundoff * outer);
  }
};

}  // namespace vex
