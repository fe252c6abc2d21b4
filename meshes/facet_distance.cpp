#include "meshes/facet_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/numeric/rounding.h"
#include "meshes/determinant.h"

namespace vex {
namespace {

constexpr std::uint32_t kNoFacet = std::numeric_limits<std::uint32_t>::max();
// Searches that together take more steps than these take any facet, which does for a bound. Bodies, grids and curves
// take 1 to 50 for each point; points whose sizes grow from one to the next, tens of thousands.
constexpr std::size_t kMostStepsOfAPoint = 200;

/// Weights of two corners of a triangle, from 0 up, together 1 at most; the rest is the third corner's.
struct Weights {
  double b = 0.0, c = 0.0;
};

constexpr double kBelowOne = 1.0 - 0x1p-52;  // makes up for the rounding of 1 - x

double part_of(double part, double whole) { return whole > 0.0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0; }

/// Of the point of the triangle 0 b c that is nearest to `p`, to rounding.
Weights nearest_weights(const Vec3d& p, const Vec3d& b, const Vec3d& c) {
  const Vec3d normal = cross(b, c);
  const double square = dot(normal, normal);
  const double of_b = dot(cross(p, c), normal), of_c = dot(cross(b, p), normal);
  if (square > 0.0 && of_b >= 0.0 && of_c >= 0.0 && of_b + of_c <= square) {
    const double weight_b = part_of(of_b, square);
    return {weight_b, std::min(part_of(of_c, square), kBelowOne * (1.0 - weight_b))};
  }
  const double along_c = part_of(dot(p - b, c - b), dot(c - b, c - b));
  Weights best;
  double least = std::numeric_limits<double>::infinity();
  for (const Weights& one : {Weights{part_of(dot(p, b), dot(b, b)), 0.0}, Weights{0.0, part_of(dot(p, c), dot(c, c))},
                             Weights{kBelowOne * (1.0 - along_c), along_c}}) {
    const double distance = norm(p - (one.b * b + one.c * c));
    if (distance < least) {
      least = distance;
      best = one;
    }
  }
  return best;
}

}  // namespace

FacetDistance::FacetDistance(const Triangles& hull) : hull_(hull), middle_(volume_and_centroid(hull).centroid) {
  local_.reserve(hull.vertices.size());
  for (const Vec3d& v : hull.vertices) {
    local_.push_back(middle_.to(v).value());
  }
}

/// By crossing edges that the point is beyond. On a convex surface each step raises n . p / offset of the facet's
/// plane, so the walk ends, but for rounding. Where there are two such edges, steps take turns: a fixed choice could
/// circle.
std::uint32_t FacetDistance::facet_towards(const Vec3d& local) {
  std::uint32_t facet = near_;
  std::uint32_t came_from = kNoFacet;
  most_steps_ += kMostStepsOfAPoint;
  for (std::size_t step = 0; step < hull_.size() && n_steps_ < most_steps_; ++step, ++n_steps_) {
    std::uint32_t across = kNoFacet;
    for (std::uint32_t i = 0; i < 3 && across == kNoFacet; ++i) {
      const std::uint32_t h = 3 * facet + (i + static_cast<std::uint32_t>(step)) % 3;
      const std::uint32_t beyond = hull_.mates[h] / 3;
      if (beyond != came_from && dot(cross(local_[hull_.tail(h)], local_[hull_.head(h)]), local) < 0.0) {
        across = beyond;
      }
    }
    if (across == kNoFacet) {
      break;
    }
    came_from = facet;
    facet = across;
  }
  near_ = facet;
  return facet;
}

/// The distance from whatever point of the facet the weights say is a bound; of the nearest one to rounding, a good
/// one. It is summed in double-double, for what is asked may be the last places of the coordinates.
FacetDistance::Found FacetDistance::to(const Vec3d& point) {
  const std::uint32_t facet = facet_towards(middle_.to(point).value());
  const Vec3d corner = hull_.corner(facet, 0);
  const DoubleDoubleVec3 p = exact_difference(point, corner);
  const DoubleDoubleVec3 b = exact_difference(hull_.corner(facet, 1), corner);
  const DoubleDoubleVec3 c = exact_difference(hull_.corner(facet, 2), corner);
  const Weights weights = nearest_weights(p.value(), b.value(), c.value());
  const auto rest = [&](const DoubleDouble& x, const DoubleDouble& of_b, const DoubleDouble& of_c) {
    return x - (of_b * weights.b + of_c * weights.c);
  };
  const DoubleDoubleVec3 step{rest(p.x, b.x, c.x), rest(p.y, b.y, c.y), rest(p.z, b.z, c.z)};
  return {facet, norm(step) * (1.0 + gamma(16))};
}

}  // namespace vex
