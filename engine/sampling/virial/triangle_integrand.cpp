#include "engine/sampling/virial/triangle_integrand.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/numeric/rounding.h"
#include "engine/query/packets/packet_pair.h"
#include "engine/sampling/radial/radial_function.h"
#include "engine/sampling/virial/virial_integrand.h"

namespace vex {
namespace {

double cubed(double x) { return x * x * x; }

// Of rays that no packets find: each step on costs a support point of two bodies, and a number that is drawn between
// bounds as near as these is a hundredth of what triangles vary by. A verdict tells on which side of it the ray ends.
constexpr double kGapOfLoneRays = 0x1p-6;

// Of others packets leave rays open, for the powers of lengths that they take.
bool is_usual_size(const ConvexBody& body) {
  constexpr double kLargest = 0x1p40;
  return body.circumradius() < kLargest && body.circumradius() > 1.0 / kLargest;
}

// Where support points are powers, as of superellipsoids, a lone ray takes tens of microseconds: triangles are no
// better than clusters then. What a mapping rounds by tells how many operations it takes.
bool has_long_mapping(const ConvexBody& body) {
  return body.support_error() > 100.0 * kUnitRoundoff * body.circumradius();
}

}  // namespace

TriangleIntegrand::TriangleIntegrand(const ConvexBody& body, const OrientationLaw& law, double excluded_volume,
                                     double relative_error, InstructionSet set, int n_sides)
    : body_(body),
      map_(body, law),
      excluded_volume_(excluded_volume),
      relative_error_(relative_error),
      n_sides_(static_cast<std::size_t>(n_sides)),
      make_triangles_(triangle_maker(set)),
      packets_(make_packet_rays(ray_kernel(set), body, body, map_.points())) {
  if (!chains_factorise(law)) {
    throw UsageError("no triangles for orientations " + law.name() + " - use isotropic or aligned");
  }
  VEX_EXPECT(n_sides_ >= 1 && n_sides_ <= 3);
}

bool TriangleIntegrand::is_for(const ConvexBody& body, const OrientationLaw& law, double excluded_volume,
                               double relative_error) {
  constexpr double kMostError = 1e-7;
  if (!chains_factorise(law) || !(excluded_volume > 0.0 && relative_error < kMostError)) return false;
  if (!is_usual_size(body)) return false;
  // Of bodies that are all alike turned, lone rays come out where surfaces are parallel, at rims and tips, and stall
  // there: aligned lenses and spindles took ten to forty times as long as turned ones, which is worse than clusters.
  const bool are_lone_rays_dear = has_long_mapping(body) || law.kind() != OrientationLaw::Kind::isotropic;
  if (are_lone_rays_dear && PacketPair::make(body, body) == nullptr) return false;
  return TriangleMap(body, law).is_usable();
}

double TriangleIntegrand::cost() const {
  constexpr double kOfMap = 60.0, kOfSide = 150.0;
  return kOfMap + 3.0 * kOfSide;
}

// By portals one by one, and by proven verdicts.
TriangleIntegrand::Bounds TriangleIntegrand::by_itself(std::size_t row, double relative_gap) const {
  const RayTable rays{columns_.rays[0], TriangleColumns::kStride, 0};
  const RadialBounds found =
      radial_function(body_, body_, map_.points(), Pose::unchecked(rays.rotation(row)), rays.dir(row), relative_gap);
  const double lower = cubed(found.lower), upper = cubed(found.upper), middle = 0.5 * (lower + upper);
  if (relative_gap > 0.0) return {lower, upper};
  const bool is_apart = upper - lower > 16.0 * kRadialRounding * upper;
  return {middle, middle, is_apart ? 0.5 * (upper - lower) : 0.0};
}

Outcome TriangleIntegrand::outcome_at(std::size_t row, double cube) const {
  const RayTable rays{columns_.rays[0], TriangleColumns::kStride, 0};
  return outcome_along(body_, body_, map_.points(), rays.rotation(row), rays.dir(row), std::cbrt(cube));
}

// Of every triangle the least of its sides, between bounds; and of those that are near, but have not met, what is to be
// asked. The square of r^3 is averaged, so the number is drawn uniformly between the squares.
void TriangleIntegrand::ask(std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) {
    Bounds& least = least_[k];
    least = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (std::size_t row = k; row < n_sides_ * n; row += n) {
      Bounds& bounds = bounds_[row];
      if (!std::isnan(answers_.cube[row])) {
        bounds = {answers_.cube[row], answers_.cube[row]};
      } else if (answers_.outer[row] > 0.0) {
        bounds = {answers_.inner[row], answers_.outer[row]};
      } else {
        bounds = by_itself(row, packets_ == nullptr ? kGapOfLoneRays : 0.0);
      }
      least.lower = std::fmin(least.lower, bounds.lower);
      least.upper = std::fmin(least.upper, bounds.upper);
    }
    const double lower = least.lower * least.lower, upper = least.upper * least.upper;
    const double asked = std::sqrt(lower + columns_.picks[k] * (upper - lower));
    for (std::size_t row = k; row < 3 * n; row += n) answers_.asked[row] = asked;
  }
}

