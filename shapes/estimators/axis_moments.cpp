#include "shapes/estimators/axis_moments.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/numeric/rounding.h"

namespace vex {
namespace {

using std::numbers::pi;
using Series = LegendreSeries;

constexpr std::size_t kMaxDegree = kMaxDegreeOfMoments;
constexpr double kLargestAlpha = 500.0;      // far below 2 kMaxDegree, where the Bessel functions' recursion begins
constexpr double kMostStepsOfMoments = 2e8;  // of the polynomials' recursion, about a nanosecond each

/// A density that is linear between points and 0 outside of them, f. With Q_l = (P_(l+1) - P_(l-1)) / (2 l + 1), an
/// integral of P_l that is 0 at both ends of [-1, 1], <P_l> is the sum over the points of -(jump of f) Q_l less the
/// integral of f' Q_l; and that of Q_l is (Q_(l+1) - Q_(l-1)) / (2 l + 1). Tail: |P_l(cos x)|^2 is at most
/// 2 / (pi l sin x) (S. Bernstein), so that |Q_l| is at most 2 sqrt(2 / (pi (l - 1) sin x)) / (2 l + 1).
AxisMoments moments_of_lines(const AxisTable& f) {
  const std::size_t n = f.cosines.size();
  Series jumps(kMaxDegree + 3, 0.0), bends(kMaxDegree + 3, 0.0);  // sums of P_l
  double roughness = 0.0;                                         // of |jumps| / sqrt(sin) and of |f'| / sqrt(sin)
  const auto sine = [](double cos) { return std::sqrt((1.0 - cos) * (1.0 + cos)); };
  const auto add_jump = [&](double jump, double cos) {
    if (jump == 0.0 || !(sine(cos) > 0.0)) return;  // at the ends of [-1, 1] Q_l is 0
    add_polynomials(jump, cos, &jumps);
    roughness += std::fabs(jump) / std::sqrt(sine(cos));
  };
  add_jump(f.densities.front(), f.cosines.front());
  add_jump(-f.densities.back(), f.cosines.back());
  double slope_before = 0.0, divided = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    double slope = 0.0;
    if (k + 1 < n) {
      const double from = f.cosines[k], to = f.cosines[k + 1];
      slope = (f.densities[k + 1] - f.densities[k]) / (to - from);
      // The integral of sin^(-1/2) over cos is that of sin^(1/2) over the arc: at most the arc.
      roughness += std::fabs(slope) * (std::acos(from) - std::acos(to));
      divided += (f.densities[k] + f.densities[k + 1]) / (to - from);
    }
    if (slope != slope_before) add_polynomials(slope - slope_before, f.cosines[k], &bends);
    slope_before = slope;
  }
  AxisMoments moments;
  moments.by_degree.assign(kMaxDegree + 1, 1.0);
  moments.by_degree[1] = 0.0;  // no body has a part of this degree
  const auto q = [](const Series& p, std::size_t l) { return (p[l + 1] - p[l - 1]) / static_cast<double>(2 * l + 1); };
  for (std::size_t l = 2; l <= kMaxDegree; ++l) {
    const double twice = (q(bends, l + 1) - q(bends, l - 1)) / static_cast<double>(2 * l + 1);
    moments.by_degree[l] = -q(jumps, l) + twice;
  }
  // |<P_l>|^2 <= 2 roughness^2 / (pi (l - 1)^3), over l.
  const double last = static_cast<double>(kMaxDegree) - 1.0;
  moments.tail_of_squares = 2.0 * roughness * roughness / pi / (3.0 * last * last * last);
  moments.tail = std::sqrt(2.0 / pi) * roughness / (1.5 * last * std::sqrt(last));
  moments.rounding = kUnitRoundoff * divided;
  return moments;
}

/// cos(theta) uniform on [c, 1] and a random sign: for even l as without it. 1 - c has all its digits.
AxisMoments cone_moments(double polar_rad) {
  const double sine_half = std::sin(0.5 * polar_rad);
  const double height = 2.0 * sine_half * sine_half;
  AxisMoments moments = moments_of_lines({{std::cos(polar_rad), 1.0}, {1.0 / height, 1.0 / height}});
  for (std::size_t l = 1; l <= kMaxDegree; l += 2) moments.by_degree[l] = 0.0;
  moments.tail_of_squares *= 0.5;  // every second degree
  moments.tail *= 0.5;
  return moments;
}

/// A density like exp(a cos^2(theta)), by Gauss and Legendre's nodes on 0 < theta < pi/2, in which P_l waves evenly, as
/// many as the highest degree and the density ask for. Tail: in the ellipse with the foci +-1 and half axes (r +- 1/r)
/// / 2 the density is at most M, and then
/// |<P_l>| <= 4 M (r + 1 / r) / (r^(l+1) (1 - r^-2)) (H. Wang, S. Xiang, Math. Comp. 81, 861, 2012), here with r = 2.
AxisMoments maier_saupe_moments(double strength) {
  using Gauss = boost::math::quadrature::gauss<double, 30>;
  const double a = 1.5 * strength;
  const std::size_t n_panels = kMaxDegree / 20 + static_cast<std::size_t>(std::fabs(a) / 8.0) + 1;
  const double half_width = 0.25 * pi / static_cast<double>(n_panels);
  AxisMoments moments;
  moments.by_degree.assign(kMaxDegree + 1, 0.0);
  for (std::size_t panel = 0; panel < n_panels; ++panel) {
    const double middle = (2.0 * static_cast<double>(panel) + 1.0) * half_width;
    for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
      for (const double side : {-1.0, 1.0}) {
        const double theta = middle + side * half_width * Gauss::abscissa()[i];
        const double x = std::cos(theta), sine = std::sin(theta);
        const double density = sine * std::exp(a > 0.0 ? -a * (sine * sine) : a * (x * x));
        if (density > 1e-20) add_polynomials(half_width * Gauss::weights()[i] * density, x, &moments.by_degree);
      }
    }
  }
  const double all = moments.by_degree[0];
  for (std::size_t l = 0; l <= kMaxDegree; ++l) moments.by_degree[l] = l % 2 == 0 ? moments.by_degree[l] / all : 0.0;
  const double log_most = (a > 0.0 ? a * (1.25 * 1.25 - 1.0) : -a * 0.75 * 0.75) - std::log(2.0 * all);
  const double log_last =
      std::log(4.0 * 2.5 / 0.75) + log_most - std::log(2.0) * (static_cast<double>(kMaxDegree) + 2.0);
  moments.tail = std::exp(log_last) / static_cast<double>(kMaxDegree);
  moments.tail_of_squares = moments.tail * std::exp(log_last);
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
  moments.tail_of_squares = last * last / (static_cast<double>(kMaxDegree) * std::max(1.0 - r * r, 1e-300));
  moments.tail = last / (static_cast<double>(kMaxDegree) * std::max(1.0 - r, 1e-300));
  for (std::size_t l = 1; l <= kMaxDegree; l += 2) moments.by_degree[l] = 0.0;
  return moments;
}

}  // namespace

std::optional<AxisMoments> axis_moments(const AxisLaw& law) {
  switch (law.kind()) {
    case AxisLaw::Kind::isotropic: return std::nullopt;  // the formula's
    case AxisLaw::Kind::aligned: {
      AxisMoments all_one;
      all_one.by_degree.assign(kMaxDegree + 1, 1.0);
      all_one.tail = all_one.tail_of_squares = std::numeric_limits<double>::infinity();
      return all_one;
    }
    case AxisLaw::Kind::cone:
      if (!(law.parameter() > 0.0)) return std::nullopt;
      return cone_moments(law.parameter() * (pi / 180.0));
    case AxisLaw::Kind::onsager:
      if (law.parameter() > kLargestAlpha) return std::nullopt;
      return onsager_moments(law.parameter());
    case AxisLaw::Kind::maier_saupe: return maier_saupe_moments(law.parameter());
    case AxisLaw::Kind::table: break;
  }
  if (static_cast<double>(law.points()->cosines.size()) * kMaxDegree > kMostStepsOfMoments) return std::nullopt;
  return moments_of_lines(*law.points());
}

}  // namespace vex
