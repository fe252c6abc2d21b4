// A needle: a line segment on the z axis with its middle at the origin. What a capsule is rounded from.
#pragma once

#include <numbers>
#include <vector>

#include "engine/support/checked_input.h"
#include "engine/support/exact_form.h"
#include "engine/support/generators.h"
#include "engine/support/support_mapping.h"
#include "shapes/measures.h"
#include "shapes/normal_measure.h"

namespace vex {

class Needle {
 public:
  explicit Needle(double length) : half_length_(0.5 * checked_size(length, "the length of a needle")) {}

  /// One of the two ends: exact.
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return {L(0.0), L(0.0), copy_sign(L(half_length_), dir.z)};
  }
  bool rounds_as_kernels() const { return true; }
  double support_error() const { return 0.0; }
  Vec3d centre() const { return {}; }
  double circumradius() const { return half_length_; }
  double inradius() const { return 0.0; }

  double length() const { return 2.0 * half_length_; }
  std::vector<Vec3d> vertices() const { return {{0.0, 0.0, -half_length_}, {0.0, 0.0, half_length_}}; }
  ExactForm exact_form() const { return {vertices(), {}, 0.0}; }
  Generators generators() const { return {{}, {{{0.0, 0.0, half_length_}}}, 1}; }
  std::size_t n_faces() const { return 0; }

  /// The limit of a thin cylinder: a needle has no area, but a mean width.
  Measures measures() const { return {0.0, 0.0, std::numbers::pi * length()}; }

  /// Nothing: a needle has no area.
  NormalMeasure area_measure() const { return {}; }
  /// All normals at a right angle to it, alike.
  NormalMeasure mean_curvature_measure() const {
    NormalMeasure curvature;
    curvature.add(NormalRing{0.0, 1.0, std::numbers::pi * length()});
    return curvature;
  }

 private:
  double half_length_;
};

}  // namespace vex
