#include "apps/referees/exact_average.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "apps/referees/ellipsoid_excluded_volume.h"
#include "apps/referees/legendre_average.h"
#include "apps/referees/vertex_tree.h"
#include "engine/numeric/double_double.h"
#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/numeric/rounding.h"
#include "engine/sampling/sobol.h"
#include "shapes/ellipsoid.h"
#include "shapes/rounded.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

constexpr std::size_t kMostSummed = 64;  // components of one sort: more are sampled
constexpr std::size_t kLargestScan = 512;

// What the measures of a mesh are good to (meshes/convex_mesh.h), and more than the matrix of a law is off a rotation
// by.
constexpr double kMeasuresError = 1e-12;

constexpr std::uint64_t kPilot = 0xffffffff;  // a replicate of its own, which no randomisation is

constexpr double kSeriesError = 1e-6;  // relative: above it, random points may do better

/// h_K(n) about K's centre, which does not change mixed volumes, keeps every term positive, and makes less noise.
class Heights {
 public:
  explicit Heights(const ConvexBody& body) : core_(body), centre_(body.centre()) {
    while (const auto* const rounded = core_.target<Rounded<ConvexBody>>()) {
      radius_ += rounded->radius();
      core_ = ConvexBody(rounded->body());
    }
    std::vector<Vec3d> vertices = vertices_of(core_);
    n_vertices_ = vertices.size();
    if (n_vertices_ > kLargestScan) tree_.emplace(std::move(vertices));
  }

  double operator()(const Vec3d& unit_normal) const {
    const double core =
        tree_ ? tree_->height(unit_normal, centre_) : dot(unit_normal, core_.support(unit_normal) - centre_);
    return core + radius_;
  }
  /// In about nanoseconds, as measured.
  double cost() const {
    return tree_ ? 25.0 * std::sqrt(static_cast<double>(n_vertices_)) : 20.0 + 2.0 * static_cast<double>(n_vertices_);
  }
  double error() const { return core_.support_error() + gamma(16) * core_.reach(); }

 private:
  ConvexBody core_;
  Vec3d centre_;
  double radius_ = 0.0;
  std::size_t n_vertices_ = 0;
  std::optional<VertexTree> tree_;
};

/// Where a unit vector lies along a Hilbert curve over the octahedron unfolded into a square.
std::uint64_t place_on_sphere(const Vec3d& n) {
  const double scale = 1.0 / norm_1(n);
  double x = scale * n.x, y = scale * n.y;
  if (n.z < 0.0) {
    const double folded_x = std::copysign(1.0 - std::fabs(y), x), folded_y = std::copysign(1.0 - std::fabs(x), y);
    x = folded_x;
    y = folded_y;
  }
  constexpr std::uint32_t kSide = 1u << 16;
  const auto cell = [](double t) {
    return static_cast<std::uint32_t>(std::clamp((0.5 + 0.5 * t) * kSide, 0.0, kSide - 1.0));
  };
  std::uint32_t i = cell(x), j = cell(y);
  std::uint64_t place = 0;
  for (std::uint32_t s = kSide / 2; s > 0; s /= 2) {
    const std::uint32_t right = (i & s) ? 1 : 0, upper = (j & s) ? 1 : 0;
    place = 4 * place + ((3 * right) ^ upper);
    if (upper == 0) {  // turn the quarter so that the curve goes on where it came from
      if (right == 1) {
        i = kSide - 1 - i;
        j = kSide - 1 - j;
      }
      std::swap(i, j);
    }
  }
  return place;
}

/// Components of one sort: all of them, or one picked by its mass.
class Components {
 public:
  explicit Components(std::vector<NormalMeasure::Component> components) : components_(std::move(components)) {
    if (components_.size() <= kMostSummed) return;
    std::vector<std::pair<std::uint64_t, std::size_t>> places;
    places.reserve(components_.size());
    for (std::size_t i = 0; i < components_.size(); ++i) {
      places.emplace_back(place_on_sphere(normal_at(components_[i], 0.5, 0.5).unit_normal), i);
    }
    std::ranges::sort(places);
    std::vector<NormalMeasure::Component> sorted;
    sorted.reserve(components_.size());
    for (const auto& place : places) sorted.push_back(components_[place.second]);
    components_ = std::move(sorted);
    for (const NormalMeasure::Component& component : components_) shares_.push_back(mass_of(component));
    normalise_shares();
  }

