// A regular octahedron, its centroid at the origin, its vertices on the axes.
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

  NormalMeasure area_measure() const { return regular_polyhedron_area(face_directions(), measures()); }
  NormalMeasure mean_curvature_measure() const {
    return regular_polyhedron_mean_curvature(face_directions(), measures());
  }

 private:
  /// The corners of a cube.
  static std::vector<Vec3d> face_directions() {
    std::vector<Vec3d> dirs;
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        for (const double z : {-1.0, 1.0}) dirs.push_back({x, y, z});
      }
    }
    return dirs;
  }
  static std::vector<Vec3d> corners(double edge) {
    checked_size(edge, "the edge of an octahedron");
    const double a = edge * (0.5 * std::numbers::sqrt2);
    return {{-a, 0, 0}, {a, 0, 0}, {0, -a, 0}, {0, a, 0}, {0, 0, -a}, {0, 0, a}};
  }

  double edge_;
};

}  // namespace vex
