#include "shapes/estimators/mean_width_estimator.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "engine/numeric/elementary.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/numeric/rounding.h"
#include "shapes/estimators/estimator.h"

namespace vex {
namespace {

constexpr std::size_t kPairs = 24;  // of the 48 directions: each and its opposite

/// (v, w) of the unit square to the part of the unit sphere with x >= y >= z >= 0, uniform in area.
///
/// At the azimuth f, 0 to pi/4, z goes up to sin f / sqrt(1 + sin^2 f), where z = y. Integrated, the area up to f is
/// pi/4 - asin(cos f / sqrt 2), which is v pi/12 where cos f = sqrt 2 sin(pi/4 - v pi/12): sin^2 f = sin(v pi/6). So y
/// and z are like sqrt(v) about the corner (1, 0, 0), across which a mean over reflections is even: it is smooth in v.
Vec3d direction_at(double v, double w) {
  const double sin_sq = sincospi(v * (1.0 / 6.0)).sin;
  const double z = w * square_root(sin_sq / (1.0 + sin_sq));
  const double across = square_root(1.0 - z * z);
  return {across * square_root(1.0 - sin_sq), across * square_root(sin_sq), z};
}

struct Directions {
  std::array<double, kPairs> x, y, z;

  /// Six orders of the coordinates, and four of their signs; the other four are the opposites.
  explicit Directions(const Vec3d& u) {
    const std::array<Vec3d, 6> orders{
        {{u.x, u.y, u.z}, {u.y, u.z, u.x}, {u.z, u.x, u.y}, {u.y, u.x, u.z}, {u.x, u.z, u.y}, {u.z, u.y, u.x}}};
    for (std::size_t i = 0; i < orders.size(); ++i) {
      for (std::size_t signs = 0; signs < 4; ++signs) {
        x[4 * i + signs] = (signs & 1) != 0 ? -orders[i].x : orders[i].x;
        y[4 * i + signs] = (signs & 2) != 0 ? -orders[i].y : orders[i].y;
        z[4 * i + signs] = orders[i].z;
      }
    }
  }
};

/// Of the core.
double mean_height(const CoreHeights& heights, const Directions& dirs) {
  std::array<double, kPairs> along, against;
  heights.of_pairs({dirs.x.data(), dirs.y.data(), dirs.z.data()}, kPairs, along.data(), against.data());
  double sum = 0.0;
  for (std::size_t i = 0; i < kPairs; ++i) sum += along[i] + against[i];
  return sum * (0.5 / static_cast<double>(kPairs));
}

/// hbar is not less: that of a ball in the body, and that of a segment is a quarter of its length.
double least_mean_height(const ConvexBody& body) {
  double widest = 0.0;
  for (const Vec3d& axis : {Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.0, 0.0, 1.0}}) {
    widest = std::max(widest, dot(axis, body.support(axis) - body.support(-axis)));
  }
  return std::max(body.inradius(), 0.25 * widest);
}

}  // namespace

MeanWidthEstimator::MeanWidthEstimator(const ConvexBody& a, const VolumeAndSurface& of_a, const ConvexBody& b,
                                       const VolumeAndSurface& of_b, const OrientationLaw& law)
    : heights_a_(a), heights_b_(b), of_a_(of_a), of_b_(of_b), is_one_body_(a.is_same_as(b.identity())) {
  if (law.kind() != OrientationLaw::Kind::isotropic) {
    throw UsageError("mean widths tell nothing of orientations that are not uniform (law " + law.name() +
                     ") - take another estimator, or the isotropic law");
  }
  const double volumes = of_a.volume + of_b.volume, s_a = of_a.surface_area, s_b = of_b.surface_area;
  certain_ = volumes + s_b * heights_a_.ball_radius() + s_a * heights_b_.ball_radius();
  scale_ = volumes + (s_b * a.circumradius() + s_a * b.circumradius());
  if (!(scale_ > 0.0)) {  // two needles: every value is 0
    const double reach = a.circumradius() + b.circumradius();
    scale_ = reach > 0.0 ? reach * reach * reach : 1.0;
  }
  // 47 additions of heights and some products; a direction is off by less than 64 roundings, which moves a height by no
  // more than that times the reach.
  const double of_heights =
      s_b * (heights_a_.error() + gamma(64) * a.reach()) + s_a * (heights_b_.error() + gamma(64) * b.reach());
  const double least = volumes + (s_b * least_mean_height(a) + s_a * least_mean_height(b));
  relative_rounding_ = gamma(64) + (least > 0.0 ? of_heights / least : 0.0);
}

MeanWidthEstimator::MeanWidthEstimator(const Body& a, const Body& b, const OrientationLaw& law)
    : MeanWidthEstimator(a.body, {a.measures.volume, a.measures.surface_area}, b.body,
                         {b.measures.volume, b.measures.surface_area}, law) {}

double MeanWidthEstimator::cost() const {
  constexpr double kOfPoint = 60.0, kOfHeight = 2.0;
  return kOfPoint +
         2.0 * kPairs * ((is_one_body_ ? 0.0 : kOfHeight + heights_b_.price()) + kOfHeight + heights_a_.price());
}

Doubts MeanWidthEstimator::evaluate(std::span<const double> points, std::span<double> values) {
  const std::size_t n = values.size();
  VEX_EXPECT(points.size() == 2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const Directions dirs(direction_at(points[k], points[n + k]));
    const double h_a = mean_height(heights_a_, dirs);
    const double h_b = is_one_body_ ? h_a : mean_height(heights_b_, dirs);
    values[k] = certain_ + (of_b_.surface_area * h_a + of_a_.surface_area * h_b);
  }
  return {};
}

namespace {

std::optional<std::string> only_isotropic(const Body& a, const Body& b, const OrientationLaw& law) {
  if (law.kind() != OrientationLaw::Kind::isotropic) {
    return "mean widths are of random orientations, not of " + law.name() + " ones";
  }
  if (!a.measures.are_known() || !b.measures.are_known()) return "V and S of a body are not known";
  return std::nullopt;
}

void by_mean_widths(MonteCarloSettings& settings, const Body& a, const Body& b, std::optional<Domain::Kind>) {
  settings.integrand = [a, b] { return std::make_unique<MeanWidthEstimator>(a, b); };
}

}  // namespace

extern const Estimator kMeanWidth;
constinit const Estimator kMeanWidth{.name = "mean-width",
                                     .meaning = "by the formula, M from support values",
                                     .usual_sequence = Sequence::sobol,
                                     .pilot_sequence = Sequence::sobol,
                                     .why_not = only_isotropic,
                                     .prepare = by_mean_widths};

}  // namespace vex