  /// Half of the picks then go by mass times this function of the normal: a thin body's rim has next to no area, but
  /// may have most of the integral. The other half keep the weights bounded where the function misleads.
  template <class F>
  void favour(const F& typical) {
    if (!picks()) return;
    std::vector<double> favoured;
    double sum = 0.0;
    for (const NormalMeasure::Component& component : components_) {
      favoured.push_back(mass_of(component) * typical(normal_at(component, 0.5, 0.5).unit_normal));
      sum += favoured.back();
    }
    if (!(sum > 0.0)) return;
    for (std::size_t i = 0; i < shares_.size(); ++i) shares_[i] = 0.5 * (shares_[i] + favoured[i] / sum);
    normalise_shares();
  }

  bool picks() const { return !shares_.empty(); }
  std::size_t n_all() const { return components_.size(); }
  std::size_t n_used() const { return picks() ? 1 : n_all(); }
  const std::vector<NormalMeasure::Component>& all() const { return components_; }

  /// The integral of f over them all.
  template <class F>
  double sum(double v, double w, const F& f) const {
    DoubleDouble total;
    for (const NormalMeasure::Component& component : components_) {
      const WeightedNormal at = normal_at(component, v, w);
      total += at.weight * f(at.unit_normal);
    }
    return total.value();
  }

  /// For uniform coordinates, the mean of this is the integral of f.
  template <class F>
  double sample(double pick, double v, double w, const F& f) const {
    if (!picks()) return sum(v, w, f);
    const auto found = std::ranges::upper_bound(share_up_to_, pick);
    const auto i = std::min(static_cast<std::size_t>(found - share_up_to_.begin()), components_.size() - 1);
    const WeightedNormal at = normal_at(components_[i], v, w);
    return at.weight / shares_[i] * f(at.unit_normal);
  }

 private:
  void normalise_shares() {
    DoubleDouble total, sum;
    for (const double share : shares_) total += share;
    share_up_to_.clear();
    for (double& share : shares_) {
      share /= total.value();
      sum += share;
      share_up_to_.push_back(sum.value());
    }
  }

  std::vector<NormalMeasure::Component> components_;
  std::vector<double> shares_, share_up_to_;  // of the picks; empty where all are summed
};

bool spins_about_z(const OrientationLaw& law) {
  return law.kind() == OrientationLaw::Kind::cone || law.kind() == OrientationLaw::Kind::onsager;
}

bool is_alike_about_z(const NormalMeasure::Component& component) {
  return std::holds_alternative<NormalRing>(component) || std::holds_alternative<NormalZone>(component) ||
         std::holds_alternative<NormalRim>(component);
}

bool is_whole_sphere(const NormalMeasure::Component& component) {
  const auto* const zone = std::get_if<NormalZone>(&component);
  return zone != nullptr && zone->cos_from == -1.0 && zone->cos_to == 1.0;
}

/// One body's surface area measure: its uniform part, faces, edges and curved parts apart.
class Side {
 public:
  Side(const NormalMeasure& area, const OrientationLaw& law) {
    std::vector<NormalMeasure::Component> faces, edges, curved;
    if (law.kind() == OrientationLaw::Kind::isotropic) {
      // Any normals will do. These six balance whatever is odd or quadratic in the normal.
      const double sixth = area.total_mass() / 6.0;
      for (const double s : {-1.0, 1.0}) {
        for (const Vec3d& n : {Vec3d{s, 0, 0}, Vec3d{0, s, 0}, Vec3d{0, 0, s}}) faces.push_back(NormalAtom{n, sixth});
      }
    } else {
      for (const NormalMeasure::Component& component : area.components()) {
        if (is_whole_sphere(component)) {
          uniform_mass_ += mass_of(component);
          continue;
        }
        const bool is_face = std::holds_alternative<NormalAtom>(component);
        (is_face ? faces : (std::holds_alternative<NormalArc>(component) ? edges : curved)).push_back(component);
      }
    }
    for (auto* const sort : {&faces, &edges, &curved}) {
      std::erase_if(*sort, [](const NormalMeasure::Component& component) { return !(mass_of(component) > 0.0); });
      for (const NormalMeasure::Component& component : *sort) {
        const CoordinatesUsed used = coordinates_used(component);
        coordinates_.v = coordinates_.v || used.v;
        coordinates_.w = coordinates_.w || (used.w && !(spins_about_z(law) && is_alike_about_z(component)));
      }
      sorts_.emplace_back(std::move(*sort));
    }
  }

  /// Of the uniform measure on the sphere, which is in none of the sorts.
  double uniform_mass() const { return uniform_mass_; }
  const Components& faces() const { return sorts_[0]; }
  bool picks() const {
    return std::ranges::any_of(sorts_, [](const Components& sort) { return sort.picks(); });
  }
  CoordinatesUsed coordinates() const { return coordinates_; }
  std::size_t n_all() const {
    return std::accumulate(sorts_.begin(), sorts_.end(), std::size_t{0},
                           [](std::size_t n, const Components& sort) { return n + sort.n_all(); });
  }
  std::size_t n_used() const {
    return std::accumulate(sorts_.begin(), sorts_.end(), std::size_t{0},
                           [](std::size_t n, const Components& sort) { return n + sort.n_used(); });
  }
  void leave_out_faces() { sorts_[0] = Components({}); }
  template <class F>
  void favour(const F& typical) {
    for (Components& sort : sorts_) sort.favour(typical);
  }

