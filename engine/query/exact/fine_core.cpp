#include "engine/query/exact/fine_core.h"

#include <cmath>

#include "engine/numeric/directions.h"

namespace vex {
namespace {

using Vec3f = Vec3<Float256>;

}  // namespace

FineCore::Point FineCore::support(const Vec3f& normal) const {
  Witness witness;
  split(scaled_to_unit_exponent(normal), witness.dir, witness.dir_low);
  const Vec3f dir = broadcast<Float256>(witness.dir) + broadcast<Float256>(witness.dir_low);
  const Transform<Extended>& pose = forms_.a_from_b();
  const auto fine = [](const Vec3e& v) { return broadcast<Float256>(high_part(v)) + broadcast<Float256>(low_part(v)); };
  const Vec3f row_x = fine(pose.row_x), row_y = fine(pose.row_y), row_z = fine(pose.row_z);
  split(-((dir.x * row_x + dir.y * row_y) + dir.z * row_z), witness.dir_b, witness.dir_b_low);
  const auto extended_sum = [](const Vec3d& high, const Vec3d& low) {
    return Vec3e{{high.x, low.x}, {high.y, low.y}, {high.z, low.z}};
  };
  const Vec3e dir_a = extended_sum(witness.dir, witness.dir_low);
  witness.point_a = forms_.farthest_of_a(dir_a).own;
  witness.point_b = forms_.farthest_of_b(-dir_a, extended_sum(witness.dir_b, witness.dir_b_low)).own;
  const whole::DyadicVector at = pair_.core_point(witness);
  const Vec3f w{Float256(at.x, forms_.exponent()), Float256(at.y, forms_.exponent()),
                Float256(at.z, forms_.exponent())};
  const Float256 gap = -(dot(dir, w) / norm(dir));
  if (gap > best_gap_) {
    best_gap_ = gap;
    best_dir_ = dir;
  }
  records_.push_back({witness});
  return {w, records_.size() - 1};
}

ExactVector FineCore::best_dir() const {
  Vec3d high, low;
  split(best_dir_, high, low);
  return {{{high, 0}, {low, 0}}};
}

CoreProof prove_nearness(const FineCore& core, const Vec3d& first_dir, double gap, int max_support_calls) {
  const bool has_dir = is_finite(first_dir) && norm_1(first_dir) > 0.0;
  const Vec3f first = broadcast<Float256>(has_dir ? scaled_to_unit_exponent(first_dir) : kAnyUnitVector);
  return prove_nearness_in<Float256>(core, first, gap, max_support_calls);
}

}  // namespace vex
