// The points of two placed polytopes, rounded or not, as whole numbers of one unit: what exact verdicts and casts work
// on.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "engine/numeric/whole.h"
#include "engine/query/exact/placed_forms.h"

namespace vex {

/// Made when they are asked for. Holds a reference.
class WholePoints {
 public:
  explicit WholePoints(const PlacedForms& forms) : forms_(forms), is_placed_exactly_(!forms.is_b_rounded) {
    for (const Vec3d& p : forms.a.points) unit_ = whole::lowest_exponent(unit_, p);
    if (is_placed_exactly_) {
      // Every product r * x and the sum with t is a multiple of the product of their units.
      int unit_r = whole::lowest_exponent(0.0), unit_x = unit_r;
      const Transformd& pose = forms.a_from_b;
      for (const Vec3d& row : {pose.row_x, pose.row_y, pose.row_z}) unit_r = whole::lowest_exponent(unit_r, row);
      for (const Vec3d& p : forms.b.points) unit_x = whole::lowest_exponent(unit_x, p);
      unit_ = whole::lowest_exponent(std::min(unit_, unit_r + unit_x), pose.translation);
    } else {
      for (const Vec3d& p : forms.placed_b) unit_ = whole::lowest_exponent(unit_, p);
    }
    unit_ = std::min({unit_, whole::lowest_exponent(forms.a.ball_radius), whole::lowest_exponent(forms.b.ball_radius)});
  }

  whole::Vector a(std::size_t i) const { return whole::in_units(forms_.a.points[i], unit_); }
  whole::Vector b(std::size_t i) const {
    if (!is_placed_exactly_) return whole::in_units(forms_.placed_b[i], unit_);
    return whole::in_units(whole::placed(forms_.a_from_b, whole::exactly(forms_.b.points[i])), unit_);
  }
  whole::Integer radii() const {
    return whole::in_units(forms_.a.ball_radius, unit_) + whole::in_units(forms_.b.ball_radius, unit_);
  }

  /// Of vertices that double precision leaves open as the farthest ones along a vector, those that twice the precision
  /// does, in their order; of some that are as far for sure the first.
  void narrow_a(const whole::Vector& dir, std::vector<std::size_t>& open) const {
    narrow(forms_.a.points, {{dir.x, 0}, {dir.y, 0}, {dir.z, 0}}, open);
  }
  void narrow_b(const whole::Vector& dir, std::vector<std::size_t>& open) const {
    const whole::DyadicVector of_a{{dir.x, 0}, {dir.y, 0}, {dir.z, 0}};
    if (!is_placed_exactly_) return narrow(forms_.placed_b, of_a, open);
    narrow(forms_.b.points, whole::direction_to_b(forms_.a_from_b, of_a), open);
  }

  /// Coordinates are these numbers times 2 to this power.
  int unit() const { return unit_; }

 private:
  static void narrow(const std::vector<Vec3d>& vertices, const whole::DyadicVector& exact_dir,
                     std::vector<std::size_t>& open);

  const PlacedForms& forms_;
  bool is_placed_exactly_;
  int unit_ = whole::lowest_exponent(0.0);
};

}  // namespace vex
