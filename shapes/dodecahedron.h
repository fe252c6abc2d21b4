// A regular dodecahedron, its centroid at the origin, eight of its vertices corners of a cube with edges along x, y and
// z.
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
class Dodecahedron : public Polytope {
 public:
  explicit Dodecahedron(double edge)
      : Polytope(corners(edge), {}, 0.5 * std::sqrt(2.5 + 1.1 * std::sqrt(5.0)) * edge * (1.0 - gamma(32))),
        edge_(edge) {}

  std::size_t n_faces() const { return 12; }

  /// M is half of thirty edges times the exterior angle atan 2.
  Measures measures() const {
    const double e = edge_;
    return {(15.0 + 7.0 * std::sqrt(5.0)) / 4.0 * e * e * e, 3.0 * std::sqrt(25.0 + 10.0 * std::sqrt(5.0)) * e * e,
            15.0 * e * std::atan(2.0)};
  }

  NormalMeasure area_measure() const { return regular_polyhedron_area(face_directions(), measures()); }
  NormalMeasure mean_curvature_measure() const {
    return regular_polyhedron_mean_curvature(face_directions(), measures());
  }

 private:
  /// The corners of an icosahedron.
  static std::vector<Vec3d> face_directions() {
    constexpr double p = std::numbers::phi;
    std::vector<Vec3d> dirs;
    for (const double s : {-1.0, 1.0}) {
      for (const double t : {-p, p}) dirs.insert(dirs.end(), {{0, t, s}, {t, s, 0}, {s, 0, t}});
    }
    return dirs;
  }
  static std::vector<Vec3d> corners(double edge) {
    checked_size(edge, "the edge of a dodecahedron");
    const double a = edge * (0.5 * std::numbers::phi);  // half the edge of the cube
    const double p = a * std::numbers::phi, q = 0.5 * edge;
    std::vector<Vec3d> v;
    for (const double s : {-1.0, 1.0}) {
      for (const double t : {-1.0, 1.0}) {
        for (const double x : {-a, a}) v.push_back({x, s * a, t * a});
        v.insert(v.end(), {{0, s * q, t * p}, {s * q, t * p, 0}, {t * p, 0, s * q}});
      }
    }
    return v;
  }

  double edge_;
};

}  // namespace vex
