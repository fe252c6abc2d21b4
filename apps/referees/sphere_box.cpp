#include "apps/referees/sphere_box.h"

#include <algorithm>
#include <cmath>

#include "engine/numeric/rounding.h"

namespace vex {
namespace {

Vec3d clamped(const Vec3d& p, const Vec3d& half) {
  return {std::clamp(p.x, -half.x, half.x), std::clamp(p.y, -half.y, half.y), std::clamp(p.z, -half.z, half.z)};
}

}  // namespace

Outcome box_and_sphere_overlap(const Box& a, double radius, const Transformd& a_from_b) {
  const Vec3d& t = a_from_b.translation;
  const double distance = norm(t - clamped(t, 0.5 * a.edges()));
  const double error = 8.0 * kUnitRoundoff * (distance + radius);
  if (distance > radius + error) return Outcome::disjoint;
  return distance < radius - error ? Outcome::overlap : Outcome::undecided;
}

Outcome sphere_and_box_overlap(double radius, const Box& b, const Transformd& a_from_b) {
  const Vec3d half = 0.5 * b.edges();
  const double reach = (2.0 * b.circumradius() + norm_1(a_from_b.translation)) + radius;
  const Vec3d centre_in_b = -a_from_b.direction_to_b(a_from_b.translation);
  Vec3d nearest = clamped(centre_in_b, half);

  // R^T for R^-1: off by no more than 1e-6 of the lengths, R being a rotation to within that.
  const double rough = norm(centre_in_b - nearest), band = 1e-5 * reach;
  if (rough > radius + band) return Outcome::disjoint;
  if (rough < radius - band) return Outcome::overlap;

  // Near contact: projected descent, whose every step takes away all but 1e-6 of the error, and a proof either way.
  const double error = 24.0 * kUnitRoundoff * reach;
  for (int step = 0; step < 3; ++step) {
    nearest = clamped(nearest - a_from_b.direction_to_b(a_from_b(nearest)), half);
  }
  const Vec3d witness = a_from_b(nearest);
  if (norm(witness) <= radius - error) return Outcome::overlap;
  // The witness is a normal of the box there; what rounding left of it along an edge that the nearest point is inside
  // of would count with the edge's length, so it is taken away.
  Vec3d dir = witness;
  const Vec3d columns[3] = {{a_from_b.row_x.x, a_from_b.row_y.x, a_from_b.row_z.x},
                            {a_from_b.row_x.y, a_from_b.row_y.y, a_from_b.row_z.y},
                            {a_from_b.row_x.z, a_from_b.row_y.z, a_from_b.row_z.z}};
  const double at[3] = {nearest.x, nearest.y, nearest.z}, end[3] = {half.x, half.y, half.z};
  for (int pass = 0; pass < 3; ++pass) {
    for (int k = 0; k < 3; ++k) {
      if (std::fabs(at[k]) < end[k]) dir = dir - (dot(dir, columns[k]) / dot(columns[k], columns[k])) * columns[k];
    }
  }
  for (const Vec3d& d : {dir, witness}) {
    double gap = dot(d, a_from_b.translation);
    for (int k = 0; k < 3; ++k) gap -= end[k] * std::fabs(dot(d, columns[k]));
    if (gap - radius * norm(d) > error * norm_1(d)) return Outcome::disjoint;
  }
  return Outcome::undecided;
}

}  // namespace vex
