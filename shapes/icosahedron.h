// A regular icosahedron, its centroid at the origin, its vertices the corners of three golden rectangles in the planes
// of the axes.
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
class Icosahedron : public Polytope {
 public:
  explicit Icosahedron(double edge)
      : Polytope(corners(edge), {},
                 std::numbers::phi * std::numbers::phi / (2.0 * std::numbers::sqrt3) * edge * (1.0 - gamma(32))),
        edge_(edge) {}

  std::size_t n_faces() const { return 20; }

  /// M is half of thirty edges times the exterior angle acos(sqrt(5)/3).
  Measures measures() const {
    const double e = edge_;
    return {5.0 / 12.0 * (3.0 + std::sqrt(5.0)) * e * e * e, 5.0 * std::numbers::sqrt3 * e * e,
            15.0 * e * std::acos(std::sqrt(5.0) / 3.0)};
  }

  NormalMeasure area_measure() const { return regular_polyhedron_area(face_directions(), measures()); }
  NormalMeasure mean_curvature_measure() const {
    return regular_polyhedron_mean_curvature(face_directions(), measures());
  }

 private:
  /// The corners of a dodecahedron.
  static std::vector<Vec3d> face_directions() {
    constexpr double p = std::numbers::phi;
    std::vector<Vec3d> dirs;
    for (const double s : {-1.0, 1.0}) {
      for (const double t : {-1.0, 1.0}) {
        for (const double x : {-1.0, 1.0}) dirs.push_back({x, s, t});
        dirs.insert(dirs.end(), {{0, s * p, t / p}, {s * p, t / p, 0}, {t / p, 0, s * p}});
      }
    }
    return dirs;
  }
  static std::vector<Vec3d> corners(double edge) {
    checked_size(edge, "the edge of an icosahedron");
    const double q = 0.5 * edge, p = q * std::numbers::phi;
    std::vector<Vec3d> v;
    for (const double s : {-1.0, 1.0}) {
      for (const double t : {-1.0, 1.0}) {
        v.insert(v.end(), {{0, s * q, t * p}, {s * q, t * p, 0}, {t * p, 0, s * q}});
      }
    }
    return v;
  }

  double edge_;
};

}  // namespace vex
