#include "shapes/superellipsoid_normals.h"

#include <cmath>
#include <numbers>

#include "engine/numeric/elementary.h"

namespace vex {
namespace {

using Part = SuperellipsoidNormals::Part;

/// u^(1/e) / 2, which for e = 0 is 0.
double power_to_half(double u, double e) { return e > 0.0 ? 0.5 * std::pow(u, 1.0 / e) : 0.0; }

}  // namespace

std::vector<UnitNode> unit_nodes(double step) {
  constexpr double kLast = 3.4;
  std::vector<UnitNode> nodes;
  const int last = static_cast<int>(kLast / step);
  for (int k = -last; k <= last; ++k) {
    const double s = 0.5 * std::numbers::pi * std::sinh(k * step), cosh = std::cosh(s);
    const double weight = step * 0.25 * std::numbers::pi * std::cosh(k * step) / (cosh * cosh);
    nodes.push_back({1.0 / (1.0 + std::exp(-2.0 * s)), weight, k % 2 == 0});
  }
  return nodes;
}

bool is_round(const SuperellipsoidNormals& part) { return part.across == 2.0 && part.semi_axes.x == part.semi_axes.y; }

AcrossPlace across_place(const SuperellipsoidNormals& part, bool is_mirrored, double u) {
  // 1/p times the integral of t^(-1/2) (1-t)^(-1/2), which is pi; and (p - 1) times as much is the same.
  if (is_round(part)) return {std::sqrt(0.5), std::sqrt(0.5), std::sqrt(0.5), std::sqrt(0.5), 0.5 * std::numbers::pi};
  const double a = 1.0 / part.across;
  const bool is_curvature = part.part == Part::curvature_across;
  const double e = is_curvature ? 1.0 - a : a;  // the density is t^(e-1) (1-t)^(e-1)
  const double t = power_to_half(u, e), rest = 1.0 - t, end = std::exp2(-e);
  const double dual = is_curvature ? end * u : std::pow(t, 1.0 - a);
  const AcrossPlace place{std::pow(t, a), std::pow(rest, a), dual, std::pow(rest, 1.0 - a),
                          2.0 * end * std::pow(rest, e - 1.0)};
  return is_mirrored ? AcrossPlace{place.y, place.x, place.dual_y, place.dual_x, place.weight} : place;
}

AlongPlace along_place(const SuperellipsoidNormals& part, bool is_upper, double u) {
  const double b = 1.0 / part.along;
  if (is_upper) {  // s is above 1/2, and 1 - s a power of u
    const double e = part.part == Part::area ? 2.0 * b : 1.0;
    const double rest = power_to_half(u, e), s = 1.0 - rest;
    const double weight = part.part == Part::area               ? std::exp2(-e) * std::pow(s, b - 1.0)
                          : part.part == Part::curvature_across ? b * std::pow(s, b - 1.0)
                                                                : (1.0 - b) * std::pow(s, -b);
    return {std::pow(s, 1.0 - b), std::pow(rest, 1.0 - b), weight};
  }
  const bool is_along = part.part == Part::curvature_along;
  const double e = is_along ? 1.0 - b : b;
  const double s = power_to_half(u, e), rest = 1.0 - s, end = std::exp2(-e);
  const double weight = 2.0 * end * (part.part == Part::area ? std::pow(rest, 2.0 * b - 1.0) : 1.0);
  return {is_along ? end * u : std::pow(s, 1.0 - b), std::pow(rest, 1.0 - b), weight};
}

WeightedNormal octant_normal(const SuperellipsoidNormals& part, const AcrossPlace& across, const AlongPlace& along) {
  const auto [a, b, c] = part.semi_axes;
  const double dual_x = across.dual_x / a, dual_y = across.dual_y / b;
  const Vec3d d{along.rest * dual_x, along.rest * dual_y, along.dual_z / c};
  const double length = norm(d), weight = part.factor * across.weight * along.weight;
  const Vec3d unit_normal = (1.0 / length) * d;
  if (part.part == Part::area) return {unit_normal, 8.0 * weight * (a * b * c) * length};
  // The cross product, in units of the volume and of |d|.
  double across_sq = 0.0;
  if (part.part == Part::curvature_along) {
    const double x = dual_x / length, y = dual_y / length;
    across_sq = a * b / c * (x * x + y * y);
  } else {
    const double x = across.x * a, y = across.y * b, z = d.z / length, rest = along.rest / length;
    across_sq = c / a / b * (z * z * (x * x + y * y) + rest * rest);
  }
  return {unit_normal, 4.0 * weight * across_sq};
}

double total_weight(const SuperellipsoidNormals& part) {
  const std::vector<UnitNode> nodes = unit_nodes(1.0 / 16.0);
  std::vector<AcrossPlace> places;
  for (const UnitNode& node : nodes) {
    for (const bool is_mirrored : {false, true}) {
      places.push_back(across_place(part, is_mirrored, node.u));
      places.back().weight *= 0.5 * node.weight;
    }
  }
  double sum = 0.0;
  for (const UnitNode& node : nodes) {
    for (const bool is_upper : {false, true}) {
      AlongPlace along = along_place(part, is_upper, node.u);
      along.weight *= 0.5 * node.weight;
      for (const AcrossPlace& across : places) sum += octant_normal(part, across, along).weight;
    }
  }
  return sum;
}

WeightedNormal superellipsoid_normal(const SuperellipsoidNormals& part, double v, double w) {
  const double height = 2.0 * v - 1.0, up = std::fabs(height);
  const AlongPlace along = up < 0.5 ? along_place(part, false, 2.0 * up) : along_place(part, true, 2.0 * (1.0 - up));
  if (is_round(part)) {
    WeightedNormal at = octant_normal(part, across_place(part, false, 0.5), along);
    const SinCos<double> azimuth = sincospi(w + w);
    const double sine = std::hypot(at.unit_normal.x, at.unit_normal.y);
    at.unit_normal = {sine * azimuth.cos, sine * azimuth.sin, std::copysign(at.unit_normal.z, height)};
    return at;
  }
  const double quarters = 4.0 * w;
  const int quarter = static_cast<int>(quarters);
  const double f = quarters - quarter;
  const double from_x = quarter % 2 == 0 ? f : 1.0 - f;
  const AcrossPlace across = from_x < 0.5 ? across_place(part, true, 2.0 * from_x)  // y has the smaller part
                                          : across_place(part, false, 2.0 * (1.0 - from_x));
  WeightedNormal at = octant_normal(part, across, along);
  at.unit_normal = {quarter == 1 || quarter == 2 ? -at.unit_normal.x : at.unit_normal.x,
                    quarter >= 2 ? -at.unit_normal.y : at.unit_normal.y, std::copysign(at.unit_normal.z, height)};
  return at;
}

}  // namespace vex
