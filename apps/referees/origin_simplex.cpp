#include "apps/referees/origin_simplex.h"

#include <algorithm>

namespace vex::exact {

bool OriginSimplex::reduce(Vec3dd& nearest_point) {
  if (points.size() == 4 && holds_origin()) return false;
  best_ = {};
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    offer(at(i), 1u << i);
    for (std::size_t j = i + 1; j < n; ++j) {
      offer_edge(i, j);
      for (std::size_t k = j + 1; k < n; ++k) offer_triangle(i, j, k);
    }
  }
  std::vector<DifferencePoint> kept;
  for (std::size_t i = 0; i < n; ++i) {
    if ((best_.carriers >> i) & 1u) kept.push_back(points[i]);
  }
  points = std::move(kept);
  nearest_point = best_.point;
  return true;
}

bool OriginSimplex::holds_origin() const {
  const Vec3dd &a = at(0), &b = at(1), &c = at(2), &d = at(3);
  const double whole = determinant_of(b - a, c - a, d - a).value();
  if (whole == 0.0) return false;
  const double sign = whole > 0.0 ? 1.0 : -1.0;
  return sign * determinant_of(b, c, d).value() >= 0.0 && sign * determinant_of(a, d, c).value() >= 0.0 &&
         sign * determinant_of(a, b, d).value() >= 0.0 && sign * determinant_of(a, c, b).value() >= 0.0;
}

void OriginSimplex::offer(const Vec3dd& point, unsigned carriers) {
  const DoubleDouble distance_sq = dot(point, point);
  if ((distance_sq - best_.distance_sq).value() < 0.0 || best_.carriers == 0) {
    best_ = {point, carriers, distance_sq};
  }
}

void OriginSimplex::offer_edge(std::size_t i, std::size_t j) {
  const Vec3dd along = at(j) - at(i);
  const DoubleDouble length_sq = dot(along, along);
  if (!(length_sq.high > 0.0)) return;
  const DoubleDouble s = -dot(at(i), along) / length_sq;
  if (!(s.high > 0.0) || !(s.high < 1.0)) return;
  offer(at(i) + s * along, (1u << i) | (1u << j));
}

void OriginSimplex::offer_triangle(std::size_t i, std::size_t j, std::size_t k) {
  const Vec3dd normal = cross(at(j) - at(i), at(k) - at(i));
  const DoubleDouble normal_sq = dot(normal, normal);
  if (!(normal_sq.high > 0.0)) return;
  if (!(determinant_of(normal, at(j), at(k)).value() > 0.0)) return;
  if (!(determinant_of(normal, at(k), at(i)).value() > 0.0)) return;
  if (!(determinant_of(normal, at(i), at(j)).value() > 0.0)) return;
  const DoubleDouble s = dot(at(i), normal) / normal_sq;
  offer(s * normal, (1u << i) | (1u << j) | (1u << k));
}

bool has_point(const OriginSimplex& simplex, const DifferencePoint& point) {
  return std::ranges::any_of(simplex.points, [&point](const DifferencePoint& p) {
    const Vec3dd d = p.approximately - point.approximately;
    return d.x.value() == 0.0 && d.y.value() == 0.0 && d.z.value() == 0.0;
  });
}

}  // namespace vex::exact
