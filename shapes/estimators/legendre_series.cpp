#include "shapes/estimators/legendre_series.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <variant>

#include "engine/numeric/errors.h"
#include "shapes/estimators/superellipsoid_series.h"
#include "shapes/rounded.h"

namespace vex {
namespace {

using std::numbers::pi;
using Series = LegendreSeries;

constexpr std::size_t kMostVertices = 20000;   // of a mesh: its measures are not even asked for
constexpr double kMostSteps = 4e8;             // of the polynomials' recursion, about a nanosecond each
constexpr double kLargestAspectRatio = 100.0;  // of ellipsoids: the nodes they take grow with its square

std::size_t panels_for(double angle_rad, std::size_t n_degrees) {
  return static_cast<std::size_t>(angle_rad * static_cast<double>(n_degrees) / 40.0) + 1;
}

constexpr Vec3d kZ{0.0, 0.0, 1.0};

double along(const Vec3d& unit_normal, const Vec3d& axis) { return std::clamp(dot(unit_normal, axis), -1.0, 1.0); }

/// The same for the mean of weight(v) P_l(n(v) . axis) over 0 < v < 1, where n turns through `angle_rad`: 30 nodes for
/// each 40 radians of phase of the highest degree.
template <class F>
void add_mean(double angle_rad, std::size_t least_panels, const F& normal_of, const Vec3d& axis, Series* sum) {
  using Gauss = boost::math::quadrature::gauss<double, 30>;
  const std::size_t n_panels = std::max(panels_for(angle_rad, sum->size()), least_panels);
  const double half_width = 0.5 / static_cast<double>(n_panels);
  for (std::size_t panel = 0; panel < n_panels; ++panel) {
    const double middle = (2.0 * static_cast<double>(panel) + 1.0) * half_width;
    for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
      for (const double side : {-1.0, 1.0}) {
        const WeightedNormal at = normal_of(middle + side * half_width * Gauss::abscissa()[i]);
        add_polynomials(half_width * Gauss::weights()[i] * at.weight, along(at.unit_normal, axis), sum);
      }
    }
  }
}

double aspect_ratio(const Vec3d& axes) {
  return std::max({axes.x, axes.y, axes.z}) / std::min({axes.x, axes.y, axes.z});
}

Vec3d uniform_normal(double v, double w) {
  const double cos_polar = (v + v) - 1.0, sin_polar = 2.0 * std::sqrt(v * (1.0 - v)), azimuth = 2.0 * pi * w;
  return {sin_polar * std::cos(azimuth), sin_polar * std::sin(azimuth), cos_polar};
}

/// The density of an ellipsoid's area over uniform normals, of mean S: 4 pi over the Gaussian curvature, (a b c)^2 /
/// h^4.
struct GaussianCurvature {
  Vec3d axes;

  double operator()(double v, double w) const {
    const Vec3d n = uniform_normal(v, w);
    const double height = norm(Vec3d{axes.x * n.x, axes.y * n.y, axes.z * n.z});
    const double root = axes.x / height * (axes.y / height) * axes.z;
    return 4.0 * pi * root * root;
  }
};

/// A density over uniform normals (v, w), even in each coordinate of the normal. Its peaks are as wide as the aspect
/// ratio is small, which says how many nodes it takes: a quarter of a turn about z by the midpoint rule, which is
/// spectral for periodic functions, and panels along the polar angle t, with v = (1 - cos t) / 2.
template <class F>
void add_ellipsoid(const Vec3d& axes, double factor, const F& density, Series* sum) {
  const double ratio = aspect_ratio(axes);
  const int n_angles = axes.x == axes.y ? 1 : 16 + static_cast<int>(8.0 * ratio);
  add_mean(
      pi, static_cast<std::size_t>(2.0 * ratio),
      [&](double t) -> WeightedNormal {
        const double v = std::pow(std::sin(0.5 * pi * t), 2);
        double mean = 0.0;
        for (int i = 0; i < n_angles; ++i) mean += density(v, 0.25 * (i + 0.5) / n_angles) / n_angles;
        return {{0.0, 0.0, -std::cos(pi * t)}, factor * mean * 0.5 * pi * std::sin(pi * t)};
      },
      kZ, sum);
}

/// The semi-axes in a frame whose z axis is this one of the ellipsoid's own, from which side matters not; nothing where
/// it is askew.
std::optional<Vec3d> semi_axes_about(const Vec3d& axes, const Vec3d& unit_axis) {
  const bool x = unit_axis.x != 0.0, y = unit_axis.y != 0.0, z = unit_axis.z != 0.0;
  if (z && !x && !y) return axes;
  if (x && !y && !z) return Vec3d{axes.y, axes.z, axes.x};
  if (y && !x && !z) return Vec3d{axes.z, axes.x, axes.y};
  return std::nullopt;
}

/// Of an ellipsoid's part, or null.
const Vec3d* semi_axes_of(const NormalMeasure::Component& component) {
  if (const auto* const area = std::get_if<EllipsoidNormals>(&component)) return &area->semi_axes;
  if (const auto* const curvature = std::get_if<EllipsoidCurvature>(&component)) return &curvature->semi_axes;
  return nullptr;
}

bool turns_about_z(const NormalMeasure::Component& component) {
  const Vec3d* const axes = semi_axes_of(component);
  return axes != nullptr ? axes->x == axes->y : is_alike_about_z(component);
}

/// In steps of the polynomials' recursion.
double cost_of_series(const NormalMeasure& measure, std::size_t max_degree) {
  const std::size_t n_degrees = max_degree + 1;
  std::size_t n_nodes = 0;
  for (const NormalMeasure::Component& component : measure.components()) {
    double angle_rad = 0.0;
    if (const auto* const arc = std::get_if<NormalArc>(&component)) {
      angle_rad = arc->angle_rad;
    } else if (const auto* const rim = std::get_if<NormalRim>(&component)) {
      angle_rad = rim->polar_to_rad - rim->polar_from_rad;
    } else if (const auto* const belt = std::get_if<NormalBelt>(&component)) {
      angle_rad = 2.0 * belt->half_angle_rad;
    } else {
      ++n_nodes;
      continue;
    }
    n_nodes += 30 * panels_for(angle_rad, n_degrees);
  }
  return static_cast<double>(n_nodes) * static_cast<double>(n_degrees);
}

bool is_affordable(const NormalMeasure& measure) {
  const auto is_too_thin = [](const NormalMeasure::Component& component) {
    if (const auto* const half = std::get_if<HalfSpheroidNormals>(&component)) {
      return aspect_ratio({half->across, half->across, half->along}) > kLargestAspectRatio;
    }
    const auto* const area = std::get_if<EllipsoidNormals>(&component);
    return area != nullptr && aspect_ratio(area->semi_axes) > kLargestAspectRatio;
  };
  return std::ranges::none_of(measure.components(), is_too_thin);
}

std::size_t n_core_vertices(ConvexBody body) {
  while (const auto* const rounded = body.target<Rounded<ConvexBody>>()) body = ConvexBody(rounded->body());
  return vertices_of(body).size();
}

}  // namespace

