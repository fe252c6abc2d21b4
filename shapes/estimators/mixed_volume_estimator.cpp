#include "shapes/estimators/mixed_volume_estimator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "engine/numeric/elementary.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/numeric/rounding.h"
#include "engine/sampling/points/sobol.h"
#include "shapes/ellipsoid.h"
#include "shapes/estimators/core_heights.h"
#include "shapes/estimators/ellipsoid_excluded_volume.h"
#include "shapes/estimators/estimator.h"
#include "shapes/formula.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

// What the measures of a mesh are good to (meshes/convex_mesh.h), and the masses of its faces.
constexpr double kMeasuresError = 1e-12;

void require_normals(const Body& body) {
  if (!body.normals.area) {
    throw UsageError("a body without its measures on normals (" + body.kind +
                     ") - its excluded volume at a fixed orientation needs them");
  }
}

std::optional<Vec3d> semi_axes_of(const ConvexBody& body) {
  if (const auto* const ellipsoid = body.target<Ellipsoid>()) return ellipsoid->semi_axes();
  if (body.target<Sphere>() != nullptr) return Vec3d{body.inradius(), body.inradius(), body.inradius()};
  return std::nullopt;
}

struct Axes {
  Vec3d a, b;
};

std::optional<Axes> axes_of(const Body& a, const Body& b) {
  const std::optional<Vec3d> axes_a = semi_axes_of(a.body), axes_b = semi_axes_of(b.body);
  if (!axes_a || !axes_b) return std::nullopt;
  return Axes{*axes_a, *axes_b};
}

/// The axis along which a body is longest or shortest, whichever tells it more from the two others; z unless another
/// one is clearly the better.
std::size_t main_axis_of(const CoreHeights& heights) {
  const std::array<Vec3d, 3> axes{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  std::array<double, 3> widths;
  for (std::size_t k = 0; k < 3; ++k) {
    widths[k] = (heights(axes[k]) + heights(-axes[k])) + 2.0 * heights.ball_radius();
  }
  const auto apart = [&widths](std::size_t k) {
    const auto [thin, wide] = std::minmax(widths[(k + 1) % 3], widths[(k + 2) % 3]);
    return std::max(widths[k] / wide, thin / widths[k]);  // a NaN of a needle's or a point's 0 / 0 is no axis
  };
  constexpr double kClearly = 1.01;
  std::size_t best = 2;
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    if (apart(k) > kClearly * apart(best)) best = k;
  }
  return best;
}

/// Uniform over all rotations: Rz(f) Ry(t) Rz(p), cos t uniform, of frames that have the bodies' main axes as z. Of a
/// body that is alike about that axis the value does not hang on f or p, and of others less than on t; while
/// uniform_rotation's angles are f + p and f - p. Sobol' points are best where few coordinates matter together.
Transformd rotation_of_angles(std::span<const double> point, std::size_t axis_a, std::size_t axis_b) {
  const double cos = (point[0] + point[0]) - 1.0, sin = 2.0 * square_root(point[0] * (1.0 - point[0]));
  const SinCos<double> f = sincospi(point[1] + point[1]), p = sincospi(point[2] + point[2]);
  const auto row = [&](double x, double y, double z) -> Vec3d {
    const double x_turned = x * p.cos + y * p.sin, y_turned = y * p.cos - x * p.sin;
    return axis_b == 2 ? Vec3d{x_turned, y_turned, z}
                       : (axis_b == 1 ? Vec3d{y_turned, z, x_turned} : Vec3d{z, x_turned, y_turned});
  };
  const Vec3d x = row(f.cos * cos, -f.sin, f.cos * sin), y = row(f.sin * cos, f.cos, f.sin * sin),
              z = row(-sin, 0.0, cos);
  return axis_a == 2 ? Transformd{x, y, z, {}} : (axis_a == 1 ? Transformd{y, z, x, {}} : Transformd{z, x, y, {}});
}

NormalNodes nodes_of(const Body& body, const OrientationLaw& law, bool none) {
  return {none ? NormalMeasure{} : body.normals.area(), law.spins_about_z()};
}

}  // namespace

struct MixedVolumeEstimator::Plan {
  OrientationLaw law;
  std::optional<Axes> ellipsoids;
  NormalNodes nodes_a, nodes_b;
  CoreHeights heights_a, heights_b;
  NormalCoordinates at_a, at_b;
  std::size_t axis_a, axis_b;
  double certain = 0.0;  // what every value has
  double scale = 0.0, least_mean = 0.0, support_rounding = 0.0;
  int n_components = 0;

