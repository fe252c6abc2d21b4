// A regular tetrahedron, its centroid at the origin, its vertices four corners of a cube with edges along x, y and z.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/numeric/rounding.h"
#include "engine/support/checked_input.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"
#include "shapes/polytope.h"

namespace vex {

/// The body is the hull of the stored doubles, which are the regular body's coordinates to rounding.
class Tetrahedron : public Polytope {
 public:
  explicit Tetrahedron(double edge)
      : Polytope(corners(edge), {}, std::sqrt(6.0) / 12.0 * edge * (1.0 - gamma(32))), edge_(edge) {}

  std::size_t n_faces() const { return 4; }

  /// M is half of six edges times the exterior angle acos(-1/3).
  Measures measures() const {
    const double e = edge_;
    return {e * e * e / (6.0 * std::numbers::sqrt2), std::numbers::sqrt3 * e * e, 3.0 * e * std::acos(-1.0 / 3.0)};
  }

  NormalMeasure area_measure() const { return regular_polyhedron_area(face_directions(), measures()); }
  NormalMeasure mean_curvature_measure() const {
    return regular_polyhedron_mean_curvature(face_directions(), measures());
  }

 private:
  /// The faces look away from the corners opposite.
  static std::vector<Vec3d> face_directions() { return {{-1, -1, -1}, {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}}; }
  static std::vector<Vec3d> corners(double edge) {
    checked_size(edge, "the edge of a tetrahedron");
    const double a = edge * (0.25 * std::numbers::sqrt2);  // half the edge of the cube
    return {{a, a, a}, {a, -a, -a}, {-a, a, -a}, {-a, -a, a}};
  }

  double edge_;
};

}  // namespace vex
