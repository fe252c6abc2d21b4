#include "engine/query/checker/witness_proof.h"

#include <algorithm>
#include <cstdlib>

#include "engine/query/checker/exact_hull.h"

namespace vex::checker {
namespace {

using whole::Dyadic;
using whole::DyadicVector;

bool is_near(std::vector<DyadicVector> points, const DyadicVector& to, const Dyadic& distance) {
  for (DyadicVector& p : points) p = p - to;
  return comes_within(points, distance);
}

}  // namespace

bool are_finite(const std::vector<Witness>& witnesses) {
  return std::ranges::all_of(witnesses, [](const Witness& witness) { return vex::is_finite(witness); });
}

// The numbers that whole numbers make of an exponent grow with it.
bool is_finite(const ExactVector& vector) {
  constexpr int kMostExponent = 1 << 16;
  return std::ranges::all_of(vector.parts, [](const ExactVector::Part& part) {
    return vex::is_finite(part.value) && std::abs(part.exponent) <= kMostExponent;
  });
}

bool is_apart_by(const ExactPair& pair, const ExactVector& vector, const Dyadic& distance) {
  if (!is_finite(vector)) return false;
  const DyadicVector dir = exactly(vector);
  const Dyadic dir_sq = dot(dir, dir);
  return whole::sign(dir_sq) > 0 && is_at_least(pair.gap_of_cores(dir), distance + pair.radii(), dir_sq);
}

bool comes_as_near_as(const std::vector<DyadicVector>& core_points, std::span<const std::array<std::uint32_t, 3>> faces,
                      const Dyadic& radii, const Dyadic& margin, const Dyadic& distance) {
  const Dyadic near = distance + radii - margin;  // of the points as they are computed
  if (faces.empty()) return whole::sign(near) >= 0 && comes_within(core_points, near);
  return surrounds_ball(core_points, faces, whole::sign(near) >= 0 ? Dyadic() : -near);
}

bool comes_as_near_as(const ExactPair& pair, const WitnessHull& hull, const Dyadic& distance) {
  if (hull.witnesses.empty() || !are_finite(hull.witnesses)) return false;
  std::vector<DyadicVector> points;
  for (const Witness& witness : hull.witnesses) points.push_back(pair.core_point(witness));
  return comes_as_near_as(points, hull.faces, pair.radii(), pair.margin(), distance);
}

bool is_near_a(const ExactPair& pair, const std::vector<Witness>& witnesses, const DyadicVector& point,
               const Dyadic& distance) {
  if (!are_finite(witnesses)) return false;
  std::vector<DyadicVector> points;
  for (const Witness& witness : witnesses) points.push_back(pair.point_of_a(witness));
  return is_near(std::move(points), point, distance + Dyadic(pair.a().ball_radius) - pair.margin());
}

bool is_near_b(const ExactPair& pair, const std::vector<Witness>& witnesses, const DyadicVector& point,
               const Dyadic& distance) {
  if (!are_finite(witnesses)) return false;
  std::vector<DyadicVector> points;
  for (const Witness& witness : witnesses) points.push_back(pair.point_of_b(witness));
  return is_near(std::move(points), point, distance + Dyadic(pair.b().ball_radius) - pair.margin());
}

}  // namespace vex::checker