  Plan(const Body& a, const Body& b, const OrientationLaw& orientations)
      : law(orientations),
        ellipsoids(axes_of(a, b)),
        nodes_a(nodes_of(a, law, ellipsoids.has_value())),
        nodes_b(&a == &b ? nodes_a : nodes_of(b, law, ellipsoids.has_value())),
        heights_a(a.body),
        heights_b(b.body),
        axis_a(main_axis_of(heights_a)),
        axis_b(main_axis_of(heights_b)) {
    const double s_a = a.measures.surface_area, s_b = b.measures.surface_area;
    if (!ellipsoids) {
      certain = a.measures.volume + b.measures.volume;
      certain += nodes_a.uniform_mass() * b.measures.mean_radius() + nodes_b.uniform_mass() * a.measures.mean_radius();
      if (law.dimension() == 0) {
        const Transformd r = law.rotation<double>({});
        certain += nodes_a.take_out_faces(over(heights_b, r, false)) + nodes_b.take_out_faces(over(heights_a, r, true));
      }
      certain += nodes_a.mass() * heights_b.ball_radius() + nodes_b.mass() * heights_a.ball_radius();
    }
    favour(nodes_a, heights_b, false);
    favour(nodes_b, heights_a, true);
    const double reach_a = a.body.circumradius(), reach_b = b.body.circumradius();
    scale = (a.measures.volume + b.measures.volume) + (s_a * reach_b + s_b * reach_a);
    if (!(scale > 0.0)) scale = std::pow(reach_a + reach_b, 3);  // two needles: every value is 0
    if (!(scale > 0.0)) scale = 1.0;                             // two points
    // Each body has a ball, and for uniform rotations the mean is known.
    least_mean = law.kind() == OrientationLaw::Kind::isotropic
                     ? average_excluded_volume(a.measures, b.measures)
                     : (a.measures.volume + b.measures.volume) + (s_a * b.body.inradius() + s_b * a.body.inradius());
    support_rounding = s_a * (heights_b.error() + kDrawnRotationError * reach_b) +
                       s_b * (heights_a.error() + kDrawnRotationError * reach_a);
    n_components =
        static_cast<int>(std::min<std::size_t>(nodes_a.columns().size() + nodes_b.columns().size(), 1u << 30));
  }

  /// h_(-RB)(n) = h_B(-R^T n) for A's normals; the normals of -RB are -R n. With the ball's part.
  static std::function<double(const Vec3d&)> over(const CoreHeights& other, const Transformd& r, bool of_b) {
    return
        [&other, r, of_b](const Vec3d& n) { return other(of_b ? r(-n) : r.direction_to_b(-n)) + other.ball_radius(); };
  }

  // What to pick is decided by heights at a few rotations of the law. Over uniform rotations every normal has the same
  // mean.
  void favour(NormalNodes& nodes, const CoreHeights& other, bool of_b) const {
    constexpr std::size_t kMostHeights = std::size_t{1} << 20;
    if (!nodes.picks() || law.kind() == OrientationLaw::Kind::isotropic) return;
    const std::size_t n_rotations = std::min<std::size_t>(kMostHeights / nodes.n_components(), 16);
    std::vector<std::function<double(const Vec3d&)>> heights;
    const SobolPoints net(OrientationLaw::kMaxDimension);
    const SobolPoints::Scrambling keys = net.scrambling(1, 0);
    std::vector<double> point(OrientationLaw::kMaxDimension);
    for (std::size_t k = 0; k < n_rotations; ++k) {
      net.scrambled(keys, k, point);
      heights.push_back(over(other, law.rotation<double>(point), of_b));
    }
    nodes.favour([&](const Vec3d& n) {
      double sum = 0.0;
      for (const auto& height : heights) sum += height(n);
      return sum;
    });
  }
};

MixedVolumeEstimator::MixedVolumeEstimator(const Body& a, const Body& b, const OrientationLaw& law) {
  require_normals(a);
  require_normals(b);
  auto plan = std::make_shared<Plan>(a, b, law);
  n_coordinates_ = law.dimension();
  plan->at_a.pick = plan->nodes_a.picks() ? n_coordinates_++ : -1;
  plan->at_b.pick = plan->nodes_b.picks() ? n_coordinates_++ : -1;
  plan->at_a.v = plan->nodes_a.coordinates().v ? n_coordinates_++ : -1;
  plan->at_b.v = plan->nodes_b.coordinates().v ? n_coordinates_++ : -1;
  plan->at_a.w = plan->nodes_a.coordinates().w ? n_coordinates_++ : -1;
  plan->at_b.w = plan->nodes_b.coordinates().w ? n_coordinates_++ : -1;
  normals_a_ = plan->nodes_a.columns();
  normals_b_ = plan->nodes_b.columns();
  buffer_.resize(5 * std::max(normals_a_.size(), normals_b_.size()));
  point_.resize(static_cast<std::size_t>(dimension()));
  plan_ = std::move(plan);
}

double MixedVolumeEstimator::scale() const { return plan_->scale; }

double MixedVolumeEstimator::rounding(double mean) const {
  return (gamma(256 + plan_->n_components) + kMeasuresError) * mean + plan_->support_rounding;
}

