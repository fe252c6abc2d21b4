#include "shapes/normal_measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/numeric/double_double.h"
#include "engine/numeric/elementary.h"
#include "engine/numeric/expect.h"
#include "shapes/superellipsoid_normals.h"

namespace vex {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3d around_z(double cos_polar, double sin_polar, double w) {
  const SinCos<double> azimuth = sincospi(w + w);
  return {sin_polar * azimuth.cos, sin_polar * azimuth.sin, cos_polar};
}

/// Uniform on the unit sphere.
Vec3d on_sphere(double v, double w) { return around_z((v + v) - 1.0, 2.0 * std::sqrt(v * (1.0 - v)), w); }

Vec3d scaled_by(const Vec3d& factors, const Vec3d& a) { return {factors.x * a.x, factors.y * a.y, factors.z * a.z}; }

struct NormalAt {
  double v, w;

  WeightedNormal operator()(const NormalAtom& atom) const { return {atom.unit_normal, atom.mass}; }
  WeightedNormal operator()(const NormalArc& arc) const {
    const SinCos<double> angle = sincospi(v * (arc.angle_rad / kPi));
    return {angle.cos * arc.unit_from + angle.sin * arc.unit_across, arc.mass};
  }
  WeightedNormal operator()(const NormalRing& ring) const {
    return {around_z(ring.cos_polar, ring.sin_polar, w), ring.mass};
  }
  WeightedNormal operator()(const NormalZone& zone) const {
    const double cos_polar = zone.cos_from + v * (zone.cos_to - zone.cos_from);
    return {around_z(cos_polar, std::sqrt((1.0 - cos_polar) * (1.0 + cos_polar)), w), zone.mass};
  }
  WeightedNormal operator()(const NormalRim& rim) const {
    const double from = rim.polar_from_rad / kPi, to = rim.polar_to_rad / kPi;
    const SinCos<double> polar = sincospi(from + v * (to - from));
    return {around_z(polar.cos, polar.sin, w), rim.mass};
  }
  WeightedNormal operator()(const NormalBelt& belt) const {
    const double turn = belt.half_angle_rad / kPi;
    const SinCos<double> polar = sincospi(0.5 + (v + v - 1.0) * turn);
    // cos t - cos a = 2 sin((a + t)/2) sin((a - t)/2), t from -a to a
    const double over_chord = 2.0 * sincospi(v * turn).sin * sincospi((1.0 - v) * turn).sin;
    return {around_z(polar.cos, polar.sin, w),
            2.0 * belt.half_angle_rad * (belt.over_chord * over_chord + belt.straight * polar.sin)};
  }
  WeightedNormal operator()(const HalfSpheroidNormals& half) const {
    const double a = half.across, c = half.along, side = half.is_upper ? 1.0 : -1.0;
    const SinCos<double> at = sincospi(0.5 * v);
    const double scale = 0.5 * kPi * half.factor * kPi * at.sin;
    if (half.is_curvature && c < a) {
      const double height = std::hypot(a * at.sin, c * at.cos), ratio = c / height;
      return {around_z(side * at.cos, at.sin, w), scale * (a / height) * a * (1.0 + ratio * ratio)};
    }
    const double length = std::hypot(c * at.sin, a * at.cos), ratio = a / length;
    return {around_z(side * a * at.cos / length, c * at.sin / length, w),
            scale * (half.is_curvature ? c * (1.0 + ratio * ratio) : 2.0 * a * length)};
  }
  WeightedNormal operator()(const SuperellipsoidNormals& part) const { return superellipsoid_normal(part, v, w); }
  WeightedNormal operator()(const EllipsoidNormals& ellipsoid) const {
    const auto [a, b, c] = ellipsoid.semi_axes;
    // det D D^-1 u; no axis divides another.
    const Vec3d dir_normal = scaled_by({b * c, c * a, a * b}, on_sphere(v, w));
    const double length = norm(dir_normal);
    return {(1.0 / length) * dir_normal, 4.0 * kPi * ellipsoid.factor * length};
  }
  WeightedNormal operator()(const EllipsoidCurvature& ellipsoid) const {
    const Vec3d axes = ellipsoid.semi_axes;
    const double longest = std::max({axes.x, axes.y, axes.z});
    const double middle = std::max(std::min(axes.x, axes.y), std::min(std::max(axes.x, axes.y), axes.z));
    const double shrink = middle / longest;
    Vec3d p{1.0, 1.0, 1.0};
    (axes.x == longest ? p.x : axes.y == longest ? p.y : p.z) = shrink;
    const double shortest = std::min({axes.x, axes.y, axes.z});
    const SinCos<double> polar = sincospi(v);
    const Vec3d about_z = around_z(polar.cos, polar.sin, w);
    const Vec3d u = axes.z == shortest   ? about_z
                    : axes.y == shortest ? Vec3d{about_z.x, about_z.z, about_z.y}
                                         : Vec3d{about_z.z, about_z.x, about_z.y};
    const Vec3d dir_normal = scaled_by(p, u);
    const double length = norm(dir_normal);
    const Vec3d unit_normal = (1.0 / length) * dir_normal;
    // Of u to uniform ones, and of uniform u to uniform normals.
    const double density_ratio = 0.5 * kPi * polar.sin * (shrink / (length * length * length));
    return {unit_normal, 2.0 * kPi * ellipsoid.factor * density_ratio * sum_of_radii_of_curvature(axes, unit_normal)};
  }
};

struct Edge {
  std::size_t i, j;
};

std::vector<Edge> closest_pairs(std::span<const Vec3d> dirs) {
  double closest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < dirs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) closest = std::max(closest, dot(dirs[i], dirs[j]));
  }
  // Of the five bodies' normals the second closest pairs are far away: this is no matter of rounding.
  const double nearly = closest - 0.01 * dot(dirs[0], dirs[0]);
  std::vector<Edge> pairs;
  for (std::size_t i = 0; i < dirs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (dot(dirs[i], dirs[j]) > nearly) pairs.push_back({i, j});
    }
  }
  return pairs;
}

