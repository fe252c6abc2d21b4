#include "engine/sampling/radial_map.h"

namespace vex {
namespace {

/// Evenly spread points of the sphere, point by point on a spiral, and their opposites (E. B. Saff, A. B. J. Kuijlaars,
/// Math. Intelligencer 19, 5, 1997, with the golden angle).
std::array<Vec3d, 48> spread_directions() {
  constexpr double kGoldenTurn = 0.38196601125010515;
  std::array<Vec3d, 48> directions;
  double turn = 0.0;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double z = (static_cast<double>(k) + 0.5) / static_cast<double>(directions.size());
    const SinCos<double> azimuth = sincospi(2.0 * turn);
    const double across = square_root(1.0 - z * z);
    directions[k] = {across * azimuth.cos, across * azimuth.sin, z};
    turn += kGoldenTurn;
    if (turn >= 1.0) turn -= 1.0;
  }
  return directions;
}

}  // namespace

MatchingEllipsoid matching_ellipsoid(const ConvexBody& body) {
  constexpr int kRounds = 6;
  const std::array<Vec3d, 48> directions = spread_directions();
  // Lengths are told in circumradii, from the body's centre: their squares may not over- or underflow.
  const double unit = body.circumradius();
  const Vec3d origin = body.centre();
  if (!(unit > 0.0)) return {origin, {}};  // a point
  const auto support = [&](const Vec3d& dir) { return (1.0 / unit) * (body.support(dir) - origin); };
  Symmetric<double> q{1.0, 1.0, 1.0};
  Vec3d centre;
  for (int round = 0; round < kRounds; ++round) {
    const Triangular<double> factor = factor_of(q);
    Symmetric<double> sum;
    Vec3d mean;
    for (const Vec3d& e : directions) {
      const Vec3d dir = scaled_to_unit_exponent(factor.normal(e));
      const Vec3d there = support(dir), back = support(-dir);
      for (const Vec3d& point : {there, back}) {
        const Vec3d s = point - centre;
        sum.xx += s.x * s.x;
        sum.yy += s.y * s.y;
        sum.zz += s.z * s.z;
        sum.xy += s.x * s.y;
        sum.xz += s.x * s.z;
        sum.yz += s.y * s.z;
      }
      mean = mean + 0.5 * (there + back);  // exactly nothing for a body that is its own mirror image
    }
    // Half of the way: the whole of it would overshoot for smooth bodies, whose points move with the directions.
    const double kept = round == 0 ? 0.0 : 0.5;
    const double taken = (1.0 - kept) * 3.0 / static_cast<double>(2 * directions.size());
    q = {kept * q.xx + taken * sum.xx, kept * q.yy + taken * sum.yy, kept * q.zz + taken * sum.zz,
         kept * q.xy + taken * sum.xy, kept * q.xz + taken * sum.xz, kept * q.yz + taken * sum.yz};
    centre = (1.0 / static_cast<double>(directions.size())) * mean;
  }
  const double area = unit * unit;
  return {origin + unit * centre, {area * q.xx, area * q.yy, area * q.zz, area * q.xy, area * q.xz, area * q.yz}};
}

}  // namespace vex