  template <class F>
  double sample(double pick, double v, double w, const F& f) const {
    double total = 0.0;
    for (const Components& sort : sorts_) total += sort.sample(pick, v, w, f);
    return total;
  }

 private:
  double uniform_mass_ = 0.0;
  std::vector<Components> sorts_;  // faces, edges, curved parts
  CoordinatesUsed coordinates_;
};

/// Where in a point of the unit cube each random choice is found.
struct Layout {
  struct OfSide {
    int pick = -1, v = -1, w = -1;
  };
  int dimension = 0;
  OfSide a, b;

  Layout(const OrientationLaw& law, const Side& side_a, const Side& side_b) : dimension(law.dimension()) {
    if (side_a.picks()) a.pick = dimension++;
    if (side_b.picks()) b.pick = dimension++;
    if (side_a.coordinates().v) a.v = dimension++;
    if (side_b.coordinates().v) b.v = dimension++;
    if (side_a.coordinates().w) a.w = dimension++;
    if (side_b.coordinates().w) b.w = dimension++;
  }
};

double coordinate(std::span<const double> point, int index) {
  return index < 0 ? 0.5 : point[static_cast<std::size_t>(index)];
}

int log2_n_points(double cost_of_point, const ExactAverageSettings& settings) {
  int log2_n = settings.log2_n_points;
  while (log2_n > 4 && std::ldexp(cost_of_point, log2_n) * settings.n_randomisations > settings.largest_cost) --log2_n;
  return log2_n;
}

void require_normals(const MeasuredBody& body) {
  if (!body.normals.area || !body.normals.mean_curvature) {
    throw UsageError("a body without its measures on normals (" + body.kind +
                     ") - its excluded volume at a fixed orientation needs them");
  }
}

std::optional<Vec3d> semi_axes_of(const ConvexBody& body) {
  if (const auto* const ellipsoid = body.target<Ellipsoid>()) return ellipsoid->semi_axes();
  if (body.target<Sphere>() != nullptr) return Vec3d{body.inradius(), body.inradius(), body.inradius()};
  return std::nullopt;
}

/// Mean and standard error of f over the unit cube, from as many randomisations as the settings ask for.
template <class F>
ExactAverage quasi_monte_carlo(int dimension, double cost_of_point, const ExactAverageSettings& settings, const F& f) {
  const SobolPoints points(dimension);
  const std::uint64_t n_points = std::uint64_t{1} << log2_n_points(cost_of_point, settings);
  const auto is_interrupted = [&] { return settings.interrupt != nullptr && settings.interrupt->load() != 0; };
  std::vector<double> means, point(static_cast<std::size_t>(dimension));
  for (int k = 0; k < settings.n_randomisations; ++k) {
    const SobolPoints::Scrambling keys = points.scrambling(settings.seed, static_cast<std::uint64_t>(k));
    DoubleDouble sum;
    for (std::uint64_t i = 0; i < n_points && !is_interrupted(); ++i) {
      points.scrambled(keys, i, point);
      sum += f(std::span<const double>(point));
    }
    if (is_interrupted()) break;
    means.push_back(sum.value() / static_cast<double>(n_points));
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (means.empty()) return {std::nan(""), kInfinity};
  const auto n = static_cast<double>(means.size());
  const double mean = std::accumulate(means.begin(), means.end(), 0.0) / n;
  double squares = 0.0;
  for (const double m : means) squares += (m - mean) * (m - mean);
  return {mean, means.size() < 2 ? kInfinity : std::sqrt(squares / (n * (n - 1.0)))};
}

constexpr double kCostOfCoordinate = 25.0, kCostOfNormal = 15.0;

}  // namespace

