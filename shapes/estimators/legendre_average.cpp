#include "shapes/estimators/legendre_average.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "shapes/estimators/axis_moments.h"
#include "shapes/estimators/legendre_series.h"

namespace vex {
namespace {

constexpr double kLargestError = 1e-6;    // relative to what V_ex can be at most: beyond it random points do better
constexpr double kRoundingError = 1e-11;  // a recursion of 2048 steps loses fewer than 4 digits

bool is_smooth(const AxisLaw& law) {
  return law.kind() == AxisLaw::Kind::onsager || law.kind() == AxisLaw::Kind::maier_saupe;
}

/// A bound on the sum over the degrees above of |<P_l>_A <P_l>_B| / l.
double tail_of(const OrientationLaw& law, const AxisMoments& a, const AxisMoments& b) {
  if (law.of_body(0).is_along()) return b.tail;  // |<P_l>_A| is 1
  if (law.of_body(1).is_along()) return a.tail;
  return std::sqrt(a.tail_of_squares) * std::sqrt(b.tail_of_squares);
}

}  // namespace

std::optional<SeriesAverage> legendre_average(const Body& a, const Body& b, const OrientationLaw& law) {
  if (law.kind() < OrientationLaw::Kind::cone) return std::nullopt;
  std::optional<AxisMoments> moments_a = axis_moments(law.of_body(0));
  const std::optional<AxisMoments> moments_b = axis_moments(law.of_body(1));
  if (!moments_a || !moments_b) return std::nullopt;
  const std::optional<AxialMeasures> of_a = axial_measures(a), of_b = axial_measures(b);
  if (!of_a || !of_b) return std::nullopt;
  const Vec3d axis_a = law.axis_of(0), axis_b = law.axis_of(1);
  if (!have_series_about(*of_a, axis_a) || !have_series_about(*of_b, axis_b)) return std::nullopt;

  // |S_l| <= S and |H_l| <= M, and the factor is at most 1 / (2 l) in size: (2 l + 1) / (2 pi (l^2 + l - 2)), l >= 2.
  const double largest = a.measures.surface_area * b.measures.integrated_mean_curvature +
                         b.measures.surface_area * a.measures.integrated_mean_curvature;
  LegendreSeries both = std::move(moments_a->by_degree);
  for (std::size_t l = 0; l < both.size(); ++l) both[l] *= moments_b->by_degree[l];
  // V_ex is at most V_A + V_B + S_A R_B + S_B R_A with the circumradii.
  const double at_most = a.measures.volume + b.measures.volume + a.measures.surface_area * b.body.circumradius() +
                         b.measures.surface_area * a.body.circumradius();
  // No more degrees than matter: what is left out goes to the error. A density's edge makes the sum long; where that
  // takes too long, more may be left out.
  const bool is_smooth_law = is_smooth(law.of_body(0)) || is_smooth(law.of_body(1));
  std::size_t degree = kMaxDegreeOfMoments;
  double left_out = tail_of(law, *moments_a, *moments_b);
  const double rounding = moments_a->rounding + moments_b->rounding;
  std::optional<PairSeries> series;
  for (double negligible = is_smooth_law ? 1e-14 : 1e-8; !series; negligible *= 10.0) {
    while (degree > 2) {
      const double here = std::fabs(both[degree]) / static_cast<double>(degree);
      if (left_out + here > negligible) break;
      left_out += here;
      --degree;
    }
    if (!(0.5 * largest * (left_out + rounding) <= kLargestError * at_most)) return std::nullopt;
    if (are_affordable({&*of_a, &*of_b}, degree)) {
      series = series_of_pair(*of_a, &a == &b ? *of_a : *of_b, degree, axis_a, axis_b);
    }
    if (!series && (is_smooth_law || degree == 2)) return std::nullopt;
  }
  double sum = 0.0;
  for (std::size_t l = degree; l != 1; l = l == 2 ? 0 : l - 1) {  // of degree 1 no body has a part
    const double factor = l % 2 == 0 ? coefficient_of_degree(l) : -coefficient_of_degree(l);
    sum += both[l] * factor * series->of_degree(l);
    if (l == 0) break;
  }
  const double value = a.measures.volume + b.measures.volume + sum;
  return SeriesAverage{value, 0.5 * largest * (left_out + rounding) + kRoundingError * value};
}

}  // namespace vex
