#include "engine/numeric/pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/numeric/number_text.h"

namespace vex {
namespace {

bool mirrors(const Transformd& pose) { return dot(cross(pose.row_x, pose.row_y), pose.row_z) < 0.0; }

}  // namespace

double distance_from_rotation(const Transformd& pose) {
  const std::array<Vec3d, 3> columns = {{{pose.row_x.x, pose.row_y.x, pose.row_z.x},
                                         {pose.row_x.y, pose.row_y.y, pose.row_z.y},
                                         {pose.row_x.z, pose.row_y.z, pose.row_z.z}}};
  double largest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      const double off = std::fabs(dot(columns[i], columns[j]) - (i == j ? 1.0 : 0.0));
      if (!std::isfinite(off)) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, off);
    }
  }
  return largest;
}

bool is_rotation(const Transformd& pose) {
  return distance_from_rotation(pose) <= Pose::kRotationTolerance && !mirrors(pose);
}

void Pose::check() const {
  const double off = distance_from_rotation(a_from_b_);
  if (!(off <= kRotationTolerance)) {
    throw InputError("not a rotation (max|R^T R - 1| = " + shortest_number(off) + ", and " +
                     shortest_number(kRotationTolerance) + " is allowed) - give more digits, or a quaternion");
  }
  if (mirrors(a_from_b_)) {
    throw InputError("a reflection is no pose (the determinant of R is negative) - mirror the body instead");
  }
  if (!is_finite(a_from_b_.translation)) {
    throw InputError("a pose's translation is not finite - give finite numbers");
  }
}

}  // namespace vex