// Whether r^3 along the side is what was asked for, or more.
bool TriangleIntegrand::reaches(std::size_t row, Bounds& bounds) const {
  const double asked = answers_.asked[row];
  if (bounds.lower >= asked) return true;
  if (bounds.upper < asked) return false;
  if (packets_ == nullptr) {
    const Outcome outcome = outcome_at(row, asked);
    if (outcome != Outcome::undecided) return outcome == Outcome::overlap;
  }
  if (std::isnan(answers_.cube[row])) {
    bounds = by_itself(row);
    return bounds.lower >= asked;
  }
  return answers_.cube[row] >= asked;
}

void TriangleIntegrand::find_sides(std::size_t n) {
  make_triangles_(map_, n, columns_);
  if (packets_ == nullptr) {
    answers_.open_all(3 * n);
    ask(n);
    return;
  }
  packets_->close_in(columns_.table(n), answers_);
  ask(n);
  packets_->decide(answers_);
}

Doubts TriangleIntegrand::evaluate(std::span<const double> points, std::span<double> values) {
  constexpr std::size_t kGrain = TriangleColumns::kGrain;
  const auto dimension = static_cast<std::size_t>(map_.dimension());
  VEX_EXPECT(points.size() == dimension * values.size());
  Doubts doubts;
  for (std::size_t first = 0; first < values.size(); first += TriangleColumns::kTriangles) {
    const std::size_t n_here = std::min(TriangleColumns::kTriangles, values.size() - first);
    const std::size_t n = (n_here + kGrain - 1) / kGrain * kGrain;
    for (std::size_t c = 0; c < dimension; ++c) {
      const std::span<const double> column = points.subspan(c * values.size() + first, n_here);
      std::ranges::copy(column, columns_.coordinates[c]);
      std::fill(columns_.coordinates[c] + n_here, columns_.coordinates[c] + n, column.back());
    }
    find_sides(n);
    for (std::size_t k = 0; k < n_here; ++k) {
      const double weight = columns_.weights[k];
      const auto value_of = [&](double cube) {
        const double share = cube / excluded_volume_;
        return weight * (share * share);
      };
      double cube = least_[k].upper, least = cube, most = std::numeric_limits<double>::infinity();
      bool is_in_doubt = false;
      for (std::size_t row = k; row < n_sides_ * n; row += n) {
        if (!reaches(row, bounds_[row])) cube = least_[k].lower;
        const Bounds& bounds = bounds_[row];
        is_in_doubt = is_in_doubt || bounds.off > 0.0;
        least = std::fmin(least, bounds.lower - bounds.off);
        most = std::fmin(most, bounds.upper + bounds.off);
      }
      values[first + k] = value_of(cube);
      if (!is_in_doubt) continue;
      const double lower = value_of(std::fmax(0.0, least)), upper = value_of(most);
      values[first + k] = 0.5 * (lower + upper);
      doubts.push_back({first + k, 0.5 * (upper - lower)});
    }
    counts_.n_all += 3 * n_here;
    counts_.n_searched += 3 * n_here;
  }
  counts_.n_undecided += doubts.size();
  return doubts;
}

void TriangleIntegrand::count(std::span<std::uint64_t> counted) { std::exchange(counts_, {}).add_to(counted); }

}  // namespace vex
