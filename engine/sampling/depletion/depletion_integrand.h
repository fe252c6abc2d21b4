// The integrand whose mean is the overlap of two bodies' depletion shells: their sums with a ball.
#pragma once

#include <vector>

#include "engine/numeric/transform.h"
#include "engine/query/verdict.h"
#include "engine/sampling/integrand.h"
#include "engine/sampling/poses/orientation_law.h"
#include "engine/support/convex_body.h"

namespace vex {

/// A box along A's axes; empty where a width is not above 0.
struct OverlapBox {
  Vec3d low, width;
  bool is_empty() const { return !(width.x > 0.0 && width.y > 0.0 && width.z > 0.0); }
  double volume() const { return width.x * width.y * width.z; }
};

/// Around what both bodies with a ball of this radius about each point have in common, a little wider than it.
OverlapBox box_around_overlap(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b, double ball_radius);

/// The proven verdict on the bodies themselves.
Outcome outcome_at(const ConvexBody& a, const ConvexBody& b, const Transformd& a_from_b);

/// Values are the box's volume or 0 (the overlap volume), or 1 and 0 (whether the bodies are apart). `ball`: about its
/// own origin.
class DepletionIntegrand final : public Integrand {
 public:
  enum class What { overlap_volume, freedom };

  /// At one pose, bodies apart or not.
  DepletionIntegrand(const ConvexBody& a, const ConvexBody& b, const ConvexBody& ball, const Transformd& pose);
  /// Over directions from A's origin to B's and orientations; volumes where the bodies are apart, and 0 where not.
  DepletionIntegrand(const ConvexBody& a, const ConvexBody& b, const ConvexBody& ball, double distance,
                     const OrientationLaw& law, What what);

  int dimension() const override;
  double scale() const override;
  double relative_rounding() const override { return 0x1p-46; }  // of a box's volume
  /// A point is off by less than 8 u of the pair's reach where it is put into B's frame: a skin of the overlap as
  /// thick.
  double absolute_rounding() const override;
  double cost() const override { return 800.0; }

  Doubts evaluate(std::span<const double> points, std::span<double> values) override;

 private:
  double value_at(double* half_width);

  ConvexBody a_, b_, ball_;
  What what_ = What::overlap_volume;
  bool is_average_ = false;
  Transformd pose_;
  double distance_ = 0.0;
  OrientationLaw law_;
  std::vector<double> point_;
};

}  // namespace vex
