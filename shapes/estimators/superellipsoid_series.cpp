#include "shapes/estimators/superellipsoid_series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "shapes/superellipsoid_normals.h"

namespace vex {
namespace {

using std::numbers::pi;

constexpr double kMostStepsOfPart = 1.5e9;  // of the polynomials' recursion, a quarter of a nanosecond each
constexpr double kHalfOfNodesError = 3e-6;  // of the mass: twice the step has half of the digits at most
constexpr double kSettledError = 1e-10;     // of the mass, from one round to the next
constexpr double kNegligible = 1e-20;       // weights, of the mass

/// Sums of weight P_l(x) over all that is added, and over the nodes of twice the step. Polynomials of a block of nodes
/// are made together: the recursion of one waits for itself.
class Sums {
 public:
  explicit Sums(std::size_t max_degree) : fine(max_degree + 1, 0.0), coarse(max_degree + 1, 0.0) {
    for (std::size_t l = 0; l <= max_degree; ++l) {
      const auto n = static_cast<double>(l);
      of_now_.push_back((2.0 * n + 1.0) / (n + 1.0));
      of_before_.push_back(n / (n + 1.0));
    }
  }

  void add(double weight, double coarse_weight, double x) {
    weights_[n_] = weight;
    coarse_weights_[n_] = coarse_weight;
    xs_[n_] = std::clamp(x, -1.0, 1.0);
    if (++n_ == kBlock) flush();
  }
  void flush() {
    for (std::size_t i = n_; i < kBlock; ++i) weights_[i] = coarse_weights_[i] = xs_[i] = 0.0;
    std::array<double, kBlock> before{}, now;
    now.fill(1.0);
    for (std::size_t l = 0; l < fine.size(); ++l) {
      double sum = 0.0, coarse_sum = 0.0;
      for (std::size_t i = 0; i < kBlock; ++i) {
        sum += weights_[i] * now[i];
        coarse_sum += coarse_weights_[i] * now[i];
        const double next = of_now_[l] * xs_[i] * now[i] - of_before_[l] * before[i];
        before[i] = now[i];
        now[i] = next;
      }
      fine[l] += sum;
      coarse[l] += coarse_sum;
    }
    n_ = 0;
  }

  std::vector<double> fine, coarse;

 private:
  static constexpr std::size_t kBlock = 16;
  std::vector<double> of_now_, of_before_;
  std::array<double, kBlock> weights_{}, coarse_weights_{}, xs_{};
  std::size_t n_ = 0;
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t l = 0; l < a.size(); ++l) largest = std::max(largest, std::fabs(a[l] - b[l]));
  return largest;
}

/// The signs of x, y and z at which the axis sees other places of the body: of opposite ones P_l is alike.
std::vector<Vec3d> octants_of(const Vec3d& axis) {
  std::vector<Vec3d> octants;
  for (const double y : {1.0, -1.0}) {
    for (const double z : {1.0, -1.0}) {
      if ((y < 0.0 && (axis.y == 0.0 || (axis.x == 0.0 && axis.z == 0.0))) ||
          (z < 0.0 && (axis.z == 0.0 || (axis.x == 0.0 && axis.y == 0.0)))) {
        continue;
      }
      octants.push_back({axis.x, y * axis.y, z * axis.z});
    }
  }
  return octants;
}

struct AcrossNode {
  AcrossPlace place;
  bool is_coarse;
};

std::vector<AcrossNode> across_nodes(const SuperellipsoidNormals& part, double step, bool is_about_z) {
  if (is_round(part)) return {{across_place(part, false, 0.5), true}};
  // About z both halves are alike where the semi-axes are.
  const bool are_alike = is_about_z && part.semi_axes.x == part.semi_axes.y;
  std::vector<AcrossNode> nodes;
  for (const UnitNode& node : unit_nodes(step)) {
    for (const bool is_mirrored : {false, true}) {
      if (are_alike && is_mirrored) continue;
      AcrossPlace place = across_place(part, is_mirrored, node.u);
      place.weight *= are_alike ? node.weight : 0.5 * node.weight;  // two halves
      nodes.push_back({place, node.is_coarse});
    }
  }
  return nodes;
}

/// The largest share of a quarter of a turn by which the normal's angle to z changes with t, at one s.
double swing_across(const SuperellipsoidNormals& part) {
  if (is_round(part)) return 0.0;
  double least = 1e300, most = 0.0;
  for (const double u : {0.0, 0.25, 0.5, 0.75, 0.9, 1.0}) {
    for (const bool is_mirrored : {false, true}) {
      const AcrossPlace place = across_place(part, is_mirrored, u);
      const double far = std::hypot(place.dual_x / part.semi_axes.x, place.dual_y / part.semi_axes.y);
      least = std::min(least, far);
      most = std::max(most, far);
    }
  }
  return std::atan(std::sqrt(most / least)) / (0.25 * pi) - 1.0;
}

}  // namespace

std::optional<std::vector<double>> superellipsoid_series(const SuperellipsoidNormals& part, std::size_t max_degree,
                                                         const Vec3d& unit_axis) {
  const bool is_about_z = unit_axis.x == 0.0 && unit_axis.y == 0.0;
  const std::vector<Vec3d> octants = octants_of(unit_axis);
  const auto degree = static_cast<double>(max_degree);
  const double swing = is_about_z ? std::min(1.0, 1.5 * swing_across(part)) : 1.0;
  double left = kMostStepsOfPart, finer_along = 1.0, finer_across = 1.0;
  for (std::vector<double> before;; finer_along *= 1.4, finer_across *= 1.1) {
    const std::vector<UnitNode> along = unit_nodes(2.0 * pi / (finer_along * (100.0 + 3.0 * degree)));
    const std::vector<AcrossNode> across =
        across_nodes(part, 2.0 * pi / (finer_across * (100.0 + 3.0 * degree * swing)), is_about_z);
    left -= 2.0 * static_cast<double>(along.size() * across.size() * octants.size()) * (degree + 1.0);
    if (left < 0.0) return std::nullopt;
    Sums sums(max_degree);
    const double negligible = kNegligible * part.mass;
    const auto n_octants = static_cast<double>(octants.size());
    const double coarser = is_round(part) ? 2.0 : 4.0;
    for (const UnitNode& height : along) {
      for (const bool is_upper : {false, true}) {
        AlongPlace place = along_place(part, is_upper, height.u);
        place.weight *= 0.5 * height.weight / n_octants;
        for (const AcrossNode& node : across) {
          const WeightedNormal at = octant_normal(part, node.place, place);
          if (!(at.weight > negligible)) continue;
          const double coarse_weight = node.is_coarse && height.is_coarse ? coarser * at.weight : 0.0;
          for (const Vec3d& axis : octants) sums.add(at.weight, coarse_weight, dot(at.unit_normal, axis));
        }
      }
    }
    sums.flush();
    for (std::size_t l = 1; l <= max_degree; l += 2) sums.fine[l] = sums.coarse[l] = 0.0;
    if (largest_difference(sums.fine, sums.coarse) <= kHalfOfNodesError * part.mass ||
        (!before.empty() && largest_difference(sums.fine, before) <= kSettledError * part.mass)) {
      return std::move(sums.fine);
    }
    before = std::move(sums.fine);
  }
}

}  // namespace vex