ExactAverage exact_average(const MeasuredBody& a, const MeasuredBody& b, const OrientationLaw& law,
                           const ExactAverageSettings& settings) {
  VEX_EXPECT(settings.n_randomisations >= 2);
  require_normals(a);
  require_normals(b);
  if (settings.series) {
    const std::optional<SeriesAverage> series = legendre_average(a, b, law);
    if (series && series->error <= kSeriesError * series->excluded_volume) {
      return {series->excluded_volume, series->error};
    }
  }
  const Heights heights_a(a.body), heights_b(b.body);
  Side side_a(a.normals.area(), law), side_b(b.normals.area(), law);
  const auto n_faces = static_cast<int>(side_a.n_all() + side_b.n_all());
  const auto with_rounding = [&](const ExactAverage& average) {
    if (std::isinf(average.error)) return average;  // interrupted
    const double rounding = (gamma(256 + n_faces) + kMeasuresError) * average.excluded_volume +
                            a.measures.surface_area * heights_b.error() + b.measures.surface_area * heights_a.error();
    return ExactAverage{average.excluded_volume, average.error + rounding};
  };
  /// f(R, point), averaged; where the point has no coordinates it is f of the one R.
  const auto averaged = [&](int dimension, double cost_of_point, const auto& f) {
    if (dimension == 0) return ExactAverage{f(law.rotation<double>({}), std::span<const double>{}), 0.0};
    return quasi_monte_carlo(dimension, kCostOfCoordinate * dimension + cost_of_point, settings,
                             [&](std::span<const double> point) { return f(law.rotation<double>(point), point); });
  };

  const std::optional<Vec3d> axes_a = semi_axes_of(a.body), axes_b = semi_axes_of(b.body);
  if (axes_a && axes_b && law.kind() != OrientationLaw::Kind::isotropic) {
    constexpr double kCost = 3000.0;
    return with_rounding(averaged(law.dimension(), kCost, [&](const Transformd& r, std::span<const double>) {
      return ellipsoid_excluded_volume(*axes_a, *axes_b, r);
    }));
  }

  const auto over_a = [&](const Transformd& r) {  // h_(-RB)(n) = h_B(-R^T n)
    return [&](const Vec3d& n) { return heights_b(r.direction_to_b(-n)); };
  };
  const auto over_b = [&](const Transformd& r) {  // the normals of -RB are -R n
    return [&](const Vec3d& n) { return heights_a(r(-n)); };
  };
  double certain = a.measures.volume + b.measures.volume;
  certain += side_a.uniform_mass() * b.measures.mean_radius() + side_b.uniform_mass() * a.measures.mean_radius();
  if (law.dimension() == 0) {
    const Transformd r = law.rotation<double>({});
    const double cost = static_cast<double>(side_a.faces().n_all()) * heights_b.cost() +
                        static_cast<double>(side_b.faces().n_all()) * heights_a.cost();
    if (cost <= settings.largest_cost) {
      certain += side_a.faces().sum(0.5, 0.5, over_a(r)) + side_b.faces().sum(0.5, 0.5, over_b(r));
      side_a.leave_out_faces();
      side_b.leave_out_faces();
    }
  }
  if (side_a.n_all() + side_b.n_all() == 0) return with_rounding({certain, 0.0});

  // What to pick is decided by heights at a few rotations of the law, as many as a quarter of the cost allows.
  const auto favour = [&](Side& side, const Heights& heights, const auto& over) {
    if (!side.picks()) return;
    constexpr int kMostRotations = 16;
    const double affordable =
        0.25 * settings.largest_cost / (static_cast<double>(side.n_all()) * (heights.cost() + kCostOfNormal));
    const int n_rotations = static_cast<int>(std::min(affordable, static_cast<double>(kMostRotations)));
    if (n_rotations == 0) return;
    std::vector<Transformd> rotations;
    const SobolPoints points(OrientationLaw::kMaxDimension);
    const SobolPoints::Scrambling keys = points.scrambling(settings.seed, kPilot);
    std::vector<double> point(OrientationLaw::kMaxDimension);
    for (int k = 0; k < n_rotations; ++k) {
      points.scrambled(keys, static_cast<std::uint64_t>(k), point);
      rotations.push_back(law.rotation<double>(point));
    }
    side.favour([&](const Vec3d& n) {
      double sum = 0.0;
      for (const Transformd& r : rotations) sum += over(r)(n);
      return sum;
    });
  };
  favour(side_a, heights_b, over_a);
  favour(side_b, heights_a, over_b);

  const Layout layout(law, side_a, side_b);
  const double cost_of_point = static_cast<double>(side_a.n_used()) * (heights_b.cost() + kCostOfNormal) +
                               static_cast<double>(side_b.n_used()) * (heights_a.cost() + kCostOfNormal);
  ExactAverage average = averaged(layout.dimension, cost_of_point, [&](const Transformd& r, std::span<const double> u) {
    return side_a.sample(coordinate(u, layout.a.pick), coordinate(u, layout.a.v), coordinate(u, layout.a.w),
                         over_a(r)) +
           side_b.sample(coordinate(u, layout.b.pick), coordinate(u, layout.b.v), coordinate(u, layout.b.w), over_b(r));
  });
  average.excluded_volume += certain;
  return with_rounding(average);
}

}  // namespace vex
