#include "engine/numeric/pose_algebra.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"
#include "engine/numeric/quaternion.h"
#include "engine/numeric/rounding.h"

namespace vex {

Pose operator*(const Pose& a_from_b, const Pose& b_from_c) {
  const Transformd &first = a_from_b.a_from_b(), &second = b_from_c.a_from_b();
  const auto product = [&second](const Vec3d& row) -> Vec3d { return second.direction_to_b(row); };
  return Transformd{product(first.row_x), product(first.row_y), product(first.row_z), first(second.translation)};
}

Transformd inverse(const Transformd& a_from_b) {
  const auto& [x, y, z, translation] = a_from_b;
  return {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}, -a_from_b.direction_to_b(translation)};
}

Pose inverse(const Pose& a_from_b) { return inverse(a_from_b.a_from_b()); }

Pose pose_of(const std::array<double, 4>& quaternion, const Vec3d& translation) {
  Transformd pose = rotation_from_quaternion(quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
  pose.translation = translation;
  return pose;
}

std::array<double, 4> quaternion_of(const Transformd& pose) {
  const Vec3d &x = pose.row_x, &y = pose.row_y, &z = pose.row_z;
  const double trace = x.x + y.y + z.z;
  std::array<double, 4> q{};
  if (trace >= x.x && trace >= y.y && trace >= z.z) {
    q = {1.0 + trace, z.y - y.z, x.z - z.x, y.x - x.y};
  } else if (x.x >= y.y && x.x >= z.z) {
    q = {z.y - y.z, 1.0 + 2.0 * x.x - trace, x.y + y.x, x.z + z.x};
  } else if (y.y >= z.z) {
    q = {x.z - z.x, x.y + y.x, 1.0 + 2.0 * y.y - trace, y.z + z.y};
  } else {
    q = {y.x - x.y, x.z + z.x, y.z + z.y, 1.0 + 2.0 * z.z - trace};
  }
  const double length = std::sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3] + q[0] * q[0]);
  for (double& component : q) component /= length;
  return q;
}

Pose interpolated(const Pose& from, const Pose& to, double part) {
  if (!(part >= 0.0 && part <= 1.0)) {
    throw UsageError("a part of the way between two poses is not from 0 to 1 (" + shortest_number(part) +
                     ") - give one that is");
  }
  if (part == 0.0) return from;
  if (part == 1.0) return to;
  const std::array<double, 4> p = quaternion_of(from.a_from_b());
  std::array<double, 4> q = quaternion_of(to.a_from_b());
  double cosine = 0.0;
  for (std::size_t k = 0; k < 4; ++k) cosine += p[k] * q[k];
  double difference_sq = 0.0, sum_sq = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (cosine < 0.0) q[k] = -q[k];
    difference_sq += (q[k] - p[k]) * (q[k] - p[k]);
    sum_sq += (q[k] + p[k]) * (q[k] + p[k]);
  }
  // From 0 to a right angle: that between the quaternions, half of what is turned. The arc tangent keeps its digits
  // where a cosine has none, at small angles.
  const double angle_rad = 2.0 * std::atan2(std::sqrt(difference_sq), std::sqrt(sum_sq));
  double of_p = 1.0 - part, of_q = part;
  if (angle_rad > 0.0) {
    of_p = std::sin((1.0 - part) * angle_rad);
    of_q = std::sin(part * angle_rad);
  }
  const Vec3d t = (1.0 - part) * from.a_from_b().translation + part * to.a_from_b().translation;
  return pose_of(
      {of_p * p[0] + of_q * q[0], of_p * p[1] + of_q * q[1], of_p * p[2] + of_q * q[2], of_p * p[3] + of_q * q[3]}, t);
}

Transformd relative_pose(const Transformd& world_from_a, const Transformd& world_from_b, const Vec3d& shift) {
  const Transformd &a = world_from_a, &b = world_from_b;
  return {b.direction_to_b({a.row_x.x, a.row_y.x, a.row_z.x}), b.direction_to_b({a.row_x.y, a.row_y.y, a.row_z.y}),
          b.direction_to_b({a.row_x.z, a.row_y.z, a.row_z.z}),
          a.direction_to_b((b.translation - a.translation) + shift)};
}

Pose relative_pose(const Pose& world_from_a, const Pose& world_from_b) {
  return relative_pose(world_from_a.a_from_b(), world_from_b.a_from_b(), {});
}

double relative_pose_error(const Pose& world_from_a, const Pose& world_from_b, double reach_b, double ball_radius_a) {
  const Vec3d way = world_from_b.a_from_b().translation - world_from_a.a_from_b().translation;
  // No rounding is as small as that of a number that underflows.
  const double size = reach_b + norm_1(way) + 0x1p-1000;
  const double off = distance_from_rotation(world_from_a.a_from_b());
  return (48.0 * kUnitRoundoff + 3.01 * off) * size + 1.51 * off * ball_radius_a;
}

Vec3d motion_seen_from(const Transformd& world_from_a, const Vec3d& motion) {
  constexpr double kShortest = 1e-290;
  const double length = norm_1(motion);
  if (length > 0.0 && length < kShortest) {
    throw InputError("a motion is too short to be turned into another frame (" + shortest_number(length) +
                     ") - give a longer one and a shorter time");
  }
  return world_from_a.direction_to_b(motion);
}

}  // namespace vex