void add_polynomials(double weight, double x, LegendreSeries* sum) {
  double before = 0.0, now = 1.0;
  for (std::size_t l = 0; l < sum->size(); ++l) {
    (*sum)[l] += weight * now;
    const auto n = static_cast<double>(l);
    const double next = ((2.0 * n + 1.0) * x * now - n * before) / (n + 1.0);
    before = now;
    now = next;
  }
}

bool have_series_about(const AxialMeasures& body, const Vec3d& unit_axis) {
  const auto has_series = [&](const NormalMeasure::Component& component) {
    const Vec3d* const axes = semi_axes_of(component);
    return axes == nullptr || turns_about_z(component) || semi_axes_about(*axes, unit_axis).has_value();
  };
  return std::ranges::all_of(body.area.components(), has_series) &&
         std::ranges::all_of(body.mean_curvature.components(), has_series);
}

// What is alike about z has, about an axis at the angle t to it, P_l(cos t) times its integrals about z: the mean of
// P_l(n . axis) over all turns about z is P_l(n_z) P_l(cos t), by the addition theorem.
std::optional<LegendreSeries> legendre_series(const NormalMeasure& measure, std::size_t max_degree,
                                              const Vec3d& unit_axis) {
  const bool is_about_z = unit_axis.z == 1.0;
  Series all(max_degree + 1, 0.0), alike_about_z(is_about_z ? 0 : max_degree + 1, 0.0);
  for (const NormalMeasure::Component& component : measure.components()) {
    if (!(mass_of(component) > 0.0)) continue;
    const bool is_alike = turns_about_z(component);
    Series& sum = is_alike && !is_about_z ? alike_about_z : all;
    const Vec3d& axis = is_alike ? kZ : unit_axis;
    const auto at = [&](double v) { return normal_at(component, v, 0.5); };
    if (const auto* const zone = std::get_if<NormalZone>(&component)) {
      // The integral of P_l is (P_(l+1) - P_(l-1)) / (2 l + 1).
      Series upper(max_degree + 2, 0.0), lower(max_degree + 2, 0.0);
      add_polynomials(1.0, zone->cos_to, &upper);
      add_polynomials(1.0, zone->cos_from, &lower);
      sum[0] += zone->mass;
      for (std::size_t l = 1; l <= max_degree; ++l) {
        const double integral = (upper[l + 1] - upper[l - 1]) - (lower[l + 1] - lower[l - 1]);
        sum[l] += zone->mass * integral / (static_cast<double>(2 * l + 1) * (zone->cos_to - zone->cos_from));
      }
    } else if (const auto* const arc = std::get_if<NormalArc>(&component)) {
      add_mean(arc->angle_rad, 1, at, axis, &sum);
    } else if (const auto* const rim = std::get_if<NormalRim>(&component)) {
      add_mean(rim->polar_to_rad - rim->polar_from_rad, 1, at, axis, &sum);
    } else if (const auto* const belt = std::get_if<NormalBelt>(&component)) {
      add_mean(2.0 * belt->half_angle_rad, 1, at, axis, &sum);
    } else if (const auto* const half = std::get_if<HalfSpheroidNormals>(&component)) {
      const double ratio = aspect_ratio({half->across, half->across, half->along});
      add_mean(0.5 * pi, static_cast<std::size_t>(2.0 * ratio), at, axis, &sum);
    } else if (const auto* const part = std::get_if<SuperellipsoidNormals>(&component)) {
      const std::optional<Series> series = superellipsoid_series(*part, max_degree, axis);
      if (!series) return std::nullopt;
      for (std::size_t l = 0; l <= max_degree; ++l) sum[l] += (*series)[l];
    } else if (std::holds_alternative<NormalAtom>(component) || std::holds_alternative<NormalRing>(component)) {
      add_polynomials(mass_of(component), along(at(0.5).unit_normal, axis), &sum);
    } else if (const auto* const area = std::get_if<EllipsoidNormals>(&component)) {
      const Vec3d axes = semi_axes_about(area->semi_axes, axis).value();
      add_ellipsoid(axes, area->factor, GaussianCurvature{axes}, &sum);
    } else if (const auto* const curvature = std::get_if<EllipsoidCurvature>(&component)) {
      const Vec3d axes = semi_axes_about(curvature->semi_axes, axis).value();
      add_ellipsoid(
          axes, curvature->factor,
          [&](double v, double w) { return 2.0 * pi * sum_of_radii_of_curvature(axes, uniform_normal(v, w)); }, &sum);
    }
  }
  if (is_about_z) return all;
  Series of_axis(max_degree + 1, 0.0);
  add_polynomials(1.0, std::clamp(unit_axis.z, -1.0, 1.0), &of_axis);
  for (std::size_t l = 0; l <= max_degree; ++l) all[l] += of_axis[l] * alike_about_z[l];
  return all;
}

