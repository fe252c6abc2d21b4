// A rectangular box about the origin, edges along x, y and z.
#pragma once

#include <algorithm>
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

class Box {
 public:
  /// Full edges. Their halves are exact, so the eight vertices are exactly (+-a/2, +-b/2, +-c/2).
  Box(double edge_x, double edge_y, double edge_z)
      : half_{0.5 * checked_size(edge_x, "an edge of a box"), 0.5 * checked_size(edge_y, "an edge of a box"),
              0.5 * checked_size(edge_z, "an edge of a box")} {}

  /// A vertex picked by signs: exact.
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return {copy_sign(L(half_.x), dir.x), copy_sign(L(half_.y), dir.y), copy_sign(L(half_.z), dir.z)};
  }
  bool rounds_as_kernels() const { return true; }
  double support_error() const { return 0.0; }
  Vec3d centre() const { return {}; }
  double circumradius() const { return safe_norm(half_) * (1.0 + gamma(4)); }
  double inradius() const { return std::min({half_.x, half_.y, half_.z}); }

  std::vector<Vec3d> vertices() const {
    std::vector<Vec3d> all;
    for (const double z : {-half_.z, half_.z}) {
      for (const double y : {-half_.y, half_.y}) {
        for (const double x : {-half_.x, half_.x}) all.push_back({x, y, z});
      }
    }
    return all;
  }
  ExactForm exact_form() const { return {vertices(), {}, 0.0}; }
  Generators generators() const { return {{}, {{{half_.x, 0.0, 0.0}, {0.0, half_.y, 0.0}, {0.0, 0.0, half_.z}}}, 3}; }
  std::size_t n_faces() const { return 6; }
  /// Full edges along x, y, z.
  Vec3d edges() const { return 2.0 * half_; }

  Measures measures() const {
    const auto [a, b, c] = edges();
    return {a * b * c, 2.0 * (a * b + b * c + c * a), std::numbers::pi * (a + b + c)};
  }

  NormalMeasure area_measure() const {
    const auto [a, b, c] = edges();
    NormalMeasure area;
    for (const double s : {-1.0, 1.0}) {
      area.add(NormalAtom{{s, 0.0, 0.0}, b * c});
      area.add(NormalAtom{{0.0, s, 0.0}, c * a});
      area.add(NormalAtom{{0.0, 0.0, s}, a * b});
    }
    return area;
  }
  /// An edge of length l and exterior angle pi/2 has pi/4 l.
  NormalMeasure mean_curvature_measure() const {
    const auto [a, b, c] = edges();
    constexpr double quarter = 0.25 * std::numbers::pi, right_angle = 0.5 * std::numbers::pi;
    NormalMeasure curvature;
    for (const double s : {-1.0, 1.0}) {
      for (const double t : {-1.0, 1.0}) {
        curvature.add(NormalArc{{0.0, s, 0.0}, {0.0, 0.0, t}, right_angle, quarter * a});
        curvature.add(NormalArc{{0.0, 0.0, s}, {t, 0.0, 0.0}, right_angle, quarter * b});
        curvature.add(NormalArc{{s, 0.0, 0.0}, {0.0, t, 0.0}, right_angle, quarter * c});
      }
    }
    return curvature;
  }

 private:
  Vec3d half_;
};

}  // namespace vex
