#include "shapes/estimators/legendre_average.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "shapes/estimators/legendre_series.h"

namespace vex {
namespace {

using std::numbers::pi;

constexpr std::size_t kMaxDegree = 2048;  // even
constexpr double kLargestError = 1e-6;    // relative to what V_ex can be at most: beyond it random points do better
constexpr double kLargestAlpha = 500.0;   // far below 2 kMaxDegree, where the Bessel functions' recursion begins
constexpr double kRoundingError = 1e-11;  // a recursion of 2048 steps loses fewer than 4 digits

using Series = LegendreSeries;

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
  const bool is_cone = law.kind() == OrientationLaw::Kind::cone;
  if (!is_cone && law.kind() != OrientationLaw::Kind::onsager) return std::nullopt;
  if (is_cone ? !(law.parameter() > 0.0) : law.parameter() > kLargestAlpha) return std::nullopt;
  const std::optional<AxialMeasures> of_a = axial_measures(a), of_b = axial_measures(b);
  if (!of_a || !of_b) return std::nullopt;

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
  if (!are_affordable({&*of_a, &*of_b}, degree)) return std::nullopt;
  const Series s_a = legendre_series(of_a->area, degree), s_b = legendre_series(of_b->area, degree);
  const Series h_a = legendre_series(of_a->mean_curvature, degree), h_b = legendre_series(of_b->mean_curvature, degree);
  double sum = 0.0;
  for (std::size_t l = degree + degree % 2; l <= degree; l -= 2) {
    const double factor = coefficient_of_degree(l);
    sum += axis.by_degree[l] * axis.by_degree[l] * factor * (s_a[l] * h_b[l] + s_b[l] * h_a[l]);
    if (l == 0) break;
  }
  const double value = a.measures.volume + b.measures.volume + sum;
  return SeriesAverage{value, 0.5 * largest * left_out + kRoundingError * value};
}

}  // namespace vex
