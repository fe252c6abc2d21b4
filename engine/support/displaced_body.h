// A body told in a frame with another origin, about which it is to turn.
#pragma once

#include <utility>

#include "engine/support/convex_body.h"

namespace vex {

/// The body whose points are those of another one plus a vector, each coordinate of its exact form rounded once: that
/// is then the body, exactly.
class DisplacedBody {
 public:
  DisplacedBody(ConvexBody body, const Vec3d& by)
      : body_(std::move(body)), by_(by), rounding_(2.0 * kUnitRoundoff * (body_.reach() + norm_1(by_))) {}

  Vec3d support(const Vec3d& dir) const { return body_.support(dir) + by_; }
  double support_error() const { return body_.support_error() + 2.0 * rounding_; }
  Vec3d core_support(const Vec3d& dir) const { return body_.core_support(dir) + by_; }
  double core_support_error() const { return body_.core_support_error() + 2.0 * rounding_; }
  double ball_radius() const { return body_.ball_radius(); }
  Vec3d centre() const { return body_.centre() + by_; }
  double circumradius() const { return (body_.circumradius() + 2.0 * rounding_) * (1.0 + 2.0 * kUnitRoundoff); }
  double inradius() const { return larger(0.0, body_.inradius() - 2.0 * rounding_); }
  double rolling_radius() const { return larger(0.0, body_.rolling_radius() - 2.0 * rounding_); }
  std::optional<ExactForm> exact_form() const {
    std::optional<ExactForm> form = body_.exact_form();
    if (!form) return form;
    for (Vec3d& point : form->points) point = point + by_;
    for (ExactForm::Piece& piece : form->pieces) piece.centre = piece.centre + by_;
    return form;
  }

 private:
  ConvexBody body_;
  Vec3d by_;
  double rounding_;  // of a point's coordinates, in all
};

}  // namespace vex
