#include "engine/query/search/planar_polygon.h"

#include <algorithm>
#include <cmath>

namespace vex {
namespace {

double length(const PlanarPoint& a) { return std::hypot(a.x, a.y); }

// How far `at` is to the left of the line from one point to another.
double left_of(const PlanarPoint& from, const PlanarPoint& to, const PlanarPoint& at) {
  const PlanarPoint along = to - from;
  return turn(along, at - from) / length(along);
}

// The chain from the first to the last of sorted points that has them all to its left.
void add_chain(const std::vector<PlanarPoint>& sorted, double resolution, std::vector<PlanarPoint>& hull) {
  const std::size_t begin = hull.size();
  for (const PlanarPoint& point : sorted) {
    while (hull.size() >= begin + 2 && !(left_of(hull[hull.size() - 2], point, hull.back()) < -resolution)) {
      hull.pop_back();
    }
    if (hull.size() > begin && length(point - hull.back()) <= resolution) {
      if (hull.size() > begin + 1) hull.back() = point;
      continue;
    }
    hull.push_back(point);
  }
}

}  // namespace

std::vector<PlanarPoint> planar_hull(std::vector<PlanarPoint> points, double resolution) {
  // Along the longest extent, so that the ends of the chains are far from each other.
  PlanarPoint from = points.front(), to = points.front();
  for (int round = 0; round < 2; ++round) {
    for (const PlanarPoint& p : points) {
      if (length(p - from) > length(to - from)) to = p;
    }
    std::swap(from, to);
  }
  const double extent = length(to - from);
  if (!(extent > resolution)) return {from};
  const PlanarPoint along = (1.0 / extent) * (to - from);
  std::ranges::sort(points, [&](const PlanarPoint& a, const PlanarPoint& b) {
    const double by = dot(along, a - b);
    return by != 0.0 ? by < 0.0 : turn(along, a - b) < 0.0;
  });
  std::vector<PlanarPoint> hull;
  add_chain(points, resolution, hull);
  hull.pop_back();
  std::ranges::reverse(points);
  add_chain(points, resolution, hull);
  hull.pop_back();
  if (hull.size() < 2) return {from, to};
  return hull;
}

std::vector<PlanarPoint> clipped(const std::vector<PlanarPoint>& subject, const std::vector<PlanarPoint>& clip,
                                 double resolution) {
  std::vector<PlanarPoint> part = subject;
  for (std::size_t side = 0; side < clip.size() && !part.empty(); ++side) {
    const PlanarPoint& from = clip[side];
    const PlanarPoint along = clip[(side + 1) % clip.size()] - from;
    const double long_as = length(along);
    const auto left = [&](const PlanarPoint& at) { return turn(along, at - from) / long_as; };
    const auto is_left = [&](const PlanarPoint& at) { return left(at) >= -resolution; };
    if (std::ranges::all_of(part, is_left)) continue;
    std::vector<PlanarPoint> kept;
    // A segment has one side, a point none.
    const std::size_t n_sides = part.size() > 2 ? part.size() : part.size() - 1;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const double at = left(part[k]);
      const bool is_in = at >= -resolution;
      if (is_in) kept.push_back(part[k]);
      if (k >= n_sides) continue;
      const PlanarPoint& next = part[(k + 1) % part.size()];
      const double at_next = left(next);
      if (is_in != (at_next >= -resolution) && std::fabs(at) > resolution && std::fabs(at_next) > resolution) {
        kept.push_back(part[k] + (at / (at - at_next)) * (next - part[k]));
      }
    }
    part = std::move(kept);
  }
  return part;
}

double distance_to(const std::vector<PlanarPoint>& polygon, const PlanarPoint& point) {
  double nearest = HUGE_VAL;
  bool is_inside = true;
  for (std::size_t side = 0; side < polygon.size(); ++side) {
    const PlanarPoint &from = polygon[side], along = polygon[(side + 1) % polygon.size()] - from;
    const double share = std::clamp(dot(along, point - from) / dot(along, along), 0.0, 1.0);
    nearest = std::fmin(nearest, length((point - from) - share * along));
    is_inside = is_inside && turn(along, point - from) >= 0.0;
  }
  return is_inside ? 0.0 : nearest;
}

}  // namespace vex