Vec3d normalised(const Vec3d& a) { return (1.0 / norm(a)) * a; }

}  // namespace

void NormalMeasure::add(const NormalMeasure& other, double factor) {
  VEX_EXPECT(factor >= 0.0 && &other != this);
  components_.reserve(components_.size() + other.components_.size());
  for (Component component : other.components_) {
    if (auto* const area = std::get_if<EllipsoidNormals>(&component)) {
      area->factor *= factor;
    } else if (auto* const curvature = std::get_if<EllipsoidCurvature>(&component)) {
      curvature->factor *= factor;
    } else if (auto* const half = std::get_if<HalfSpheroidNormals>(&component)) {
      half->factor *= factor;
    } else if (auto* const part = std::get_if<SuperellipsoidNormals>(&component)) {
      part->factor *= factor;
    } else if (auto* const belt = std::get_if<NormalBelt>(&component)) {
      belt->over_chord *= factor;
      belt->straight *= factor;
    }
    std::visit([factor](auto& c) { c.mass *= factor; }, component);
    components_.push_back(component);
  }
}

double NormalMeasure::total_mass() const {
  DoubleDouble sum;
  for (const Component& component : components_) sum += mass_of(component);
  return sum.value();
}

double sum_of_radii_of_curvature(const Vec3d& semi_axes, const Vec3d& n) {
  const auto [a, b, c] = semi_axes;
  const double height = norm(scaled_by(semi_axes, n));
  const double ab = a * b, ac = a * c, bc = b * c;
  const double sum =
      ab * ab * (n.x * n.x + n.y * n.y) + ac * ac * (n.x * n.x + n.z * n.z) + bc * bc * (n.y * n.y + n.z * n.z);
  return sum / (height * height * height);
}

bool is_alike_about_z(const NormalMeasure::Component& component) {
  if (const auto* const part = std::get_if<SuperellipsoidNormals>(&component)) return is_round(*part);
  return std::holds_alternative<NormalRing>(component) || std::holds_alternative<NormalZone>(component) ||
         std::holds_alternative<NormalRim>(component) || std::holds_alternative<NormalBelt>(component) ||
         std::holds_alternative<HalfSpheroidNormals>(component);
}

double mass_of(const NormalMeasure::Component& component) {
  return std::visit([](const auto& c) { return c.mass; }, component);
}

WeightedNormal normal_at(const NormalMeasure::Component& component, double v, double w) {
  return std::visit(NormalAt{v, w}, component);
}

CoordinatesUsed coordinates_used(const NormalMeasure::Component& component) {
  if (std::holds_alternative<NormalAtom>(component)) return {false, false};
  return {!std::holds_alternative<NormalRing>(component), !std::holds_alternative<NormalArc>(component)};
}

NormalMeasure uniform_normals(double mass) {
  NormalMeasure uniform;
  uniform.add(NormalZone{-1.0, 1.0, mass});
  return uniform;
}

NormalMeasure regular_polyhedron_area(std::span<const Vec3d> dir_normals, const Measures& measures) {
  NormalMeasure area;
  for (const Vec3d& dir : dir_normals) {
    area.add(NormalAtom{normalised(dir), measures.surface_area / static_cast<double>(dir_normals.size())});
  }
  return area;
}

NormalMeasure regular_polyhedron_mean_curvature(std::span<const Vec3d> dir_normals, const Measures& measures) {
  NormalMeasure curvature;
  const std::vector<Edge> edges = closest_pairs(dir_normals);
  for (const auto [i, j] : edges) {
    const Vec3d from = normalised(dir_normals[i]), to = normalised(dir_normals[j]);
    const Vec3d axis = cross(from, to);
    curvature.add(NormalArc{from, normalised(cross(axis, from)), std::atan2(norm(axis), dot(from, to)),
                            measures.integrated_mean_curvature / static_cast<double>(edges.size())});
  }
  return curvature;
}

}  // namespace vex
