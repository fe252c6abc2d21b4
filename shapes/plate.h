// A flat rectangular plate in the plane z = 0, its middle at the origin, edges along x and y. It has no thickness.
#pragma once

#include <numbers>
#include <vector>

#include "engine/numeric/rounding.h"
#include "engine/support/checked_input.h"
#include "engine/support/exact_form.h"
#include "engine/support/generators.h"
#include "engine/support/support_mapping.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"

namespace vex {

class Plate {
 public:
  /// Full edges. Their halves are exact, so the four vertices are exactly (+-a/2, +-b/2, 0).
  Plate(double edge_x, double edge_y)
      : half_x_(0.5 * checked_size(edge_x, "an edge of a plate")),
        half_y_(0.5 * checked_size(edge_y, "an edge of a plate")) {}

  /// A vertex picked by signs: exact.
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return {copy_sign(L(half_x_), dir.x), copy_sign(L(half_y_), dir.y), L(0.0)};
  }
  bool rounds_as_kernels() const { return true; }
  double support_error() const { return 0.0; }
  Vec3d centre() const { return {}; }
  double circumradius() const { return safe_norm(Vec3d{half_x_, half_y_, 0.0}) * (1.0 + gamma(4)); }
  double inradius() const { return 0.0; }

  double edge_x() const { return 2.0 * half_x_; }
  double edge_y() const { return 2.0 * half_y_; }
  std::vector<Vec3d> vertices() const {
    return {{-half_x_, -half_y_, 0.0}, {half_x_, -half_y_, 0.0}, {-half_x_, half_y_, 0.0}, {half_x_, half_y_, 0.0}};
  }
  ExactForm exact_form() const { return {vertices(), {}, 0.0}; }
  Generators generators() const { return {{}, {{{half_x_, 0.0, 0.0}, {0.0, half_y_, 0.0}}}, 2}; }
  std::size_t n_faces() const { return 2; }  // its two sides

  /// Both sides count: S = 2 a b, and M = pi P / 2 with the perimeter P.
  Measures measures() const { return {0.0, 2.0 * edge_x() * edge_y(), std::numbers::pi * (edge_x() + edge_y())}; }

  NormalMeasure area_measure() const {
    NormalMeasure area;
    for (const double side : {-1.0, 1.0}) area.add(NormalAtom{{0.0, 0.0, side}, edge_x() * edge_y()});
    return area;
  }
  /// Four edges of exterior angle pi.
  NormalMeasure mean_curvature_measure() const {
    constexpr double pi = std::numbers::pi;
    NormalMeasure curvature;
    for (const double side : {-1.0, 1.0}) {
      curvature.add(NormalArc{{0.0, 0.0, 1.0}, {side, 0.0, 0.0}, pi, 0.5 * pi * edge_y()});
      curvature.add(NormalArc{{0.0, 0.0, 1.0}, {0.0, side, 0.0}, pi, 0.5 * pi * edge_x()});
    }
    return curvature;
  }

 private:
  double half_x_, half_y_;
};

}  // namespace vex