std::optional<AxialMeasures> axial_measures(const Body& body) {
  if (!body.normals.area || !body.normals.mean_curvature) {
    throw UsageError("a body without its measures on normals (" + body.kind + ") - the series needs them");
  }
  // A large mesh's measures are not even asked for.
  if (n_core_vertices(body.body) > kMostVertices) return std::nullopt;
  AxialMeasures measures{body.normals.area(), body.normals.mean_curvature()};
  if (!is_affordable(measures.area) || !is_affordable(measures.mean_curvature)) return std::nullopt;
  return measures;
}

bool are_affordable(std::initializer_list<const AxialMeasures*> bodies, std::size_t max_degree) {
  double cost = 0.0;
  for (const AxialMeasures* const body : bodies) {
    cost += cost_of_series(body->area, max_degree) + cost_of_series(body->mean_curvature, max_degree);
  }
  return cost <= kMostSteps;
}

double coefficient_of_degree(std::size_t degree) {
  const auto n = static_cast<double>(degree);
  return (2.0 * n + 1.0) / (2.0 * pi * (2.0 - n * (n + 1.0)));
}

std::optional<PairSeries> series_of_pair(const AxialMeasures& a, const AxialMeasures& b, std::size_t max_degree,
                                         const Vec3d& unit_axis_a, const Vec3d& unit_axis_b) {
  const bool are_one =
      &a == &b && unit_axis_a.x == unit_axis_b.x && unit_axis_a.y == unit_axis_b.y && unit_axis_a.z == unit_axis_b.z;
  std::optional<Series> area_a = legendre_series(a.area, max_degree, unit_axis_a),
                        curvature_a = legendre_series(a.mean_curvature, max_degree, unit_axis_a);
  std::optional<Series> area_b = are_one ? area_a : legendre_series(b.area, max_degree, unit_axis_b),
                        curvature_b =
                            are_one ? curvature_a : legendre_series(b.mean_curvature, max_degree, unit_axis_b);
  if (!area_a || !area_b || !curvature_a || !curvature_b) return std::nullopt;
  return PairSeries{*std::move(area_a), *std::move(area_b), *std::move(curvature_a), *std::move(curvature_b)};
}

std::optional<LegendreSeries> excluded_volume_series(const Body& a, const Body& b, std::size_t max_degree) {
  const std::optional<AxialMeasures> of_a = axial_measures(a), of_b = axial_measures(b);
  if (!of_a || !of_b || !are_affordable({&*of_a, &*of_b}, max_degree)) return std::nullopt;
  const AxialMeasures& other = &a == &b ? *of_a : *of_b;
  const std::optional<PairSeries> found = series_of_pair(*of_a, other, max_degree, {0.0, 0.0, 1.0}, {0.0, 0.0, 1.0});
  if (!found) return std::nullopt;
  Series sum(max_degree + 1, 0.0);
  for (std::size_t l = 0; l <= max_degree; ++l) {
    if (l == 1) continue;  // the integral of the normal over a closed surface is 0
    const double sign = l % 2 == 0 ? 1.0 : -1.0;
    sum[l] = sign * coefficient_of_degree(l) * found->of_degree(l);
  }
  sum[0] += a.measures.volume + b.measures.volume;
  return sum;
}

}  // namespace vex
