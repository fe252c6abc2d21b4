#include "shapes/estimators/legendre_average.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <variant>
#include <vector>

#include "engine/numeric/errors.h"
#include "shapes/rounded.h"

namespace vex {
namespace {

using std::numbers::pi;

constexpr std::size_t kMaxDegree = 2048;      // even
constexpr std::size_t kMostVertices = 20000;  // of a mesh: its measures are not even asked for
constexpr double kMostSteps = 4e8;            // of the polynomials' recursion, about a nanosecond each
constexpr double kLargestError = 1e-6;        // relative to what V_ex can be at most: beyond it random points do better
constexpr double kLargestAspectRatio = 100.0;  // of ellipsoids: the nodes they take grow with its square
constexpr double kLargestAlpha = 500.0;        // far below 2 kMaxDegree, where the Bessel functions' recursion begins
constexpr double kRoundingError = 1e-11;       // a recursion of 2048 steps loses fewer than 4 digits

using Series = std::vector<double>;  // by degree, from 0 up

/// sum[l] += weight P_l(x), by the three-term recursion, which is stable for |x| <= 1.
void add_polynomials(double weight, double x, Series* sum) {
  double before = 0.0, now = 1.0;
  for (std::size_t l = 0; l < sum->size(); ++l) {
    (*sum)[l] += weight * now;
    const auto n = static_cast<double>(l);
    const double next = ((2.0 * n + 1.0) * x * now - n * before) / (n + 1.0);
    before = now;
    now = next;
  }
}

std::size_t panels_for(double angle_rad, std::size_t n_degrees) {
  return static_cast<std::size_t>(angle_rad * static_cast<double>(n_degrees) / 40.0) + 1;
}

/// The same for the mean of weight(v) P_l(n_z(v)) over 0 < v < 1, where n_z turns through `angle_rad`: 30 nodes for
/// each 40 radians of phase of the highest degree.
template <class F>
void add_mean(double angle_rad, std::size_t least_panels, const F& normal_of, Series* sum) {
  using Gauss = boost::math::quadrature::gauss<double, 30>;
  const std::size_t n_panels = std::max(panels_for(angle_rad, sum->size()), least_panels);
  const double half_width = 0.5 / static_cast<double>(n_panels);
  for (std::size_t panel = 0; panel < n_panels; ++panel) {
    const double middle = (2.0 * static_cast<double>(panel) + 1.0) * half_width;
    for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
      for (const double side : {-1.0, 1.0}) {
        const WeightedNormal at = normal_of(middle + side * half_width * Gauss::abscissa()[i]);
        add_polynomials(half_width * Gauss::weights()[i] * at.weight, std::clamp(at.unit_normal.z, -1.0, 1.0), sum);
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
      sum);
}

/// The integrals of P_l(n_z) over the measure.
Series legendre_series(const NormalMeasure& measure, std::size_t max_degree) {
  Series sum(max_degree + 1, 0.0);
  for (const NormalMeasure::Component& component : measure.components()) {
    if (!(mass_of(component) > 0.0)) continue;
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
      add_mean(arc->angle_rad, 1, at, &sum);
    } else if (const auto* const rim = std::get_if<NormalRim>(&component)) {
      add_mean(rim->polar_to_rad - rim->polar_from_rad, 1, at, &sum);
    } else if (const auto* const belt = std::get_if<NormalBelt>(&component)) {
      add_mean(2.0 * belt->half_angle_rad, 1, at, &sum);
    } else if (const auto* const half = std::get_if<HalfSpheroidNormals>(&component)) {
      const double ratio = aspect_ratio({half->across, half->across, half->along});
      add_mean(0.5 * pi, static_cast<std::size_t>(2.0 * ratio), at, &sum);
    } else if (std::holds_alternative<NormalAtom>(component) || std::holds_alternative<NormalRing>(component)) {
      add_polynomials(mass_of(component), std::clamp(at(0.5).unit_normal.z, -1.0, 1.0), &sum);
    } else if (const auto* const area = std::get_if<EllipsoidNormals>(&component)) {
      add_ellipsoid(area->semi_axes, area->factor, GaussianCurvature{area->semi_axes}, &sum);
    } else if (const auto* const curvature = std::get_if<EllipsoidCurvature>(&component)) {
      add_ellipsoid(
          curvature->semi_axes, curvature->factor,
          [&](double v, double w) {
            return 2.0 * pi * sum_of_radii_of_curvature(curvature->semi_axes, uniform_normal(v, w));
          },
          &sum);
    }
  }
  return sum;
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

/// <P_l(cos theta)> of an axis, for even l; a bound on the sum of <P_l>^2 / l over the even l above the last.
struct AxisMoments {
  Series by_degree;
  double tail = 0.0;
};

/// cos(theta) uniform on [c, 1]: (P_(l-1)(c) - P_(l+1)(c)) / ((2 l + 1) (1 - c)). Tail: |P_l(cos x)|^2 is at most
/// 2 / (pi l sin x) (S. Bernstein).
AxisMoments cone_moments(double polar_rad) {
  const double c = std::cos(polar_rad);
  const double sine_half = std::sin(0.5 * polar_rad);
  const double height = 2.0 * sine_half * sine_half;
  Series p(kMaxDegree + 2, 0.0);
  add_polynomials(1.0, c, &p);
  AxisMoments moments;
  moments.by_degree.assign(kMaxDegree + 1, 1.0);
  for (std::size_t l = 1; l <= kMaxDegree; ++l) {
    moments.by_degree[l] = (p[l - 1] - p[l + 1]) / (static_cast<double>(2 * l + 1) * height);
  }
  // <P_l>^2 <= 2 / (pi sin x height^2 (l - 1)^3); the sum of l^-4 over even l > L is below 1 / (6 (L - 1)^3).
  const double last = static_cast<double>(kMaxDegree) - 1.0;
  moments.tail = 2.0 / (pi * std::sin(polar_rad) * height * height) / (6.0 * last * last * last);
  return moments;
}

/// A density like cosh(alpha cos(theta)): for even l the modified spherical Bessel functions i_l / i_0 (alpha), by the
/// recursion i_(l-1) = i_(l+1) + (2 l + 1) / alpha i_l from far above (J. C. P. Miller).
AxisMoments onsager_moments(double alpha) {
  AxisMoments moments;
  moments.by_degree.assign(kMaxDegree + 1, 0.0);
  moments.by_degree[0] = 1.0;
  if (alpha < 1e-6) return moments;                // <P_2> is alpha^2 / 15
  std::vector<double> ratio(kMaxDegree + 1, 0.0);  // i_l / i_(l-1)
  double above = 0.0;
  for (std::size_t l = 2 * kMaxDegree; l > 0; --l) {
    above = 1.0 / (above + static_cast<double>(2 * l + 1) / alpha);
    if (l <= kMaxDegree) ratio[l] = above;
  }
  for (std::size_t l = 1; l <= kMaxDegree; ++l) moments.by_degree[l] = moments.by_degree[l - 1] * ratio[l];
  // The ratios fall with l: what is left is a geometric series.
  const double last = moments.by_degree[kMaxDegree], r = ratio[kMaxDegree];
  moments.tail = last * last / (static_cast<double>(kMaxDegree) * std::max(1.0 - r * r, 1e-300));
  return moments;
}

}  // namespace

std::optional<SeriesAverage> legendre_average(const Body& a, const Body& b, const OrientationLaw& law) {
  if (!a.normals.area || !b.normals.area || !a.normals.mean_curvature || !b.normals.mean_curvature) {
    throw UsageError("a body without its measures on normals (" + a.kind + ", " + b.kind + ") - the series needs them");
  }
  const bool is_cone = law.kind() == OrientationLaw::Kind::cone;
  if (!is_cone && law.kind() != OrientationLaw::Kind::onsager) return std::nullopt;
  if (is_cone ? !(law.parameter() > 0.0) : law.parameter() > kLargestAlpha) return std::nullopt;
  // A large mesh's measures are not even asked for.
  if (n_core_vertices(a.body) > kMostVertices || n_core_vertices(b.body) > kMostVertices) return std::nullopt;
  const NormalMeasure area_a = a.normals.area(), area_b = b.normals.area();
  const NormalMeasure curvature_a = a.normals.mean_curvature(), curvature_b = b.normals.mean_curvature();
  for (const NormalMeasure* const measure : {&area_a, &area_b, &curvature_a, &curvature_b}) {
    if (!is_affordable(*measure)) return std::nullopt;
  }

  // |S_l| <= S and |H_l| <= M, and the factor is at most 1 / (2 l) in size: (2 l + 1) / (2 pi (l^2 + l - 2)), l >= 2.
  const double largest = a.measures.surface_area * b.measures.integrated_mean_curvature +
                         b.measures.surface_area * a.measures.integrated_mean_curvature;
  const AxisMoments axis = is_cone ? cone_moments(law.parameter() * (pi / 180.0)) : onsager_moments(law.parameter());
  // No more degrees than matter: what is left out goes to the error.
  std::size_t degree = kMaxDegree;
  double left_out = axis.tail;
  const double negligible = is_cone ? 1e-8 : 1e-14;  // a cone's edge makes the sum long
  while (degree > 2) {
    const double p = axis.by_degree[degree];
    if (left_out + p * p / static_cast<double>(degree) > negligible) break;
    left_out += p * p / static_cast<double>(degree);
    degree -= 2;
  }
  // V_ex is at most V_A + V_B + S_A R_B + S_B R_A with the circumradii.
  const double at_most = a.measures.volume + b.measures.volume + a.measures.surface_area * b.body.circumradius() +
                         b.measures.surface_area * a.body.circumradius();
  if (0.5 * largest * left_out > kLargestError * at_most) return std::nullopt;
  double cost = 0.0;
  for (const NormalMeasure* const measure : {&area_a, &area_b, &curvature_a, &curvature_b}) {
    cost += cost_of_series(*measure, degree);
  }
  if (cost > kMostSteps) return std::nullopt;
  const Series s_a = legendre_series(area_a, degree), s_b = legendre_series(area_b, degree);
  const Series h_a = legendre_series(curvature_a, degree), h_b = legendre_series(curvature_b, degree);
  double sum = 0.0;
  for (std::size_t l = degree + degree % 2; l <= degree; l -= 2) {
    const auto n = static_cast<double>(l);
    const double factor = (2.0 * n + 1.0) / (2.0 * pi * (2.0 - n * (n + 1.0)));
    sum += axis.by_degree[l] * axis.by_degree[l] * factor * (s_a[l] * h_b[l] + s_b[l] * h_a[l]);
    if (l == 0) break;
  }
  const double value = a.measures.volume + b.measures.volume + sum;
  return SeriesAverage{value, 0.5 * largest * left_out + kRoundingError * value};
}

}  // namespace vex
