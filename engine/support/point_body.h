// A point as a body: what a ray starts from, and what nearness of a point is asked of.
#pragma once

#include <optional>

#include "engine/numeric/transform.h"
#include "engine/support/convex_body.h"

namespace vex {

struct PointBody {
  Vec3d at{};

  template <class L>
  Vec3<L> support(const Vec3<L>& /*dir*/) const {
    return broadcast<L>(at);
  }
  double support_error() const { return 0.0; }
  Vec3d centre() const { return at; }
  double circumradius() const { return 0.0; }
  double inradius() const { return 0.0; }
  std::optional<ExactForm> exact_form() const { return ExactForm{{at}, {}, 0.0}; }
  Generators generators() const {
    Generators none;
    none.centre = at;
    return none;
  }
};

/// What moves along a ray, and where it is at first.
inline const ConvexBody& point_of_ray() {
  static const ConvexBody point = PointBody{};
  return point;
}
inline Transformd start_of_ray(const Vec3d& origin) {
  Transformd pose;
  pose.translation = origin;
  return pose;
}

}  // namespace vex
