// A point as a body: what a ray starts from, and what nearness of a point is asked of.
#pragma once

#include <optional>

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

}  // namespace vex