double MixedVolumeEstimator::relative_rounding() const {
  const double least = std::max(plan_->least_mean, 0x1p-20 * plan_->scale);
  return rounding(least) / least;
}

double MixedVolumeEstimator::cost() const {
  constexpr double kCostOfCoordinate = 25.0, kCostOfNormal = 40.0, kCostOfEllipsoids = 1000.0;
  constexpr double kCostOfMeshsNormal = 150.0;  // bodies of many faces have many vertices
  constexpr double kCostOfPowers = 300.0;
  const bool has_mesh = plan_->nodes_a.picks() || plan_->nodes_b.picks();
  const bool has_powers = plan_->nodes_a.has_powers() || plan_->nodes_b.has_powers();
  const double cost_of_normal = has_powers ? kCostOfPowers : has_mesh ? kCostOfMeshsNormal : kCostOfNormal;
  const auto n_normals = static_cast<double>(normals_a_.size() + normals_b_.size());
  return kCostOfCoordinate * dimension() + (plan_->ellipsoids ? kCostOfEllipsoids : cost_of_normal * n_normals);
}

namespace {

/// The integral of h of the other body over the nodes, which are at their places.
double sum_over(const NormalColumns& normals, const CoreHeights& other, const Transformd& r, bool of_b,
                std::span<double> buffer) {
  const std::size_t n = normals.size(), n_pairs = normals.n_pairs;
  if (n == 0) return 0.0;
  double* const x = buffer.data();
  double *const y = x + n, *const z = y + n, *const along = z + n, *const against = along + n;
  // -R^T n over A's normals, -R n over B's: the same product with the rows or with the columns.
  const Vec3d row_x = of_b ? r.row_x : Vec3d{r.row_x.x, r.row_y.x, r.row_z.x};
  const Vec3d row_y = of_b ? r.row_y : Vec3d{r.row_x.y, r.row_y.y, r.row_z.y};
  const Vec3d row_z = of_b ? r.row_z : Vec3d{r.row_x.z, r.row_y.z, r.row_z.z};
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d normal{normals.x[i], normals.y[i], normals.z[i]};
    x[i] = -dot(row_x, normal);
    y[i] = -dot(row_y, normal);
    z[i] = -dot(row_z, normal);
  }
  other.of_pairs({x, y, z}, n_pairs, along, against);
  double total = 0.0;
  for (std::size_t i = 0; i < n_pairs; ++i) total += normals.along[i] * along[i] + normals.against[i] * against[i];
  for (std::size_t i = n_pairs; i < n; ++i) total += normals.along[i] * other({x[i], y[i], z[i]});
  return total;
}

}  // namespace

double MixedVolumeEstimator::value_at(std::span<const double> point) {
  const Plan& plan = *plan_;
  const Transformd r = plan.law.kind() == OrientationLaw::Kind::isotropic
                           ? rotation_of_angles(point, plan.axis_a, plan.axis_b)
                           : plan.law.rotation<double>(point);
  if (plan.ellipsoids) return ellipsoid_excluded_volume(plan.ellipsoids->a, plan.ellipsoids->b, r);
  plan.nodes_a.place(point, plan.at_a, normals_a_);
  plan.nodes_b.place(point, plan.at_b, normals_b_);
  return plan.certain + sum_over(normals_a_, plan.heights_b, r, false, buffer_) +
         sum_over(normals_b_, plan.heights_a, r, true, buffer_);
}

Doubts MixedVolumeEstimator::evaluate(std::span<const double> points, std::span<double> values) {
  VEX_EXPECT(points.size() == point_.size() * values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    for (std::size_t c = 0; c < point_.size(); ++c) point_[c] = points[c * values.size() + k];
    values[k] = value_at(point_);
  }
  return {};
}

namespace {

std::optional<std::string> only_with_normals(const Body& a, const Body& b, const OrientationLaw& /*law*/) {
  if (!a.normals.area || !b.normals.area) return "a body is without its measures on normals";
  if (!a.measures.are_known() || !b.measures.are_known()) return "V, S and M of a body are not known";
  return std::nullopt;
}

void by_mixed_volumes(MonteCarloSettings& settings, const Body& a, const Body& b, std::optional<Domain::Kind>) {
  // What the faces were sorted into is shared by the threads' copies.
  settings.integrand = [whole = std::make_shared<const MixedVolumeEstimator>(a, b, settings.law)] {
    return std::make_unique<MixedVolumeEstimator>(*whole);
  };
}

}  // namespace

extern const Estimator kMixedVolume;
constinit const Estimator kMixedVolume{.name = "mixed-volume",
                                       .meaning = "by the formula's own geometry, at each orientation",
                                       .usual_sequence = Sequence::sobol,
                                       .pilot_sequence = Sequence::sobol,
                                       .why_not = only_with_normals,
                                       .prepare = by_mixed_volumes};

}  // namespace vex
