#include "engine/query/exact/recorded_core.h"

#include <cmath>

#include "engine/numeric/directions.h"

namespace vex {
RecordedCore::Point RecordedCore::support(const Vec3e& normal) const {
  const Vec3e dir_b = forms_.a_from_b().direction_to_b(-normal);
  const LocalForms::Farthest a = forms_.farthest_of_a(normal), b = forms_.farthest_of_b(-normal, dir_b);
  const bool is_late = dot(normal, to_ - from_) < Extended(0.0);
  const Vec3e w = ((a.point - b.point) - forms_.a_from_b().translation) - (is_late ? to_ : from_);
  records_.push_back({{high_part(normal), low_part(normal), high_part(dir_b), low_part(dir_b), a.own, b.own}, is_late});
  const Extended gap = -(dot(normal, w) / norm(normal));
  if (gap > best_gap_) {
    best_gap_ = gap;
    best_dir_ = normal;
  }
  return {w, records_.size() - 1};
}

ExactVector RecordedCore::best_dir() const { return {{{high_part(best_dir_), 0}, {low_part(best_dir_), 0}}}; }

CoreProof prove_nearness(const RecordedCore& core, const Vec3d& first_dir, double gap, int max_support_calls) {
  const bool has_dir = is_finite(first_dir) && norm_1(first_dir) > 0.0;
  const Vec3e first = broadcast<Extended>(has_dir ? scaled_to_unit_exponent(first_dir) : kAnyUnitVector);
  return prove_nearness_in<Extended>(core, first, gap, max_support_calls);
}

}  // namespace vex
