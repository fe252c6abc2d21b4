// Support values of a body about its centre, many directions at a time: all that estimators ask of a body besides its
// measures.
#pragma once

#include <cstddef>

#include "engine/numeric/rounding.h"
#include "engine/sampling/trial_cost.h"
#include "engine/support/convex_body.h"
#include "shapes/rounded.h"

namespace vex {

/// A body is its core with a ball: h of the body is that of the core, and the ball's radius, for unit directions. About
/// the centre, which changes no mixed volume: every value is positive, and noise is as small as the body.
class CoreHeights {
 public:
  explicit CoreHeights(const ConvexBody& body) : core_(body), centre_(body.centre()) {
    // To the inmost body: each ball on the way would be an indirect call.
    while (const auto* const rounded = core_.target<Rounded<ConvexBody>>()) {
      ball_radius_ += rounded->radius();
      core_ = ConvexBody(rounded->body());
    }
    has_ball_ = core_.ball_radius() > 0.0;
    ball_radius_ += core_.ball_radius();
  }

  double ball_radius() const { return ball_radius_; }
  /// Of a height, about, in nanoseconds (trial_cost.h).
  double price() const { return support_price(core_); }

  /// Of the core, for d and for -d.
  void of_pairs(const ConvexBody::Columns& dirs, std::size_t n, double* along, double* against) const {
    if (has_ball_) {
      for (std::size_t i = 0; i < n; ++i) {
        const Vec3d dir{dirs.x[i], dirs.y[i], dirs.z[i]};
        along[i] = of_core(dir);
        against[i] = of_core(-dir);
      }
      return;
    }
    core_.heights(dirs, n, along, against);
    for (std::size_t i = 0; i < n; ++i) {
      const double offset = dot({dirs.x[i], dirs.y[i], dirs.z[i]}, centre_);
      along[i] -= offset;
      against[i] += offset;
    }
  }
  /// For d alone.
  double operator()(const Vec3d& dir) const {
    return has_ball_ ? of_core(dir) : dot(dir, core_.support(dir) - centre_);
  }

  /// What a value of the core is off by for a unit direction. Three products, two sums, and the centre's.
  double error() const { return core_.core_support_error() + gamma(16) * core_.reach(); }

 private:
  double of_core(const Vec3d& dir) const { return dot(dir, core_.core_support(dir) - centre_); }

  ConvexBody core_;
  Vec3d centre_;
  double ball_radius_ = 0.0;
  bool has_ball_ = false;
};

}  // namespace vex
