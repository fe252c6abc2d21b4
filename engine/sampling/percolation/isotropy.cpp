#include "engine/sampling/percolation/isotropy.h"

#include <algorithm>
#include <cmath>

namespace vex {
namespace {

// Of the Minkowski difference of two bodies, about their centres: two placed bodies meet where one's centre is in it.
double difference_support(const ConvexBody& a, const ConvexBody& b, const Vec3d& dir) {
  return dot(dir, a.support(dir) - a.centre()) + dot(-dir, b.support(-dir) - b.centre());
}

// The rotations that take x to y to z to x, and x to x, y to -y, z to -z: what is invariant under both has the second
// moments of a ball.
Vec3d in_turn(const Vec3d& v) { return {v.z, v.x, v.y}; }
Vec3d half_turn(const Vec3d& v) { return {v.x, -v.y, -v.z}; }

bool is_cubic(const ConvexBody& a, const ConvexBody& b) {
  constexpr int kDirections = 600;
  constexpr double kTolerance = 1e-9, kGoldenAngle = 2.399963229728653;
  const double tolerance = kTolerance * (a.circumradius() + b.circumradius());
  for (int k = 0; k < kDirections; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / kDirections, r = std::sqrt(1.0 - z * z);
    const Vec3d dir{r * std::cos(kGoldenAngle * k), r * std::sin(kGoldenAngle * k), z};
    const double along = difference_support(a, b, dir);
    if (std::fabs(difference_support(a, b, in_turn(dir)) - along) > tolerance) return false;
    if (std::fabs(difference_support(a, b, half_turn(dir)) - along) > tolerance) return false;
  }
  return true;
}

}  // namespace

bool is_isotropic(const Placements& placements) {
  const std::vector<BodyPart>& parts = placements.parts();
  const bool are_balls =
      std::ranges::all_of(parts, [](const BodyPart& part) { return part.body.inradius() >= part.body.circumradius(); });
  if (are_balls) return true;
  const BodyOrientations& orientations = placements.orientations();
  if (orientations.uniform_polar_angle) return false;
  const OrientationLaw& law = orientations.law;
  switch (law.kind()) {
    case OrientationLaw::Kind::isotropic: return true;
    case OrientationLaw::Kind::cone: return law.parameter() == 90.0;
    case OrientationLaw::Kind::onsager: return law.parameter() == 0.0;
    case OrientationLaw::Kind::maier_saupe: return law.parameter() == 0.0;
    case OrientationLaw::Kind::aligned: break;
    case OrientationLaw::Kind::table:  // even where it is constant: then the fit is merely more careful
    case OrientationLaw::Kind::each:
    case OrientationLaw::Kind::fixed:
    case OrientationLaw::Kind::angle: return false;
  }
  for (const BodyPart& a : parts) {
    for (const BodyPart& b : parts) {
      if (!is_cubic(a.body, b.body)) return false;
    }
  }
  return true;
}

}  // namespace vex
