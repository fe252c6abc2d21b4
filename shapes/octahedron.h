// A regular octahedron, its centroid at the origin, its vertices on the axes.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/numeric/expect.h"
#include "engine/numeric/rounding.h"
#include "shapes/measures.h"
#include "shapes/polytope.h"

namespace vex {

/// The body is the hull of the stored doubles, which are the regular body's coordinates to rounding.
class Octahedron : public Polytope {
 public:
  explicit Octahedron(double edge)
      : Polytope(corners(edge), {}, std::sqrt(6.0) / 6.0 * edge * (1.0 - gamma(32))), edge_(edge) {}

  std::size_t n_faces() const { return 8; }

  /// M is half of twelve edges times the exterior angle acos(1/3).
  Measures measures() const {
    const double e = edge_;
    return {std::numbers::sqrt2 / 3.0 * e * e * e, 2.0 * std::numbers::sqrt3 * e * e, 6.0 * e * std::acos(1.0 / 3.0)};
  }

 private:
  static std::vector<Vec3d> corners(double edge) {
    VEX_EXPECT(edge > 0.0);
    const double a = edge * (0.5 * std::numbers::sqrt2);
    return {{-a, 0, 0}, {a, 0, 0}, {0, -a, 0}, {0, a, 0}, {0, 0, -a}, {0, 0, a}};
  }

  double edge_;
};

}  // namespace vex
